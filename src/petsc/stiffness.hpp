#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "fem/constraints.hpp"
#include "mesh/surface_mesh.hpp"
#include "petsc/distributed_system.hpp"

namespace elastolab {

/// On the first process: the stiffness of a solid whose rows lie on all processes, for unit Young's modulus, and what
/// solves it. Vectors are of all nodes, in the mesh's order, and on this process alone. Every call gives an order to
/// all processes; calls from several threads are not allowed. Throws SolveError, Cancelled.
class PetscStiffness {
public:
    /// elements: 4 or 10 nodes a column, corners first
    PetscStiffness(const Positions& positions, const Eigen::Ref<const Eigen::MatrixXi>& elements, double poisson_ratio,
                   Control& control);
    ~PetscStiffness();
    PetscStiffness(const PetscStiffness&) = delete;
    PetscStiffness& operator=(const PetscStiffness&) = delete;

    Eigen::Index size() const { return 3 * std::ssize(partition_.order); }
    /// K u, and |K| |u| entry by entry.
    Eigen::MatrixXd multiply(const Eigen::MatrixXd& u, Control& control) const;
    Eigen::MatrixXd multiply_sizes(const Eigen::MatrixXd& u, Control& control) const;
    /// The 3 x 3 blocks on the diagonal, side by side.
    Eigen::Matrix3Xd diagonal(Control& control) const;

    /// Prepares a solver with these nodes eliminated, or with springs at a support (fem/constraints.hpp), in place of
    /// the one before. Returns the condition number in the 1-norm, estimated as SparseCholesky does.
    double eliminate(std::span<const int> nodes, Control& control);
    /// Likewise, where they are not eliminated already.
    void ensure_eliminated(std::span<const int> nodes, Control& control);
    double ground(const StaticSupport& support, Control& control);
    /// With the solver prepared last; zero where a node is eliminated. tolerance: of conjugate gradients, relative.
    Eigen::MatrixXd solve(const Eigen::MatrixXd& loads, double tolerance, Control& control) const;

    const SolverFacts& facts() const;

private:
    Eigen::MatrixXd ask(Order order, const Eigen::MatrixXd& in, Control& control) const;
    void prepare_eliminated(std::span<const int> nodes, Control& control);
    double condition(Control& control) const;
    Eigen::MatrixXd to_numbers(const Eigen::MatrixXd& of_mesh) const;
    Eigen::MatrixXd to_mesh(const Eigen::MatrixXd& of_numbers) const;
    std::vector<int> numbers_of(std::span<const int> nodes) const;

    Positions positions_;
    Partition partition_;
    int number_ = 0;
    std::vector<int> eliminated_;  ///< of the solver prepared last; none of a grounded one
};

/// To which conjugate gradients iterate: displacements are then as those of a factor but for some 1e-10 of the largest.
inline constexpr double kPetscTolerance = 1e-12;

}  // namespace elastolab
