#include <algorithm>
#include <memory>

#include "base/memory.hpp"
#include "deform/iteration.hpp"
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

/// What KSPConvergedDefault counts with.
void* default_test() {
    void* context = nullptr;
    check(KSPConvergedDefaultCreate(&context));
    return context;
}

double free_memory_of_a_process() {
    const Session& session = Session::current();
    return session.least(static_cast<double>(available_memory_bytes()) / session.n_on_this_machine());
}

}  // namespace

void DistributedSystem::prepare(Engine wanted) {
    check(MatSetOption(A_.get(), MAT_SYMMETRIC, PETSC_TRUE));
    check(MatSetOption(A_.get(), MAT_SPD, PETSC_TRUE));
    check(MatNorm(A_.get(), NORM_INFINITY, &facts_.norm));  // symmetric: the 1-norm too
    if (wanted == Engine::gamg || !prepare_mumps(wanted == Engine::mumps)) prepare_gamg();
}

/// False where the factor would not fit, by MUMPS's own plan or when it is made.
bool DistributedSystem::prepare_mumps(bool insist) {
    factor_ = made<MatHandle>(MatGetFactor, A_.get(), MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY);
    check(MatMumpsSetIcntl(factor_.get(), 14, kBeyondPlan));
    MatFactorInfo info;
    check(MatFactorInfoInitialize(&info));
    check(MatCholeskyFactorSymbolic(factor_.get(), A_.get(), nullptr, &info));
    PetscInt largest = 0, sum = 0;
    check(MatMumpsGetInfog(factor_.get(), 16, &largest));
    check(MatMumpsGetInfog(factor_.get(), 17, &sum));
    MatFactorError failure = MAT_FACTOR_NOERROR;
    if (insist || kMegabyte * largest < kForFactor * free_memory_of_a_process()) {
        check(MatCholeskyFactorNumeric(factor_.get(), A_.get(), &info));
        check(MatFactorGetError(factor_.get(), &failure));
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
    factor_.reset();
    return false;
}

void DistributedSystem::prepare_gamg() {
    attach_rigid_modes(A_.get());
    ksp_ = made<KspHandle>(KSPCreate, PETSC_COMM_WORLD);
    check(KSPSetOperators(ksp_.get(), A_.get(), A_.get()));
    check(KSPSetType(ksp_.get(), KSPCG));
    PC pc = nullptr;
    check(KSPGetPC(ksp_.get(), &pc));
    check(PCSetType(pc, PCGAMG));
    check(PCGAMGSetType(pc, PCGAMGAGG));
    check(PCGAMGSetNSmooths(pc, 1));
    check(KSPSetFromOptions(ksp_.get()));
    std::unique_ptr<void, PetscErrorCode (*)(void*)> context(default_test(), KSPConvergedDefaultDestroy);
    check(KSPSetConvergenceTest(ksp_.get(), test_convergence, context.get(), KSPConvergedDefaultDestroy));
    static_cast<void>(context.release());  // to the solver
    check(KSPSetUp(ksp_.get()));
    PetscInt levels = 0;
    check(PCMGGetLevels(pc, &levels));
    facts_.engine = Engine::gamg;
    facts_.n_levels = levels;
}

void DistributedSystem::solve(Vec b, Vec x, double tolerance) {
    if (facts_.engine == Engine::mumps) {
        check(MatSolve(factor_.get(), b, x));
        return;
    }
    check(KSPSetTolerances(ksp_.get(), tolerance, 1e-300, PETSC_DEFAULT, kMostIterations));
    check(KSPSolve(ksp_.get(), b, x));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(ksp_.get(), &reason));
    PetscInt iterations = 0;
    check(KSPGetIterationNumber(ksp_.get(), &iterations));
    facts_.iterations = std::max(facts_.iterations, static_cast<int>(iterations));
    if (Session::current().cancelled()) throw Cancelled{};
    if (reason > 0) return;
    PetscReal norm = 0.0, size = 0.0;
    check(KSPGetResidualNorm(ksp_.get(), &norm));
    check(VecNorm(b, NORM_2, &size));
    give_up_iteration("stiffness matrix", size > 0.0 ? norm / size : norm);
}

void DistributedSystem::solve_columns(const Parcel& parcel, const Order& order) {
    const VecHandle b = make_vector(), x = make_vector();
    for (Eigen::Index column = 0; column < order.n; ++column) {
        scatter(parcel.in != nullptr ? parcel.in->col(column).data() : nullptr, b.get());
        solve(b.get(), x.get(), order.tolerance);
        gather(x.get(), parcel.out != nullptr ? parcel.out->col(column).data() : nullptr);
    }
}

}  // namespace elastolab
