#include <unistd.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "base/text.hpp"
#include "cli/bench_bar.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/threads.hpp"
#include "study/runner.hpp"

namespace elastolab {

namespace {

/// What the command line says, word for word.
struct BenchOptions {
    std::string study, folder;
    bool quick = false, fresh = false, report = false, quiet = false;
    unsigned seed = 1;
    int threads = 0;
};

std::string study_list() {
    std::string text = "Studies:\n";
    for (const StudyEntry& entry : studies())
        text += "  " + entry.name + std::string(12 - entry.name.size(), ' ') + entry.description + "\n";
    return text +
           "Each writes STUDY.csv, plots (SVG and PNG, drawn by gnuplot from scripts beside them) and README.md.\n"
           "Finished cases of a stopped run are kept in STUDY.partial.csv, and the same command resumes from there.";
}

void add_options(CLI::App& parser, BenchOptions& options) {
    std::vector<std::string> names;
    for (const StudyEntry& entry : studies()) names.push_back(entry.name);
    parser.add_option("study", options.study, "which study")->required()->check(CLI::IsMember(names));
    parser.add_option("--out", options.folder, "folder for the results, made when it is missing (default bench-STUDY)")
        ->check([](const std::string& text) { return std::string(text.empty() ? "the name is empty" : ""); });
    parser.add_flag("--quick", options.quick, "small sizes: about a minute");
    CLI::Option* seed = parser.add_option(
        "--seed", options.seed, "random seed of the constrained nodes (paper) and the edits (stability) (default 1)");
    add_threads_option(parser, options.threads);
    CLI::Option* fresh = parser.add_flag("--fresh", options.fresh, "start over instead of resuming a stopped run");
    parser.add_flag("--report", options.report, "run nothing; plots and report again from the existing table")
        ->excludes(seed)
        ->excludes(fresh);
    parser.add_flag("--quiet", options.quiet, "no list of cases and no progress bar");
    parser.footer(study_list());
}

const StudyEntry& entry_of(const std::string& name) {
    return *std::find_if(studies().begin(), studies().end(), [&](const auto& entry) { return entry.name == name; });
}

RunSettings settings_of(const BenchOptions& options) {
    RunSettings settings;
    settings.folder = options.folder;
    settings.options = {.quick = options.quick, .seed = options.seed};
    settings.fresh = options.fresh;
    settings.report_only = options.report;
    settings.on_notice = [](const std::string& text) { std::cerr << "elastolab: " << one_line(text) << std::endl; };
    // On a terminal there is the bar; a log gets a line for each case.
    if (!options.quiet && isatty(STDERR_FILENO) == 0)
        settings.on_case = [](const std::string& key, double seconds) {
            std::cout << key << ": " << readable_seconds(seconds) << std::endl;
        };
    return settings;
}

RunResult run_with_bar(const Study& study, const RunSettings& settings, bool with_bar, Control& control) {
    StudyProgress progress;
    const BenchBar bar(progress, with_bar);
    try {
        return run_study(study, settings, progress, control);
    } catch (const Cancelled&) {
        const StudyState state = progress.state();
        if (state.n_cases == 0) throw Interrupted("Interrupted before the first case.");  // or while a report is made
        throw Interrupted("Interrupted after " + std::to_string(state.n_done) + " of " + std::to_string(state.n_cases) +
                          " cases, which are kept: the same command resumes from there.");
    }
}

void run_bench(BenchOptions options) {
    if (options.folder.empty()) options.folder = "bench-" + options.study;
    Control control;
    const InterruptGuard interrupt(control,
                                   "Interrupted; finished cases are kept: the same command resumes from there.");
    apply_threads_option(options.threads);
    const RunSettings settings = settings_of(options);
    const RunResult result =
        run_with_bar(entry_of(options.study).make(settings.options), settings, !options.quiet, control);
    for (const std::string& warning : result.warnings) std::cerr << "elastolab: warning: " << one_line(warning) << "\n";
    if (options.quiet) return;
    std::cout << "Wrote " << result.files.size() << " files, " << result.table.rows.size() << " rows:\n";
    for (const auto& file : result.files)
        if (file.extension() == ".csv" || file.extension() == ".md") std::cout << "  " << file.string() << "\n";
}

}  // namespace

Command add_bench_command(CLI::App& program) {
    const auto options = std::make_shared<BenchOptions>();
    CLI::App* parser = program.add_subcommand("bench", "runs a study and writes its table, plots and report");
    add_options(*parser, *options);
    return {parser, [options] { run_bench(*options); }};
}

}  // namespace elastolab
