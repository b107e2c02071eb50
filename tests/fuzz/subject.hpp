#pragma once

#include <filesystem>
#include <string>

#include "fuzz/mutator.hpp"
#include "fuzz/oracle.hpp"

namespace elastolab::fuzz {

/// What came of an input.
struct Outcome {
    bool accepted = false;  ///< by the last command that read it
    std::string command;    ///< that last command
    std::string complaint;  ///< empty: nothing is wrong
    std::string err;        ///< what it said
    double cpu_seconds = 0.0;
};

/// The program under test, with a folder in which it meets its inputs.
class Subject {
public:
    /// program   the elastolab binary
    /// seeds     folder whose files lie beside each input: meshes that scenes name
    /// folder    of its own, empty
    /// slowness  factor on the time limit (a slow machine; from 10 on a program with sanitizers)
    Subject(std::filesystem::path program, const std::filesystem::path& seeds, std::filesystem::path folder,
            double slowness);

    /// Feeds an input to the commands that read its format: meshes and scenes to info and, when they have few
    /// vertices, to solve in one of several ways; replays to the viewer.
    /// variant  which of the ways, 0 to n_variants() - 1
    Outcome try_input(const Input& input, std::size_t variant);
    /// Feeds a mesh or scene to solve alone: info, which is slow on the worst of them, says the same in every way.
    Outcome try_solve(const Input& input, std::size_t variant);

    static std::size_t n_variants();

private:
    Outcome execute(std::vector<std::string> arguments);
    Outcome solve(const Input& input, std::size_t variant);
    Outcome try_body(const Input& input, std::size_t variant);
    Outcome try_replay(const Input& input);
    void check_outputs(Outcome& outcome, const std::vector<std::string>& outputs) const;
    void lay_down(const Input& input);

    std::filesystem::path program_, seeds_, folder_;
    double slowness_;
    std::string out_;  ///< of the last command
};

}  // namespace elastolab::fuzz
