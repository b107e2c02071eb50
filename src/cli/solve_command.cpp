#include <unistd.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <span>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/proxy_options.hpp"
#include "cli/report.hpp"
#include "cli/solve_outputs.hpp"
#include "cli/threads.hpp"
#include "methods/choices.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"
#include "scene/solve.hpp"

namespace elastolab {

namespace {

namespace fs = std::filesystem;

/// What the command line says, word for word.
struct SolveOptions {
    std::string scene, method, mode, tractions, elements, update;
    std::string displacements, fields, mesh_out, forces, report, matrices, figure;
    ProxyOptions proxy;
    int rims = 0, threads = 0;
    bool deformed = false, quiet = false;

    OutputPaths outputs() const {
        return {.displacements = displacements,
                .fields = fields,
                .mesh = mesh_out,
                .forces = forces,
                .report = report,
                .figure = figure,
                .matrices = matrices,
                .mesh_points = deformed ? VtkPoints::moved : VtkPoints::at_rest};
    }
};

void add_options(CLI::App& parser, SolveOptions& options) {
    const CLI::IsMember methods(method_names());
    const CLI::IsMember modes({"on-demand", "full", "full-volume"});
    const CLI::IsMember tractions({"discontinuous", "restricted", "continuous"});
    const CLI::IsMember updates({"direct", "eqn9", "reduced"});
    const CLI::Validator path([](std::string& text) { return text.empty() ? "the name is empty" : ""; }, "PATH");
    parser.add_option("scene", options.scene, "scene file")->required()->check(path);
    parser.add_option("--method", options.method, "default: the scene's own")->check(methods);
    parser.add_option("--mode", options.mode, "what is computed ahead (default on-demand; full-volume is FEM's)")
        ->check(modes);
    parser.add_option("--tractions", options.tractions, "traction space of linear BEM (default discontinuous)")
        ->check(tractions);
    parser.add_option("--elements", options.elements, "of nonlinear FEM: ten nodes or four (default quadratic)")
        ->check(CLI::IsMember({"quadratic", "linear"}));
    parser
        .add_option("--rims", options.rims,
                    "of Galerkin BEM: rows of thin triangles to add along the rims of constrained patches (default 0)")
        ->check(CLI::Range(0, kMostRims));
    parser
        .add_option("--update", options.update,
                    "direct: Eqn. 7; eqn9: Eqn. 9; reduced: its collapsed form (default: reduced; on-demand: direct)")
        ->check(updates);
    parser.add_option("--displacements", options.displacements, "CSV: rest positions and displacements")->check(path);
    parser
        .add_option("--mesh-out", options.mesh_out,
                    "deformed mesh: .obj, .stl or, with fields, .ply; for ParaView .vtp or .vtu (inside): at rest, "
                    "with the displacement as a field; .glb: with morph targets")
        ->check(path);
    parser.add_flag("--deformed", options.deformed, "points of .vtp and .vtu where they have moved to");
    parser.add_option("--figure", options.figure, "HTML: the body, to be pulled in a browser without network")
        ->check(path);
    parser.add_option("--fields", options.fields, "CSV: displacement, stress and traction of every vertex")
        ->check(path);
    parser.add_option("--forces", options.forces, "CSV: force and moment of every handle and of the fixed sets")
        ->check(path);
    parser.add_option("--report", options.report, "JSON: sizes, times, memory, accuracy, warnings")->check(path);
    parser.add_option("--matrices", options.matrices, "folder for the matrices that the mode keeps (.npy, .mtx)")
        ->check(path);
    options.proxy.add_to(parser);
    add_threads_option(parser, options.threads);
    parser.add_flag("--quiet", options.quiet, "no summary and no progress bar");
}

/// The parser has checked the names already.
template <class Value, class Parse>
void choose(Value& value, const std::string& word, const Parse& parse) {
    if (!word.empty()) value = parse(word).value();
}

/// Refuses choices that exclude each other.
void require_sensible(const Method& method, bool with_matrices) {
    constexpr double kAnyMaterial = 0.3;  // that of the scene is judged with the scene
    if (const std::string why = refusal(method, kAnyMaterial); !why.empty())
        throw UsageError("--method " + std::string(name(method.kind)) + ": " + why);
    if (with_matrices && method.mode == Mode::on_demand && !method.kind->sparse)
        throw UsageError("--matrices: the mode on-demand keeps none for " + std::string(name(method.kind)) +
                         ". Add --mode full.");
}

Method choose_method(const SolveOptions& options, const Document& document, const SolveVariant& variant) {
    Method method;
    method.kind = document.method;
    choose(method.kind, options.method, parse_method_kind);
    if (variant.method) method.kind = variant.method(method.kind);
    choose(method.mode, options.mode, parse_mode);
    choose(method.tractions, options.tractions, parse_tractions);
    choose(method.update, options.update, parse_update);
    if (method.kind->chooses_elements) choose(method.elements, options.elements, parse_elements);
    if (method.kind->chooses_rims) method.rims = options.rims;
    require_sensible(method, !options.matrices.empty());
    return method;
}

Solution solve_with_progress(const SolveRequest& request, Control& control, bool with_bar) {
    const ProgressBar bar(control, with_bar);
    try {
        return solve(request, control);
    } catch (const Error&) {
        control.checkpoint();  // Ctrl-C ends helper processes too, which is no error then
        throw;
    }
}

/// Whether the file is one of VTK's, which have points at rest or where they have moved to.
bool has_points(const std::filesystem::path& mesh) {
    const std::string extension = lower_case(mesh.extension().string());
    return extension == ".vtp" || extension == ".vtu";
}

void run_solve(const SolveOptions& options, const SolveVariant& variant) {
    Control control;
    const InterruptGuard interrupt(control);
    apply_threads_option(options.threads);
    SolveRequest request;
    request.scene_file = options.scene;
    request.document = load_scene(request.scene_file);
    options.proxy.apply(request.document.proxy);
    request.method = choose_method(options, request.document, variant);
    request.solve_once = options.update.empty() && request.method.mode == Mode::on_demand;
    request.with_checks = !options.quiet || !options.report.empty();
    require_writable(options.outputs(), files_of_scene(request.scene_file, request.document.mesh));
    require_inside(request.method.kind, options.mesh_out);
    if (options.deformed && !has_points(options.mesh_out))
        throw UsageError("--deformed: there is no .vtp or .vtu whose points it could move. Add --mesh-out FILE.vtp.");
    require_figure(request.method.kind, request.document, options.outputs());

    Solution solution = solve_with_progress(request, control, !options.quiet);
    const ChoicesForSome given{!options.tractions.empty(), !options.elements.empty(), options.rims > 0};
    for (Finding& left_aside : choices_left_aside(given, request.method.kind, "--"))
        solution.findings.push_back(std::move(left_aside));
    write_outputs(options.outputs(), solution, control);
    if (options.quiet) return;
    lseek(STDOUT_FILENO, 0, SEEK_END);  // after an output that went to /dev/stdout, if that is a file
    print_summary(std::cout, request, solution);
    if (variant.summary) variant.summary(std::cout, solution);
}

}  // namespace

Command add_solve_command(CLI::App& program, SolveVariant variant) {
    const auto options = std::make_shared<SolveOptions>();
    CLI::App* parser = program.add_subcommand("solve", "computes the displacements of a scene, without a window");
    add_options(*parser, *options);
    return {parser, [options, variant = std::move(variant)] { run_solve(*options, variant); }};
}

}  // namespace elastolab
