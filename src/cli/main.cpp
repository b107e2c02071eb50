#include <algorithm>
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "base/blas.hpp"
#include "base/blas_memory.hpp"
#include "base/control.hpp"
#include "base/error.hpp"
#include "base/stack.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "scene/user_text.hpp"

namespace {

using namespace elastolab;

constexpr int kSuccess = 0;
constexpr int kFailure = 1;
constexpr int kBadUsage = 2;

int complain(const std::string& text, int exit_code) {
    std::cerr << "elastolab: " << one_line(text) << std::endl;
    return exit_code;
}

int run(int argc, char** argv) {
    CLI::App program("Elastolab: elastic bodies by finite and boundary elements.", "elastolab");
    program.set_version_flag("--version", std::string("elastolab ") + version());
    program.require_subcommand(0, 1);
    const std::vector<Command> commands = {add_view_command(program), add_solve_command(program),
                                           add_info_command(program), add_bench_command(program),
                                           add_feel_command(program), add_thumbnail_command(program)};
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& request) {
        return program.exit(request);  // --help and --version
    } catch (const CLI::ParseError& error) {
        const std::string finding = error.what();
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
    try {
        elastolab::reserve_blas_buffers();
        const int code = run(argc, argv);
        std::cout.flush();
        return std::cout ? code : complain("Standard output cannot be written. Is the disk full?", kFailure);
    } catch (const elastolab::UsageError& error) {
        return complain(error.what(), kBadUsage);
    } catch (const elastolab::Interrupted& interrupted) {
        return complain(interrupted.what(), interrupt_exit_code());
    } catch (const elastolab::Cancelled&) {
        return complain("Interrupted; no output was written.", interrupt_exit_code());
    } catch (const std::exception& error) {
        return complain(user_text(error), kFailure);
    }
}
