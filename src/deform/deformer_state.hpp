#pragma once

#include <deque>
#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <vector>

#include "deform/deformer.hpp"
#include "deform/load_parts.hpp"
#include "deform/solid_model.hpp"

// What a Deformer keeps, for its own sources alone.

namespace elastolab {

/// One solid's share of the constrained set.
struct Deformer::SolidState {
    std::unique_ptr<ConstrainedSolid> solid;   ///< null: no constrained vertex, so it rests
    std::vector<int> fixed, handles;           ///< vertices of the solid
    std::vector<int> fixed_rows, handle_rows;  ///< their positions in the lists of the whole set

    std::vector<UnitLoad> loads;          ///< that act on the solid, with its triangles
    std::vector<Eigen::Index> load_rows;  ///< of the values
    Eigen::VectorXd load_units;           ///< the solid's factor of a load over the body's
    FreeWork free_work;                   ///< of these loads

    bool is_constrained() const { return !fixed.empty() || !handles.empty() || !loads.empty(); }

    /// Values of the fixed set (zero), the handles and the loads of this solid, out of those of the whole body.
    Eigen::MatrixXd values(const Eigen::MatrixXd& all) const {
        const Eigen::Index n = 3 * std::ssize(fixed_rows) + 3 * std::ssize(handle_rows);
        Eigen::MatrixXd own = Eigen::MatrixXd::Zero(n + std::ssize(loads), all.cols());
        own.bottomRows(std::ssize(loads)) = load_units.asDiagonal() * all(load_rows, Eigen::all);
        for (std::size_t i = 0; i < handle_rows.size(); ++i)
            own.middleRows<3>(3 * static_cast<Eigen::Index>(fixed_rows.size() + i)) =
                all.middleRows<3>(3 * handle_rows[i]);
        return own;
    }
};

/// The equilibria that were found last.
class Deformer::Memory {
public:
    std::shared_ptr<const Equilibrium> find(const Eigen::VectorXd& values) const {
        const std::scoped_lock lock(mutex_);
        for (const auto& known : equilibria_)
            if (known->values.size() == values.size() && known->values == values) return known;
        return nullptr;
    }
    void add(std::shared_ptr<const Equilibrium> found) {
        const std::scoped_lock lock(mutex_);
        std::erase_if(equilibria_, [&](const auto& known) { return known->values == found->values; });
        equilibria_.push_front(std::move(found));
        if (equilibria_.size() > kRemembered) equilibria_.pop_back();
    }

private:
    static constexpr std::size_t kRemembered = 3;
    mutable std::mutex mutex_;
    std::deque<std::shared_ptr<const Equilibrium>> equilibria_;
};

}  // namespace elastolab
