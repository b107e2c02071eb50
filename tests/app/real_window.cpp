#include "app/real_window.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "app/x11_client.hpp"

namespace elastolab::test {

namespace {

using namespace std::chrono_literals;

/// In a row: a program that sleeps between frames, for 100 ms at most on a quiet machine, works at one of them.
constexpr int kSleepingLooks = 8;
constexpr int kSleepingLooksOfAFrame = 2;
constexpr auto kLookEvery = 25ms;
constexpr int kMaxLooks = 4800;          ///< a program that does not come to rest hangs
constexpr double kListenSeconds = 1e-3;  ///< that it works between two looks without drawing: it listens for fingers

std::vector<std::string> with_command(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "view");
    return arguments;
}

std::string output_of(const std::string& command) {
    FILE* const pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error(command + ": cannot be run");
    std::string text;
    for (std::array<char, 256> part{}; fgets(part.data(), part.size(), pipe) != nullptr;) text += part.data();
    if (pclose(pipe) != 0) throw std::runtime_error(command + ": failed");
    return text;
}

/// Fields of a stat file of /proc from the state on ("S", parent, ...); empty when the process is gone.
std::vector<std::string> stat_fields(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    const std::size_t end_of_name = text.rfind(')');
    if (end_of_name == std::string::npos) return {};
    std::istringstream rest(text.substr(end_of_name + 1));
    return {std::istream_iterator<std::string>(rest), {}};
}

}  // namespace

RealWindow::RealWindow(std::vector<std::string> arguments, const std::filesystem::path& folder)
    : program_(with_command(std::move(arguments)), folder) {
    const std::string search =
        "timeout 60 xdotool search --sync --onlyvisible --pid " + std::to_string(program_.id()) + " 2>&1 | tail -1";
    id_ = output_of(search);
    while (!id_.empty() && id_.back() == '\n') id_.pop_back();
    if (id_.empty()) throw std::runtime_error("there is no window");
    tell("windowfocus --sync " + id_);
}

void RealWindow::tell(const std::string& command) const { output_of("timeout 60 xdotool " + command + " 2>&1"); }

std::string RealWindow::moved_to(const Eigen::Vector2d& cursor) const {
    return "mousemove --window " + id_ + " " + std::to_string(std::lround(cursor.x())) + " " +
           std::to_string(std::lround(cursor.y()));
}

void RealWindow::move(const Eigen::Vector2d& cursor) { tell(moved_to(cursor)); }

/// All by one process: a process for each event takes more of the machine than the program that it drives.
void RealWindow::drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int button) {
    constexpr const char* kPause = " sleep 0.03 ";
    const std::string number = std::to_string(button);
    std::string events = moved_to(from) + kPause + "mousedown " + number + kPause;
    if (from != to)
        for (const double part : {0.2, 0.4, 0.6, 0.8, 1.0}) events += moved_to(from + part * (to - from)) + kPause;
    tell(events + "mouseup " + number);
}

void RealWindow::key(const std::string& name, int times) {
    std::string command = "key";
    for (int i = 0; i < times; ++i) command += " " + name;
    tell(command);
}

void RealWindow::stroke(const std::string& name) {
    const std::size_t plus = name.find('+');
    const std::string held = name.substr(0, plus), struck = plus == std::string::npos ? name : name.substr(plus + 1);
    tell(held == name ? "key " + struck : "keydown " + held + " key " + struck + " keyup " + held);
    settle(kSleepingLooksOfAFrame);
}

void RealWindow::type(const std::string& text) {
    tell("type --delay 20 '" + text + "'");
    key("Return");
}

void RealWindow::type_into(const Eigen::Vector2d& field, const std::string& text) {
    click(field);
    stroke("ctrl+a");
    type(text);
    settle();
}

void RealWindow::resize(int width, int height) {
    tell("windowsize " + id_ + " " + std::to_string(width) + " " + std::to_string(height));
}

void RealWindow::close() { ask_to_close(std::stoul(id_)); }
void RealWindow::drop(const std::filesystem::path& file) { drop_file(std::stoul(id_), file); }

RealWindow::Activity RealWindow::activity() const {
    Activity now;
    std::error_code gone;
    for (const auto& task :
         std::filesystem::directory_iterator("/proc/" + std::to_string(program_.id()) + "/task", gone)) {
        const std::vector<std::string> fields = stat_fields(task.path() / "stat");
        if (!fields.empty() && fields[0] != "S") now.sleeps = false;
        if (!read_text(task.path() / "children").empty()) now.sleeps = false;  // a helper program works for it
        now.seconds += 1e-9 * std::strtod(read_text(task.path() / "schedstat").c_str(), nullptr);
    }
    return now;
}

void RealWindow::settle() { settle(kSleepingLooks); }

void RealWindow::settle(int sleeping_looks) {
    double before = -1.0;
    int n_sleeping = 0;
    for (int look = 0; n_sleeping < sleeping_looks; ++look) {
        if (program_.ended()) {
            const ProgramRun run = program_.wait();
            throw std::runtime_error("the program has ended with code " + std::to_string(run.exit_code) + ": " +
                                     run.err);
        }
        if (look == kMaxLooks) throw std::runtime_error("the program does not come to rest");
        std::this_thread::sleep_for(kLookEvery);
        const Activity now = activity();
        n_sleeping = now.sleeps && std::abs(now.seconds - before) < kListenSeconds ? n_sleeping + 1 : 0;
        before = now.seconds;
    }
}

ProgramRun RealWindow::quit() {
    key("ctrl+q");
    return program_.wait();
}

double RealWindow::processor_seconds() const {
    const std::vector<std::string> fields = stat_fields("/proc/" + std::to_string(program_.id()) + "/stat");
    if (fields.size() < 13) return 0.0;
    return (std::stod(fields[11]) + std::stod(fields[12])) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace elastolab::test
