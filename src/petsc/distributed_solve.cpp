#include <petscksp.h>

#include <algorithm>

#include "base/memory.hpp"
#include "deform/iteration.hpp"
#include "petsc/check.hpp"
#include "petsc/distributed_system.hpp"

namespace elastolab {

namespace {

constexpr int kMostIterations = 2000;
/// Share of the memory of a machine that MUMPS may plan with.
constexpr double kForFactor = 0.8;
/// Its workspace beyond its plan, which falls short [per cent].
constexpr int kBeyondPlan = 40;
constexpr double kMegabyte = 1e6;

/// PETSc's own test of convergence; a cancel on the first process stops all.
PetscErrorCode test_convergence(KSP ksp, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason,
                                void* context) {
    const PetscErrorCode code = KSPConvergedDefault(ksp, iteration, norm, reason, context);
    if (code == 0 && *reason == KSP_CONVERGED_ITERATING && Session::current().cancelled())
        *reason = KSP_DIVERGED_BREAKDOWN;
    return code;
}

double free_memory_of_a_process() {
    const Session& session = Session::current();
    return session.least(static_cast<double>(available_memory_bytes()) / session.n_on_this_machine());
}

}  // namespace

void DistributedSystem::prepare(Engine wanted) {
    check(MatSetOption(A_, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatSetOption(A_, MAT_SPD, PETSC_TRUE));
    check(MatNorm(A_, NORM_INFINITY, &facts_.norm));  // symmetric: the 1-norm too
    if (wanted == Engine::gamg || !prepare_mumps(wanted == Engine::mumps)) prepare_gamg();
}

/// False where the factor would not fit, by MUMPS's own plan or when it is made.
bool DistributedSystem::prepare_mumps(bool insist) {
    check(MatGetFactor(A_, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor_));
    check(MatMumpsSetIcntl(factor_, 14, kBeyondPlan));
    MatFactorInfo info;
    check(MatFactorInfoInitialize(&info));
    check(MatCholeskyFactorSymbolic(factor_, A_, nullptr, &info));
    PetscInt largest = 0, sum = 0;
    check(MatMumpsGetInfog(factor_, 16, &largest));
    check(MatMumpsGetInfog(factor_, 17, &sum));
    MatFactorError failure = MAT_FACTOR_NOERROR;
    if (insist || kMegabyte * largest < kForFactor * free_memory_of_a_process()) {
        check(MatCholeskyFactorNumeric(factor_, A_, &info));
        check(MatFactorGetError(factor_, &failure));
        if (failure == MAT_FACTOR_NOERROR) {
            facts_.engine = Engine::mumps;
            facts_.factor_bytes = kMegabyte * sum;
            return true;
        }
        if (insist)
            throw SolveError(
                "stiffness matrix: MUMPS found no factor, mostly for lack of memory. Take more processes or machines, "
                "or --engine gamg.");
    }
    check(MatDestroy(&factor_));
    return false;
}

void DistributedSystem::prepare_gamg() {
    attach_rigid_modes(A_);
    check(KSPCreate(PETSC_COMM_WORLD, &ksp_));
    check(KSPSetOperators(ksp_, A_, A_));
    check(KSPSetType(ksp_, KSPCG));
    PC pc = nullptr;
    check(KSPGetPC(ksp_, &pc));
    check(PCSetType(pc, PCGAMG));
    check(PCGAMGSetType(pc, PCGAMGAGG));
    check(PCGAMGSetNSmooths(pc, 1));
    check(KSPSetFromOptions(ksp_));
    void* context = nullptr;
    check(KSPConvergedDefaultCreate(&context));
    check(KSPSetConvergenceTest(ksp_, test_convergence, context, KSPConvergedDefaultDestroy));
    check(KSPSetUp(ksp_));
    PetscInt levels = 0;
    check(PCMGGetLevels(pc, &levels));
    facts_.engine = Engine::gamg;
    facts_.n_levels = levels;
}

void DistributedSystem::solve(Vec b, Vec x, double tolerance) {
    if (facts_.engine == Engine::mumps) {
        check(MatSolve(factor_, b, x));
        return;
    }
    check(KSPSetTolerances(ksp_, tolerance, 1e-300, PETSC_DEFAULT, kMostIterations));
    check(KSPSolve(ksp_, b, x));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(ksp_, &reason));
    PetscInt iterations = 0;
    check(KSPGetIterationNumber(ksp_, &iterations));
    facts_.iterations = std::max(facts_.iterations, static_cast<int>(iterations));
    if (Session::current().cancelled()) throw Cancelled{};
    if (reason > 0) return;
    PetscReal norm = 0.0, size = 0.0;
    check(KSPGetResidualNorm(ksp_, &norm));
    check(VecNorm(b, NORM_2, &size));
    give_up_iteration("stiffness matrix", size > 0.0 ? norm / size : norm);
}

void DistributedSystem::solve_columns(const Parcel& parcel, const Order& order) {
    Vec b = make_vector(), x = make_vector();
    for (Eigen::Index column = 0; column < order.n; ++column) {
        scatter(parcel.in != nullptr ? parcel.in->col(column).data() : nullptr, b);
        solve(b, x, order.tolerance);
        gather(x, parcel.out != nullptr ? parcel.out->col(column).data() : nullptr);
    }
    check(VecDestroy(&b));
    check(VecDestroy(&x));
}

}  // namespace elastolab
