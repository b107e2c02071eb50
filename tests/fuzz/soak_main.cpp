// soak_program: random edits and drags in the real window, round after round, each undone at its end. Memory, open
// files and threads must be level: what they are at rest in the last third of the rounds is what they were in the
// second (the first warms up). The allocator is told to return what is freed: what it keeps else differs by 50 MB from
// one round to the next.
//   soak_program [--seconds S] [--seed K]
#include <algorithm>
#include <chrono>
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>

#include "app/real_window.hpp"
#include "fuzz/random.hpp"

namespace elastolab::test {
namespace {

namespace fs = std::filesystem;
using fuzz::Random;

constexpr int kActsOfARound = 12;
constexpr std::size_t kFewestRounds = 9;
const Eigen::Vector2d kWindow(1000, 700);
constexpr double kTop = 40.0;           ///< below the menu, in which one can quit
constexpr double kMemoryGrowth = 24e6;  ///< bytes that memory may be above: heaps are never exactly level
constexpr int kDescriptorGrowth = 2, kThreadGrowth = 2;
constexpr const char* kReturnsWhatIsFreed =
    "glibc.malloc.arena_max=2:glibc.malloc.mmap_threshold=65536:glibc.malloc.trim_threshold=65536";

/// What the program holds at rest.
struct Level {
    double memory = 0.0;  ///< bytes of its own
    int descriptors = 0, threads = 0;
};

int count_entries(const fs::path& folder) {
    return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

Level level_of(pid_t process) {
    const fs::path folder = "/proc/" + std::to_string(process);
    Level level{0.0, count_entries(folder / "fd"), count_entries(folder / "task")};
    std::ifstream status(folder / "status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("RssAnon:") || line.starts_with("RssShmem:"))
            level.memory += 1024.0 * std::stod(line.substr(line.find(':') + 1));
    return level;
}

/// With the least memory of some looks: an estimate of the error, which begins at rest, is none that is kept.
Level level_at_rest(pid_t process) {
    constexpr int kLooks = 3;
    constexpr std::chrono::milliseconds kBetween(400);
    Level level = level_of(process);
    for (int look = 1; look < kLooks; ++look) {
        std::this_thread::sleep_for(kBetween);
        level.memory = std::min(level.memory, level_of(process).memory);
    }
    return level;
}

Eigen::Vector2d random_place(Random& random) {
    return {random.unit() * kWindow.x(), kTop + random.unit() * (kWindow.y() - kTop)};
}

void drag_somewhere(RealWindow& window, Random& random) {
    const Eigen::Vector2d from = random_place(random), to = random_place(random);
    const int button = 1 + static_cast<int>(random.below(3));
    window.drag(from, to, button);
}

void scroll_somewhere(RealWindow& window, Random& random) {
    const int button = 4 + static_cast<int>(random.below(2));
    const Eigen::Vector2d at = random_place(random);
    window.drag(at, at, button);
}

/// A dialog that it opens is closed at once: no round may write a file.
void click_somewhere(RealWindow& window, Random& random) {
    window.click(random_place(random));
    window.key("Escape");
}

void press_a_key(RealWindow& window, Random& random) {
    constexpr std::array kKeys = {"1",           "2",           "3", "v",  "b",      "n",      "f",      "c",
                                  "g",           "w",           "t", "F1", "ctrl+z", "ctrl+y", "Delete", "shift+Delete",
                                  "bracketleft", "bracketright"};
    window.key(random.pick(kKeys));
}

void act(RealWindow& window, Random& random) {
    switch (random.below(8)) {
        case 0:
            click_somewhere(window, random);
            break;
        case 1:
        case 2:
            press_a_key(window, random);
            break;
        case 3:
            scroll_somewhere(window, random);
            break;
        case 4:
            window.resize(600 + static_cast<int>(random.below(600)), 400 + static_cast<int>(random.below(400)));
            break;
        default:
            drag_somewhere(window, random);
    }
}

/// Back to the scene as it was opened, in a window of the same size.
void undo_all(RealWindow& window) {
    window.key("Escape");
    window.key("Escape");
    window.resize(static_cast<int>(kWindow.x()), static_cast<int>(kWindow.y()));
    window.key("ctrl+z", 4 * kActsOfARound);
    window.settle();
}

/// The largest of a measure in rounds from first on, up to last.
template <class Measure>
double largest(const std::vector<Level>& levels, std::size_t first, std::size_t last, const Measure& measure) {
    double result = 0.0;
    for (std::size_t i = first; i < last; ++i) result = std::max(result, static_cast<double>(measure(levels[i])));
    return result;
}

template <class Measure>
bool is_level(const std::vector<Level>& levels, const char* name, double most, const Measure& measure) {
    const std::size_t n = levels.size();
    const double before = largest(levels, n / 3, 2 * n / 3, measure), after = largest(levels, 2 * n / 3, n, measure);
    std::cout << "  " << name << ": " << before << ", later " << after << " (";
    for (const Level& level : levels) std::cout << " " << static_cast<double>(measure(level));
    std::cout << " )\n";
    return after - before <= most;
}

bool are_level(const std::vector<Level>& levels) {
    const bool memory = is_level(levels, "memory [bytes]", kMemoryGrowth, [](const Level& l) { return l.memory; });
    const bool files = is_level(levels, "open files", kDescriptorGrowth, [](const Level& l) { return l.descriptors; });
    const bool threads = is_level(levels, "threads", kThreadGrowth, [](const Level& l) { return l.threads; });
    return memory && files && threads;
}

int soak(double seconds, std::uint64_t seed) {
    const TemporaryFolder folder;
    folder.write("cube.json", cube_scene("fem", 4));
    for (const char* name : {"HOME", "XDG_STATE_HOME"}) setenv(name, folder.path().c_str(), 1);
    setenv("GLIBC_TUNABLES", kReturnsWhatIsFreed, 1);
    RealWindow window({"cube.json", "--size", "1000x700"}, folder.path());
    window.settle();
    std::vector<Level> levels;
    Random random(seed);
    const auto begin = std::chrono::steady_clock::now();
    while (levels.size() < kFewestRounds ||
           std::chrono::steady_clock::now() - begin < std::chrono::duration<double>(seconds)) {
        for (int i = 0; i < kActsOfARound; ++i) act(window, random);
        undo_all(window);
        levels.push_back(level_at_rest(window.process()));
    }
    std::cout << levels.size() << " rounds of " << kActsOfARound << " acts\n";
    const bool good = are_level(levels);
    const ProgramRun run = window.quit();
    if (run.exit_code != 0 || !run.err.empty()) std::cout << "ended with " << run.exit_code << ": " << run.err << "\n";
    return good && run.exit_code == 0 && run.err.empty() ? 0 : 1;
}

int run_soak(int argc, char** argv) {
    CLI::App parser("Random edits and drags in the real window.", "soak_program");
    double seconds = 20.0;
    std::uint64_t seed = 1;
    parser.add_option("--seconds", seconds, "how long");
    parser.add_option("--seed", seed, "of the acts");
    CLI11_PARSE(parser, argc, argv);
    return soak(seconds, seed);
}

}  // namespace
}  // namespace elastolab::test

int main(int argc, char** argv) {
    try {
        return elastolab::test::run_soak(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "soak_program: " << error.what() << "\n";
        return 1;
    }
}
