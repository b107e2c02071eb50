#include <algorithm>
#include <CLI/CLI.hpp>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "base/blas.hpp"
#include "base/blas_memory.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/stack.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "cli/command.hpp"
#include "cli/complaint.hpp"
#include "cli/interrupt.hpp"
#include "petsc/growth_command.hpp"
#include "petsc/method.hpp"
#include "petsc/model.hpp"
#include "petsc/session.hpp"
#include "scene/solve.hpp"
#include "scene/user_text.hpp"

namespace {

using namespace elastolab;

/// That a process other than the first has to be sent home after its Ctrl-C [s]; more than the first has itself.
constexpr double kServingGraceSeconds = 3.0;

MethodKind distributed_method(MethodKind kind) {
    if (const MethodKind other = distributed(kind)) return other;
    throw UsageError("--method " + std::string(name(kind)) +
                     ": runs on one process only, by elastolab solve. Choose fem or quadratic-fem.");
}

/// What solved each solid, and on how many processes.
void print_engine(std::ostream& out, const Solution& solution) {
    const Session& session = Session::current();
    for (const Model::Part& part : solution.model->parts()) {
        const auto* model = dynamic_cast<const PetscFemModel*>(part.solid.get());
        if (model == nullptr) continue;
        const SolverFacts& facts = model->solver_facts();
        out << "  engine        ";
        if (facts.engine == Engine::mumps)
            out << "MUMPS, factor within " << readable_bytes(facts.factor_bytes);
        else
            out << "conjugate gradients with GAMG, " << facts.n_levels << " levels, at most " << facts.iterations
                << " iterations a column";
        out << ", " << session.n_processes() << (session.n_processes() == 1 ? " process\n" : " processes\n");
    }
}

void add_engine_option(CLI::App& parser) {
    const std::map<std::string, Engine> engines = {
        {"auto", Engine::automatic}, {"mumps", Engine::mumps}, {"gamg", Engine::gamg}};
    parser
        .add_option("--engine", Session::current().engine,
                    "mumps: a factor; gamg: conjugate gradients with multigrid; auto: the factor where it fits into "
                    "memory (default)")
        ->transform(CLI::CheckedTransformer(engines));
}

/// The first process runs a command and gives orders; the others run what all run alike, and follow.
int run(int argc, char** argv) {
    const Session& session = Session::current();
    CLI::App program("Elastolab's FEM on several processes, by MPI and PETSc.", "elastolab-petsc");
    program.set_version_flag("--version", std::string("elastolab-petsc ") + version());
    program.require_subcommand(1, 1);
    const Command solve = add_solve_command(program, {distributed_method, print_engine});
    const Command grow = add_growth_command(program);
    add_engine_option(*solve.parser);
    add_engine_option(*grow.parser);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (!session.first()) return kSuccess;
        if (error.get_exit_code() == 0) return program.exit(error);  // --help and --version
        const std::string finding = error.what();
        return complain(finding + (finding.ends_with('.') ? "" : ".") + " See elastolab-petsc --help.", kBadUsage);
    }
    if (grow.parser->parsed())
        grow.run();
    else if (session.first())
        solve.run();
    return kSuccess;
}

/// A signal to one process ends all: it cancels what runs, for which the first one has words. Where that cannot be
/// stopped, this process ends in silence, and mpirun ends the others.
void serve(Session& session) {
    Control control;
    const InterruptGuard interrupt(control, "", {}, kServingGraceSeconds);
    session.serve(control);
}

}  // namespace

int main(int argc, char** argv) {
    set_program_name("elastolab-petsc");
    try {
        ensure_stack(argv);
        start_blas_within_limits(argv);
        prepare_parallel_libraries(argv);
        reserve_blas_buffers();
        Session session;
        set_thread_count(std::max(1, thread_count() / session.n_on_this_machine()));
        const int code = exit_code_of([&] { return run(argc, argv); }, !session.first());
        if (session.first()) return code;
        serve(session);
        return kSuccess;
    } catch (const std::exception& error) {
        return complain(user_text(error), kFailure);
    }
}
