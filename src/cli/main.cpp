#include <algorithm>
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

#include "base/blas.hpp"
#include "base/blas_memory.hpp"
#include "base/error.hpp"
#include "base/stack.hpp"
#include "base/version.hpp"
#include "cli/command.hpp"
#include "cli/complaint.hpp"

namespace {

using namespace elastolab;

/// `elastolab FILE` opens the file, as programs that show files do. A command's name is always the command.
std::vector<std::string> with_command(int argc, char** argv, const std::vector<Command>& commands) {
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    if (words.empty() || words.front().starts_with('-')) return words;
    const auto names_it = [&](const Command& command) { return command.parser->get_name() == words.front(); };
    if (std::any_of(commands.begin(), commands.end(), names_it)) return words;
    std::error_code ignored;
    if (!std::filesystem::exists(words.front(), ignored))
        throw UsageError(words.front() + ": neither a command nor a file. See elastolab --help.");
    words.insert(words.begin(), commands.front().parser->get_name());
    return words;
}

/// As the parser says it, which lists them backwards.
std::string not_expected(const std::vector<std::string>& words) {
    std::string finding =
        words.size() > 1 ? "The following arguments were not expected:" : "The following argument was not expected:";
    for (const std::string& word : words) finding += " " + word;
    return finding;
}

int run(int argc, char** argv) {
    CLI::App program("Elastolab: elastic bodies by finite and boundary elements.", "elastolab");
    program.set_version_flag("--version", std::string("elastolab ") + version());
    program.require_subcommand(0, 1);
    const std::vector<Command> commands = {add_view_command(program), add_solve_command(program),
                                           add_info_command(program), add_bench_command(program),
                                           add_feel_command(program), add_thumbnail_command(program)};
    std::vector<std::string> words = with_command(argc, argv, commands);
    std::reverse(words.begin(), words.end());  // as the parser takes them
    try {
        program.parse(words);
    } catch (const CLI::Success& request) {
        return program.exit(request);  // --help and --version
    } catch (const CLI::ParseError& error) {
        const bool has_extras = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
        const std::string finding = has_extras ? not_expected(program.remaining(true)) : error.what();
        return complain(finding + (finding.ends_with('.') ? "" : ".") + " See elastolab --help.", kBadUsage);
    }
    const auto chosen =
        std::find_if(commands.begin(), commands.end(), [](const Command& command) { return command.parser->parsed(); });
    (chosen == commands.end() ? commands.front() : *chosen).run();  // the viewer, unless told otherwise
    return kSuccess;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        elastolab::ensure_stack(argv);
    } catch (const elastolab::Error& error) {
        return complain(error.what(), kFailure);
    }
    elastolab::start_blas_within_limits(argv);
    elastolab::prepare_parallel_libraries(argv);
    std::signal(SIGXFSZ, SIG_IGN);  // at the file size limit a write fails; the program is not killed
    return elastolab::exit_code_of([&] {
        elastolab::reserve_blas_buffers();
        return run(argc, argv);
    });
}
