#include "fuzz/subject.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/temporary_folder.hpp"

namespace elastolab::fuzz {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr int kMostVertices = 300;  ///< for solve: every method takes well below a second
/// Of the processor: twice what the slowest find in corpus/ takes on a slow machine, a thin plate. Finer rims make up
/// to five times as many vertices.
constexpr double kMostSeconds = 10.0, kMostSecondsWithFinerRims = 60.0;
/// A program so much slower has sanitizers; a machine is not.
constexpr double kSlownessOfSanitizers = 10.0;

/// Ways to solve.
const std::vector<std::vector<std::string>>& variants() {
    static const std::vector<std::vector<std::string>> list = {
        {},
        {"--method", "fem"},
        {"--method", "constant-bem"},
        {"--method", "linear-bem"},
        {"--mode", "full"},
        {"--mode", "full", "--update", "eqn9"},
        {"--method", "fem", "--mode", "full-volume"},
        {"--method", "constant-bem", "--mode", "full", "--update", "direct"},
        {"--method", "linear-bem", "--update", "reduced"},
        {"--method", "galerkin-bem", "--rims", "1"},
        {"--method", "linear-bem", "--tractions", "continuous"},
        {"--method", "linear-bem", "--tractions", "restricted", "--mode", "full"},
    };
    return list;
}

/// Holds three vertices of a mesh and moves another.
std::string scene_around(const std::string& mesh) {
    return R"({"elastolab": 1, "mesh": {"file": ")" + mesh + R"("}, "fixed": {"vertices": [0, 1, 2]},
               "handles": [{"name": "pulled", "select": {"vertices": [3]}, "translate": [0.1, 0, 0.05]}]})";
}

std::string joined(const std::vector<std::string>& words) {
    std::string text = "elastolab";
    for (const std::string& word : words) text += " " + word;
    return text;
}

/// What info says of a mesh that it read.
struct MeshFacts {
    int n_vertices = 0;
    std::string complaint;
};

MeshFacts facts_of(const std::string& text) {
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return {0, "info prints text that is not JSON"};
    MeshFacts facts{json.at("vertices").get<int>(), ""};
    if (!json.at("usable").get<bool>()) return facts;
    for (const char* key : {"volume", "area", "min", "max", "shortest_edge", "mean_edge", "longest_edge"})
        if (json.at(key).dump().find("null") != std::string::npos)
            facts.complaint = std::string("info takes a mesh for usable whose ") + key + " is not finite";
    return facts;
}

}  // namespace

Subject::Subject(fs::path program, const fs::path& seeds, fs::path folder, double slowness)
    : program_(fs::canonical(program)), seeds_(fs::canonical(seeds)), folder_(std::move(folder)), slowness_(slowness) {}

std::size_t Subject::n_variants() { return variants().size(); }

/// Only the seeds are left beside it: a replay may have written anywhere.
void Subject::lay_down(const Input& input) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    for (const auto& entry : fs::directory_iterator(seeds_))
        fs::copy_file(entry.path(), folder_ / entry.path().filename());
    for (const Seed& file : input.beside) std::ofstream(folder_ / file.name, std::ios::binary) << file.bytes;
    std::ofstream(folder_ / input.name, std::ios::binary) << input.bytes;
}

Outcome Subject::execute(std::vector<std::string> arguments) {
    const bool finer_rims = std::find(arguments.begin(), arguments.end(), "--rims") != arguments.end();
    Command command;
    command.program = program_;
    command.arguments = std::move(arguments);
    command.folder = folder_;
    command.cpu_seconds = (finer_rims ? kMostSecondsWithFinerRims : kMostSeconds) * slowness_;
    if (slowness_ >= kSlownessOfSanitizers) command.memory = std::size_t{1} << 62U;  // sanitizers reserve terabytes
    Run run = fuzz::run(command);
    out_ = std::move(run.out);
    run.out = out_;
    return {run.exit_code == 0, joined(command.arguments), complaint_about(run, command), run.err, run.cpu_seconds};
}

/// All outputs are there and finite, or none is there.
void Subject::check_outputs(Outcome& outcome, const std::vector<std::string>& outputs) const {
    if (!outcome.complaint.empty()) return;
    for (const std::string& output : outputs) {
        if (outcome.accepted && outcome.complaint.empty()) outcome.complaint = not_finite_in(folder_ / output);
        if (!outcome.accepted && fs::exists(folder_ / output)) outcome.complaint = output + " although it failed";
    }
    for (const auto& entry : fs::directory_iterator(folder_))
        if (entry.path().filename().string().starts_with(".elastolab")) outcome.complaint = "a temporary file is left";
}

Outcome Subject::solve(const Input& input, std::size_t variant) {
    const bool is_scene = kind_of(input.name) == Kind::scene;
    const std::string scene = is_scene ? input.name : "around.json";
    if (!is_scene) std::ofstream(folder_ / scene) << scene_around(input.name);
    constexpr std::array kMeshes = {"out.obj", "out.ply", "out.stl"};
    const std::string mesh = kMeshes[variant % kMeshes.size()];
    const std::vector<std::string> outputs = {"displacements.csv", "forces.csv", "report.json", mesh};
    for (const std::string& output : outputs) fs::remove(folder_ / output);
    std::vector<std::string> arguments = {"solve",           scene,        "--proxy-vertices", "100",      "--quiet",
                                          "--displacements", outputs[0],   "--forces",         outputs[1], "--report",
                                          outputs[2],        "--mesh-out", outputs[3]};
    arguments.insert(arguments.end(), variants()[variant].begin(), variants()[variant].end());
    Outcome outcome = execute(arguments);
    check_outputs(outcome, outputs);
    if (outcome.complaint.empty() && !out_.empty()) outcome.complaint = "prints something although it is to be quiet";
    return outcome;
}

Outcome Subject::try_body(const Input& input, std::size_t variant) {
    Outcome outcome = execute({"info", "--json", "--proxy-vertices", "100", input.name});
    const bool is_scene = kind_of(input.name) == Kind::scene;
    if (!outcome.complaint.empty() || (!outcome.accepted && !is_scene)) return outcome;
    if (outcome.accepted) {
        const MeshFacts facts = facts_of(out_);
        outcome.complaint = facts.complaint;
        if (!facts.complaint.empty() || facts.n_vertices > kMostVertices) return outcome;
    }
    return solve(input, variant);
}

Outcome Subject::try_replay(const Input& input) {
    const std::vector<std::string> outputs = {"scene-out.json", "mesh-out.obj"};
    Outcome outcome = execute({"view", "box.json", "--hidden", "--size", "320x240", "--replay", input.name,
                               "--scene-out", outputs[0], "--mesh-out", outputs[1]});
    check_outputs(outcome, outputs);
    return outcome;
}

Outcome Subject::try_input(const Input& input, std::size_t variant) {
    lay_down(input);
    return kind_of(input.name) == Kind::replay ? try_replay(input) : try_body(input, variant);
}

Outcome Subject::try_solve(const Input& input, std::size_t variant) {
    lay_down(input);
    return solve(input, variant);
}

}  // namespace elastolab::fuzz
