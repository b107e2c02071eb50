#include "fuzz/mutator.hpp"

#include <algorithm>
#include <stdexcept>

#include "fuzz/byte_mutator.hpp"
#include "fuzz/json_mutator.hpp"
#include "fuzz/token_mutator.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab::fuzz {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kReplayEvery = 25;  ///< a replay opens a window: as slow as some twenty other inputs

bool is_json(const fs::path& file) { return file.extension() == ".json" || file.extension() == ".gltf"; }

/// Formats that have no text to change by words.
bool is_binary(const Seed& seed) { return seed.bytes.find('\0') != std::string::npos; }

std::string mutate_once(const Seed& origin, std::string bytes, const Seed& other, Random& random) {
    const bool structured = is_json(origin.name) || kind_of(origin.name) == Kind::replay;
    if (structured && !random.once_in(4))
        return is_json(origin.name) ? mutate_json(bytes, random) : mutate_json_lines(bytes, random);
    // The headers of binary formats are text.
    if (random.once_in(is_binary(origin) ? 6 : 4) == is_binary(origin)) return mutate_tokens(bytes, random);
    return mutate_bytes(std::move(bytes), other.bytes, random);
}

/// Mostly few: many changes at once hardly ever get beyond the first check.
std::size_t n_changes(Random& random) {
    std::size_t n = 1;
    while (n < 8 && random.once_in(2)) ++n;
    return random.once_in(32) ? 10 * n : n;
}

const Seed& pick_seed(const std::vector<Seed>& seeds, Random& random) {
    const bool replay = random.once_in(kReplayEvery);
    const Kind kind = replay ? Kind::replay : random.once_in(3) ? Kind::scene : Kind::mesh;
    std::vector<const Seed*> fitting;
    for (const Seed& seed : seeds)
        if (kind_of(seed.name) == kind) fitting.push_back(&seed);
    return fitting.empty() ? random.pick(seeds) : *random.pick(fitting);
}

}  // namespace

Kind kind_of(const fs::path& file) {
    if (file.extension() == ".json") return Kind::scene;
    return file.extension() == ".log" ? Kind::replay : Kind::mesh;
}

std::vector<Seed> load_seeds(const fs::path& folder) {
    std::vector<Seed> seeds;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() != ".bin")  // part of a glTF file
            seeds.push_back({entry.path().filename().string(), test::read_text(entry.path())});
    if (seeds.empty()) throw std::runtime_error(folder.string() + ": no files");
    std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.name < b.name; });
    return seeds;
}

Input make_input(const std::vector<Seed>& seeds, std::uint64_t seed, std::uint64_t number) {
    Random random(seed, number);
    const Seed& origin = pick_seed(seeds, random);
    std::string bytes = origin.bytes;
    for (std::size_t n = n_changes(random); n > 0; --n)
        bytes = mutate_once(origin, std::move(bytes), random.pick(seeds), random);
    return {"input" + fs::path(origin.name).extension().string(), std::move(bytes)};
}

}  // namespace elastolab::fuzz
