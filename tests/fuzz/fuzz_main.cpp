// fuzz_program: feeds mutated meshes, scenes and replays to the program, and tells of each that it does not bear.
//   fuzz_program --program ELASTOLAB --seeds FOLDER [--seconds S | --inputs N] [--seed K] [--keep FOLDER]
//   fuzz_program --program ELASTOLAB --seeds FOLDER --bodies ...       bodies made at random in place of mutated files
//   fuzz_program --program ELASTOLAB --seeds FOLDER --replay FOLDER    every file of a folder, in every way
// Exit code 1 when there is a find; its input is kept in the folder, and seed and number bring it back.
#include <atomic>
#include <chrono>
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "fuzz/body_maker.hpp"
#include "fuzz/mutator.hpp"
#include "fuzz/subject.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Options {
    std::string program, seeds, replay, keep = "fuzz-finds", only;
    double seconds = 60.0, slowness = 1.0;
    std::uint64_t n_inputs = 0, seed = 1, first = 0;
    bool all_accepted = false, bodies = false;
    std::uint64_t ways = Subject::n_variants();
    int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

void add_options(CLI::App& parser, Options& options) {
    parser.add_option("--program", options.program, "the elastolab binary")->required()->check(CLI::ExistingFile);
    parser.add_option("--seeds", options.seeds, "folder of sound files")->required()->check(CLI::ExistingDirectory);
    parser.add_option("--replay", options.replay, "folder of files to try as they are")->check(CLI::ExistingDirectory);
    parser.add_flag("--all-accepted", options.all_accepted, "of --replay: that a file is refused is a find");
    parser.add_option("--ways", options.ways, "of --replay: in how many of the ways, others for each file")
        ->check(CLI::Range(std::uint64_t{1}, options.ways));
    parser.add_option("--keep", options.keep, "folder for the finds");
    parser.add_option("--only", options.only, "seeds whose name has this part");
    parser.add_flag("--bodies", options.bodies, "bodies and scenes made at random in place of mutated files");
    parser.add_option("--seconds", options.seconds, "how long");
    parser.add_option("--inputs", options.n_inputs, "how many, in place of how long");
    parser.add_option("--seed", options.seed, "of the mutations");
    parser.add_option("--first", options.first, "number of the first input");
    parser.add_option("--jobs", options.jobs, "programs at a time")->check(CLI::Range(1, 1024));
    parser.add_option("--slowness", options.slowness,
                      "factor on the time limit, for slow machines (from 10 on: sanitizers)");
}

/// What happened so far; all threads write into it.
class Tally {
public:
    explicit Tally(fs::path keep) : keep_(std::move(keep)) {}

    void add(const Input& input, const Outcome& outcome, const std::string& name) {
        const std::lock_guard lock(mutex_);
        Count& count = counts_[fs::path(input.name).extension().string()];
        ++(outcome.accepted ? count.accepted : count.refused);
        if (outcome.cpu_seconds > slowest_) {
            slowest_ = outcome.cpu_seconds;
            slowest_name_ = name;
        }
        if (!outcome.complaint.empty()) report(input, outcome, name);
    }

    int n_finds() const { return n_finds_; }

    void print(double seconds) const {
        int n = 0;
        for (const auto& [format, count] : counts_) {
            std::cout << "  " << format << ": " << count.accepted << " accepted, " << count.refused << " refused\n";
            n += count.accepted + count.refused;
        }
        std::cout << n << " inputs in " << std::lround(seconds) << " s, " << n_finds_ << " finds, slowest "
                  << slowest_name_ << " with " << slowest_ << " s of the processor\n";
    }

private:
    struct Count {
        int accepted = 0, refused = 0;
    };

