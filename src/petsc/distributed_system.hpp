#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <string>
#include <vector>

#include "petsc/handles.hpp"
#include "petsc/session.hpp"
#include "petsc/share.hpp"

namespace elastolab {

/// What an order is given on the first process; elsewhere all of it is null.
struct Parcel {
    const std::vector<int>* nodes = nullptr;    ///< new numbers
    const Eigen::Matrix3Xd* springs = nullptr;  ///< 3 x 3 a node
    const Eigen::MatrixXd* in = nullptr;        ///< rows in the order of new numbers
    Eigen::MatrixXd* out = nullptr;
};

/// How a system was solved, the same on all processes.
struct SolverFacts {
    Engine engine = Engine::automatic;  ///< mumps or gamg, once there is one
    int iterations = 0;                 ///< of the last column
    double norm = 0.0;                  ///< 1-norm of the matrix that is solved
    double factor_bytes = 0.0;          ///< of MUMPS, on all processes together
    int n_levels = 0;                   ///< of GAMG
};

/// The stiffness of one solid for unit Young's modulus, a block of rows on every process, and what solves it under
/// constraints. The same object on all processes, whose calls are collective.
class DistributedSystem {
public:
    /// K of what is distributed like this: first of all, and once.
    void assemble(Share share);
    /// Does what the order says; the parcel is that of the first process.
    void follow(const Order& order, const Parcel& parcel);

    /// K with the rows and columns of these nodes (new numbers; the same on all processes) set to zero but for their
    /// diagonal.
    void eliminate(const std::vector<int>& nodes);
    /// K with springs at these nodes.
    void ground(const std::vector<int>& nodes, const Eigen::Matrix3Xd& springs);
    /// Prepares the factor, or the multigrid, of what eliminate() or ground() made.
    void prepare(Engine wanted);
    /// x with A x = b to a relative preconditioned residual, for the rows of each process; false: did not converge.
    void solve(Vec b, Vec x, double tolerance);
    /// A vector of this distribution, zero.
    VecHandle make_vector() const;

    const SolverFacts& facts() const { return facts_; }
    int n_own() const { return n_own_; }

private:
    void attach_rigid_modes(Mat A) const;
    bool prepare_mumps(bool insist);
    void prepare_gamg();
    void forget_solver();
    void multiply(const Parcel& parcel, std::int64_t columns, bool sizes);
    void solve_columns(const Parcel& parcel, const Order& order);
    void gather_diagonal(const Parcel& parcel);
    void scatter(const double* all, Vec v) const;
    void gather(const double* own, double* all) const;
    void gather(Vec v, double* all) const;
    std::vector<int> shared_nodes(const Parcel& parcel, std::int64_t n) const;

    int n_all_ = 0, first_ = 0, n_own_ = 0;
    std::vector<int> counts_, begins_;  ///< unknowns of every process, on the first one
    VecHandle coordinates_;
    MatHandle K_, A_, factor_;
    KspHandle ksp_;
    SolverFacts facts_;
};

}  // namespace elastolab
