#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fuzz/random.hpp"

namespace elastolab::fuzz {

/// What a file is, by its extension: what may be done to it, and which command reads it.
enum class Kind { mesh, scene, replay };
Kind kind_of(const std::filesystem::path& file);

/// A sound file to begin with.
struct Seed {
    std::string name;  ///< of the file
    std::string bytes;
};

/// All files of a folder that are input of a command, by name. Throws std::runtime_error when there are none.
std::vector<Seed> load_seeds(const std::filesystem::path& folder);

/// What is fed to a command.
struct Input {
    std::string name;  ///< without a folder; its extension says the format
    std::string bytes;
    std::vector<Seed> beside = {};  ///< files that it names
};

/// Input `number` of the run of `seed`: one of the seeds after one or more changes.
Input make_input(const std::vector<Seed>& seeds, std::uint64_t seed, std::uint64_t number);

}  // namespace elastolab::fuzz