    void report(const Input& input, const Outcome& outcome, const std::string& name) {
        ++n_finds_;
        std::cout
            << name << ": " << outcome.complaint << "\n  " << outcome.command << "\n  "
            << nlohmann::json(outcome.err.substr(0, 400)).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)
            << std::endl;
        if (keep_.empty()) return;
        fs::create_directories(keep_);
        std::ofstream(keep_ / (name + fs::path(input.name).extension().string()), std::ios::binary) << input.bytes;
        for (const Seed& file : input.beside) {
            fs::create_directories(keep_ / name);
            std::ofstream(keep_ / name / file.name, std::ios::binary) << file.bytes;
        }
    }

    fs::path keep_;
    std::mutex mutex_;
    std::map<std::string, Count> counts_;
    int n_finds_ = 0;
    double slowest_ = 0.0;
    std::string slowest_name_ = "none";
};

/// Runs work(subject, next number) on several threads until it returns false.
template <class Work>
void on_all_jobs(const Options& options, const Work& work) {
    std::atomic<std::uint64_t> next = options.first;
    std::vector<std::thread> threads;
    for (int job = 0; job < options.jobs; ++job)
        threads.emplace_back([&] {
            const test::TemporaryFolder folder;
            Subject subject(options.program, options.seeds, folder.path() / "run", options.slowness);
            while (work(subject, next++)) {
            }
        });
    for (std::thread& thread : threads) thread.join();
}

/// So that an input is always tried in the same way (FNV-1a).
std::size_t variant_of(const Input& input) {
    std::uint64_t hash = 14695981039346656037ULL;
    for (const char c : input.bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return hash % Subject::n_variants();
}

void fuzz(const Options& options, Tally& tally) {
    std::vector<Seed> seeds = load_seeds(options.seeds);
    std::erase_if(seeds, [&](const Seed& seed) { return seed.name.find(options.only) == std::string::npos; });
    if (seeds.empty()) throw std::runtime_error("--only " + options.only + ": no seed has such a name");
    const auto begin = Clock::now();
    on_all_jobs(options, [&](Subject& subject, std::uint64_t number) {
        const bool goes_on = options.n_inputs > 0
                                 ? number - options.first < options.n_inputs
                                 : Clock::now() - begin < std::chrono::duration<double>(options.seconds);
        if (!goes_on) return false;
        const Input input = options.bodies ? make_body(options.seed, number) : make_input(seeds, options.seed, number);
        tally.add(input, subject.try_input(input, variant_of(input)),
                  "find-" + std::to_string(options.seed) + "-" + std::to_string(number));
        return true;
    });
}

void replay(const Options& options, Tally& tally) {
    const std::vector<Seed> files = load_seeds(options.replay);
    on_all_jobs(options, [&](Subject& subject, std::uint64_t number) {
        if (number >= files.size() * options.ways) return false;
        const Seed& file = files[number / options.ways];
        const std::size_t variant = number % options.ways == 0 ? 0 : number % Subject::n_variants();
        if (kind_of(file.name) == Kind::replay && variant > 0) return true;
        const Input input{"input" + fs::path(file.name).extension().string(), file.bytes};
        Outcome outcome = variant == 0 ? subject.try_input(input, variant) : subject.try_solve(input, variant);
        if (options.all_accepted && !outcome.accepted && outcome.complaint.empty()) outcome.complaint = "is refused";
        tally.add(input, outcome, file.name);
        return true;
    });
}

int run_program(int argc, char** argv) {
    CLI::App parser("Feeds mutated files to elastolab.", "fuzz_program");
    Options options;
    add_options(parser, options);
    CLI11_PARSE(parser, argc, argv);
    const auto begin = Clock::now();
    Tally tally(options.replay.empty() ? options.keep : "");
    options.replay.empty() ? fuzz(options, tally) : replay(options, tally);
    tally.print(std::chrono::duration<double>(Clock::now() - begin).count());
    return tally.n_finds() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace elastolab::fuzz

int main(int argc, char** argv) {
    try {
        return elastolab::fuzz::run_program(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "fuzz_program: " << error.what() << "\n";
        return 2;
    }
}
