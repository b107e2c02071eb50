#pragma once

#include <cstddef>
#include <deque>
#include <Eigen/Core>
#include <mutex>
#include <optional>

namespace elastolab {

/// The last displacements of all nodes that a model found, by those of its surface: the surface alone does not tell
/// what the inside of a body does without solving again. Any thread may use it.
class FoundStates {
public:
    void add(const Eigen::VectorXd& u) {
        const std::scoped_lock lock(mutex_);
        states_.push_front(u);
        if (states_.size() > kKept) states_.pop_back();
    }
    std::optional<Eigen::VectorXd> with_surface(const Eigen::VectorXd& surface) const {
        const std::scoped_lock lock(mutex_);
        for (const Eigen::VectorXd& u : states_)
            if (u.size() >= surface.size() && (u.head(surface.size()) - surface).norm() <= kSame * surface.norm())
                return u;
        return std::nullopt;
    }

private:
    static constexpr std::size_t kKept = 4;
    static constexpr double kSame = 1e-12;
    mutable std::mutex mutex_;
    std::deque<Eigen::VectorXd> states_;
};

}  // namespace elastolab
