#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "bem/collocation/system.hpp"
#include "bem/collocation/traction_space.hpp"
#include "deform/reduced_solver.hpp"

namespace elastolab {

/// ComplianceColumns Hhat^-1 [G; 0] of a boundary-element solid to the loads of a space. They are kept where the system
/// keeps columns for so many (BemSystem::keeps); else nothing is kept: the capacitance system is made from groups of
/// columns, and a product integrates and solves afresh. That is as exact and saves a second matrix; each product takes
/// the time of a set change divided by the number of loads.
class BemComplianceColumns : public ComplianceColumns {
public:
    BemComplianceColumns(std::shared_ptr<const BemSystem> system, TractionSpace space, std::span<const UnitLoad> loads,
                         Control& control);

    Eigen::Index cols() const override { return space_.n_degrees_of_freedom(); }
    Eigen::Index n_given() const override { return given_.cols(); }
    Eigen::MatrixXd capacitance_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                       Control& control) const override;
    void add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements,
                     Control& control) const override;

private:
    /// Rows of the equations at interior points <- their integrals times these columns, from column `first` on.
    void add_closing(const Columns& columns, Eigen::Index first, Eigen::Ref<Eigen::MatrixXd> rows,
                     Control& control) const;
    /// ... <- those of the border values, and the single layer of unknown and given tractions.
    void add_closing_of_border_and_loads(const Eigen::MatrixXd& rigid, Eigen::Ref<Eigen::MatrixXd> rows,
                                         Control& control) const;

    std::shared_ptr<const BemSystem> system_;
    TractionSpace space_;
    bool kept_;
    Columns columns_;  ///< empty when nothing is kept
    std::vector<UnitLoad> loads_;
    Columns given_;  ///< of these loads
};

/// The capacitance system of a constrained set: its compliance columns, kept or not, and the border.
ReducedSystem reduced_system(const std::shared_ptr<const BemSystem>& system, const TractionSpace& space,
                             const std::vector<int>& nodes, std::span<const UnitLoad> loads, Control& control);

/// Bytes that the compliance columns of a space, their capacitance system and its making take at their peak.
std::uint64_t compliance_memory(const BemSystem& system, const TractionSpace& space);

}  // namespace elastolab
