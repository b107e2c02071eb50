#include "petsc/node_solvers.hpp"

#include "deform/holds.hpp"
#include "deform/node_rows.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/free_border.hpp"
#include "fem/held_nodes.hpp"

namespace elastolab {

namespace {

Columns as_columns(Eigen::MatrixXd matrix) {
    if (matrix.cols() == 0) return {};
    return Columns({std::make_shared<const Eigen::MatrixXd>(std::move(matrix))});
}

}  // namespace

PetscHeldSolver::PetscHeldSolver(std::shared_ptr<PetscStiffness> stiffness, const Positions& positions,
                                 std::vector<int> nodes, Eigen::MatrixXd given, Control& control)
    : stiffness_(std::move(stiffness)), nodes_(std::move(nodes)), given_(std::move(given)) {
    if (!holds(positions, nodes_)) throw NotHeldError();
    condition_ = stiffness_->eliminate(nodes_, control);
}

NodeSolution PetscHeldSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    Control control;
    return solve_watched(prescribed, want_loads, kPetscTolerance, control);
}

NodeSolution PetscHeldSolver::solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double /*tolerance*/,
                                            Control& control) const {
    stiffness_->ensure_eliminated(nodes_, control);
    const HeldStiffness K{[&](const Eigen::MatrixXd& u) { return stiffness_->multiply(u, control); },
                          [&](const Eigen::MatrixXd& f) { return stiffness_->solve(f, kPetscTolerance, control); }};
    return solve_held(K, nodes_, given_, prescribed, want_loads);
}

PetscFreeSolver::PetscFreeSolver(PetscStiffness& stiffness, const Positions& positions, int n_surface,
                                 const std::vector<int>& nodes, const Eigen::MatrixXd& given, Control& control) {
    const double of_grounded = stiffness.ground(choose_support(positions, n_surface), control);
    const FreeBorder border(positions, rigid_modes(positions.leftCols(n_surface)));
    const auto columns = [&](Eigen::MatrixXd forces) {
        return as_columns(border.compliance_columns(
            std::move(forces), [&](const Eigen::MatrixXd& f) { return stiffness.solve(f, kPetscTolerance, control); }));
    };
    auto compliance_columns =
        std::make_shared<const KeptComplianceColumns>(columns(unit_forces(nodes, positions.cols())), columns(given));
    reduced_ = std::make_unique<const ReducedSolver>(
        bordered_system(std::move(compliance_columns), border.motions(), nodes), control);
    condition_ = std::max(reduced_->condition(), of_grounded);
    held_ = reduced_->held();
}

double petsc_residual(const PetscStiffness& K, const Eigen::MatrixXd& u, const std::vector<int>& nodes,
                      const Eigen::MatrixXd& forces, const Eigen::MatrixXd& given, Control& control) {
    return force_residual(K.multiply(u, control).col(0), K.multiply_sizes(u, control).col(0), nodes, forces,
                          given.col(0));
}

}  // namespace elastolab
