#include "petsc/growth_command.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/timer.hpp"
#include "petsc/distributed_system.hpp"
#include "petsc/session.hpp"

namespace elastolab {

namespace {

constexpr int kMostCells = 893;  ///< (cells + 1)^3 nodes, whose unknowns 32 bits count

struct GrowthOptions {
    int cells = 16, degree = 1;
    double poisson_ratio = 0.3, tolerance = 1e-8;
    bool heading = false;
};

/// A force on the top of the cube, along x, the same at each of its nodes: one in all.
void pull_top(const DistributedSystem& system, int first, int n_all, int n_layer, Vec b) {
    double* values = nullptr;
    check(VecGetArray(b, &values));
    for (int i = 0; i < system.n_own(); ++i)
        if (first + i >= n_all - n_layer) values[3 * i] = 1.0 / n_layer;
    check(VecRestoreArray(b, &values));
}

void run_growth(const GrowthOptions& options) {
    Session& session = Session::current();
    const bool quadratic = options.degree == 2;
    const int n = (quadratic ? 2 : 1) * options.cells + 1, n_layer = n * n;
    if (3.0 * n * n_layer >= 2147483648.0)
        throw UsageError("--cells: more than 2^31 unknowns by elements of this degree. Choose at most " +
                         std::to_string(quadratic ? kMostCells / 2 : kMostCells) + ".");
    const Stopwatch assembling;
    Share share;
    std::vector<int> bottom;
    session.all_or_none([&] {
        share = share_of_grid(session.process(), session.n_processes(), options.cells,
                              quadratic ? ElementDegree::quadratic : ElementDegree::linear, options.poisson_ratio);
        bottom.resize(static_cast<std::size_t>(n_layer));
        std::iota(bottom.begin(), bottom.end(), 0);
    });
    const int first = share.first, n_all = share.n_all;
    DistributedSystem system;
    system.assemble(std::move(share));
    const double assembled = session.largest(assembling.seconds());

    const Stopwatch preparing;
    system.eliminate(bottom);
    system.prepare(session.engine);
    const double prepared = session.largest(preparing.seconds());

    const VecHandle b = system.make_vector(), x = system.make_vector();
    pull_top(system, first, n_all, n_layer, b.get());
    const Stopwatch solving;
    system.solve(b.get(), x.get(), options.tolerance);
    const double solved = session.largest(solving.seconds());
    double work = 0.0;
    check(VecDot(b.get(), x.get(), &work));  // the displacement of the top, on average
    const double memory = session.sum(static_cast<double>(peak_memory_bytes()));
    if (!session.first()) return;
    if (options.heading)
        std::cout << "unknowns,degree,processes,engine,levels,iterations,assemble_s,prepare_s,solve_s,memory_bytes,"
                     "displacement\n";
    const SolverFacts& facts = system.facts();
    std::cout << 3 * n_all << ',' << options.degree << ',' << session.n_processes() << ','
              << (facts.engine == Engine::mumps ? "mumps" : "gamg") << ',' << facts.n_levels << ',' << facts.iterations
              << ',' << assembled << ',' << prepared << ',' << solved << ',' << memory << ',';
    std::cout.precision(12);
    std::cout << work << std::endl;
}

}  // namespace

Command add_growth_command(CLI::App& program) {
    const auto options = std::make_shared<GrowthOptions>();
    CLI::App* parser = program.add_subcommand("grow", "measures a cube of a structured grid: a line of CSV");
    parser->add_option("--cells", options->cells, "cubes of six tetrahedra along an edge (default 16)")
        ->check(CLI::Range(1, kMostCells));
    parser->add_option("--degree", options->degree, "of the elements (default 1)")->check(CLI::Range(1, 2));
    parser->add_option("--tolerance", options->tolerance, "relative residual of conjugate gradients (default 1e-8)")
        ->check(CLI::Range(1e-14, 1e-1));
    parser->add_flag("--heading", options->heading, "prints the columns' names first");
    return {parser, [options] { run_growth(*options); }};
}

}  // namespace elastolab
