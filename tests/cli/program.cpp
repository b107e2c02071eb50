#include "cli/program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/wait_until.hpp"

namespace elastolab::test {

namespace fs = std::filesystem;

namespace {

void redirect(int stream, const fs::path& file) {
    const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (opened < 0 || dup2(opened, stream) < 0) _exit(127);
}

[[noreturn]] void become_program(const std::vector<std::string>& arguments, const fs::path& folder,
                                 const fs::path& outputs) {
    std::vector<char*> argv = {const_cast<char*>(ELASTOLAB_PROGRAM)};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    redirect(STDOUT_FILENO, outputs / "out");
    redirect(STDERR_FILENO, outputs / "err");
    if (chdir(folder.c_str()) == 0) execv(ELASTOLAB_PROGRAM, argv.data());
    _exit(127);
}

pid_t start_program(const std::vector<std::string>& arguments, const fs::path& folder, const fs::path& outputs) {
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot start a process");
    if (child == 0) become_program(arguments, folder, outputs);
    return child;
}

/// Whether a process has a handler for SIGINT, or has ended.
bool handles_interrupt(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);) {
        if (line.rfind("State:\tZ", 0) == 0) return true;
        if (line.rfind("SigCgt:", 0) == 0) return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1) != 0;
    }
    return true;
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, const fs::path& folder)
    : id_(start_program(arguments, folder, outputs_.path())) {}

RunningProgram::~RunningProgram() {
    if (ended()) return;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
}

bool RunningProgram::ended() {
    int status = 0;
    if (!status_ && waitpid(id_, &status, WNOHANG) == id_) status_ = status;
    return status_.has_value();
}

ProgramRun RunningProgram::wait() {
    int status = 0;
    if (!status_ && waitpid(id_, &status, 0) == id_) status_ = status;
    status = status_.value();
    return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
            .out = read_text(outputs_.path() / "out"),
            .err = read_text(outputs_.path() / "err")};
}

ProgramRun run_program(const std::vector<std::string>& arguments, const fs::path& folder) {
    return RunningProgram(arguments, folder).wait();
}

ProgramRun interrupt_program(const std::vector<std::string>& arguments, const fs::path& folder) {
    RunningProgram program(arguments, folder);
    test::wait_for([&] { return handles_interrupt(program.id()) || program.ended(); });
    if (!program.ended()) kill(program.id(), SIGINT);
    return program.wait();
}

Table read_csv(const fs::path& file) {
    std::ifstream stream(file);
    Table table;
    std::getline(stream, table.header);
    for (std::string line; std::getline(stream, line);) {
        std::istringstream fields(line);
        std::string field;
        std::getline(fields, field, ',');
        table.labels.push_back(field);
        table.rows.emplace_back();
        while (std::getline(fields, field, ',')) table.rows.back().push_back(std::stod(field));
    }
    return table;
}

NpyFile read_npy(const fs::path& file) {
    const std::string bytes = read_text(file);
    const std::string magic("\x93NUMPY\x01\x00", 8);
    if (bytes.substr(0, 8) != magic) throw std::runtime_error("not an .npy file of version 1.0");
    const std::size_t length = static_cast<unsigned char>(bytes.at(8)) + 256U * static_cast<unsigned char>(bytes.at(9));
    const std::string header = bytes.substr(10, length);
    if ((10 + length) % 64 != 0 || header.back() != '\n') throw std::runtime_error("header is not padded");
    NpyFile npy;
    const std::size_t shape = header.find("'shape': (");
    if (header.find("'descr': '<f8'") == std::string::npos || shape == std::string::npos ||
        header.find("'fortran_order': True") == std::string::npos ||
        std::sscanf(header.c_str() + shape, "'shape': (%d, %d)", &npy.rows, &npy.columns) != 2)
        throw std::runtime_error("unexpected header " + header);
    npy.values.resize(static_cast<std::size_t>(npy.rows) * static_cast<std::size_t>(npy.columns));
    if (bytes.size() != 10 + length + npy.values.size() * sizeof(double)) throw std::runtime_error("wrong size");
    bytes.copy(reinterpret_cast<char*>(npy.values.data()), npy.values.size() * sizeof(double), 10 + length);
    return npy;
}

std::string cube_scene(const std::string& method, int cells) {
    return R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": )" + std::to_string(cells) +
           R"(}, "material": {"young_modulus": 1000, "poisson_ratio": 0.3}, "method": ")" + method + R"(",
            "fixed": {"box": {"min": [0, 0, 0], "max": [0, 1, 1]}},
            "handles": [{"name": "right", "select": {"plane": {"point": [1, 0, 0], "normal": [1, 0, 0],
                         "tolerance": 1e-9}}, "translate": [0.1, 0, 0.05]}]})";
}

}  // namespace elastolab::test
