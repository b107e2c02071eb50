#include <algorithm>
#include <cctype>
#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <thread>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/solve_outputs.hpp"
#include "findings/words.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"
#include "scene/balance.hpp"
#include "scene/constraints.hpp"
#include "scene/file/scene_file.hpp"
#include "scene/live/haptic_loop.hpp"
#include "scene/proxy/carried_constraints.hpp"
#include "scene/scene_mesh.hpp"

namespace elastolab {

namespace {

namespace fs = std::filesystem;

struct FeelOptions {
    std::string scene, method, handle, path, forces;
    double seconds = 10.0;
};

struct PathPoint {
    double seconds;
    GripPose pose;
};

constexpr const char* kColumns = "time_s,tx,ty,tz,rx,ry,rz";

/// Whether a first line names columns, which have to be those above, in this order.
bool is_heading(std::string line, const fs::path& file) {
    if (line.find("time_s") == std::string::npos) return false;
    std::erase_if(line, [](unsigned char c) { return std::isspace(c) != 0; });
    if (line != kColumns) throw Error(file.string() + ": line 1 names other columns. Write " + kColumns + ".");
    return true;
}

/// Rows of the columns above, below a line of their names or without, times ascending.
std::vector<PathPoint> read_path(const fs::path& file) {
    std::ifstream in(file);
    if (!in) throw Error(file.string() + ": cannot be opened. Name a path file.");
    std::vector<PathPoint> path;
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // a mark that spreadsheets write
        if (line.ends_with('\r')) line.pop_back();
        if (line.empty() || (number == 1 && is_heading(line, file))) continue;
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream numbers(line);
        PathPoint point{};
        numbers >> point.seconds;
        for (double& x : point.pose.shift) numbers >> x;
        for (double& x : point.pose.turn) numbers >> x;
        const bool complete = !numbers.fail();
        numbers >> std::ws;
        if (!complete || !numbers.eof() || !point.pose.shift.allFinite() || !point.pose.turn.allFinite() ||
            (!path.empty() && !(point.seconds > path.back().seconds)))
            throw Error(file.string() + ": line " + std::to_string(number) +
                        " is not a time later than the one before and six numbers. Write " + kColumns + ".");
        path.push_back(point);
    }
    if (path.size() < 2) throw Error(file.string() + ": has fewer than two poses. Record a longer path.");
    return path;
}

/// A closed path: a figure of eight across a tenth of `size`, turned by up to 0.2, in four seconds.
std::vector<PathPoint> figure_of_eight(double size) {
    std::vector<PathPoint> path;
    constexpr int kPoints = 400;
    for (int i = 0; i <= kPoints; ++i) {
        const double a = 2.0 * std::numbers::pi * i / kPoints;
        path.push_back({4.0 * i / kPoints,
                        {0.1 * size * Eigen::Vector3d(std::sin(a), std::sin(2.0 * a), 1.0 - std::cos(a)),
                         0.2 * Eigen::Vector3d(std::sin(a), 1.0 - std::cos(a), std::sin(3.0 * a))}});
    }
    return path;
}

/// The path, again and again.
GripPose pose_at(const std::vector<PathPoint>& path, double seconds) {
    const double t = path.front().seconds + std::fmod(seconds, path.back().seconds - path.front().seconds);
    const auto next = std::upper_bound(path.begin() + 1, path.end() - 1, t,
                                       [](double at, const PathPoint& point) { return at < point.seconds; });
    const PathPoint &a = *std::prev(next), &b = *next;
    const double share = std::clamp((t - a.seconds) / (b.seconds - a.seconds), 0.0, 1.0);
    return {a.pose.shift + share * (b.pose.shift - a.pose.shift), a.pose.turn + share * (b.pose.turn - a.pose.turn)};
}

std::size_t find_handle(const Constraints& constraints, const std::string& wanted, const std::string& scene) {
    const std::size_t first = constraints.has_fixed() ? 1 : 0;
    if (constraints.groups.size() == first) throw Error(scene + ": has no handle. Add the one that is to be felt.");
    if (wanted.empty()) return 0;
    for (std::size_t g = first; g < constraints.groups.size(); ++g)
        if (constraints.groups[g].name == wanted) return g - first;
    throw Error(scene + ": has no handle \"" + wanted + "\". Name one of its handles.");
}

/// Only the one that is felt gives way.
void require_no_other_force(const Constraints& constraints, std::size_t felt, const std::string& scene) {
    for (const std::size_t h : constraints.gripped())
        if (h != felt)
            throw Error(scene + ": its handle \"" +
                        shortened(constraints.groups[h + (constraints.has_fixed() ? 1 : 0)].name, 60) +
                        "\" moves by a force, which is not followed at haptic rate. Give it a motion, or fix it.");
}

void write_felt(std::ostream& out, const std::vector<std::pair<double, FeltForce>>& forces) {
    out << "time_s,fx,fy,fz,mx,my,mz\n";
    for (const auto& [seconds, felt] : forces) {
        out << exact(seconds);
        for (const double x : felt.force) out << ',' << exact(x);
        for (const double x : felt.moment) out << ',' << exact(x);
        out << '\n';
    }
}

/// The handle that is led, on the surface that is simulated.
struct FeltHandle {
    std::unique_ptr<GripStiffness> stiffness;
    Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< from the handle's middle to that of its vertices there [L]
    double size = 1.0;                              ///< of the body [L]

    /// Of the vertices there, where this one is of the handle. Turns count as small.
    GripPose of_vertices(const GripPose& handle) const { return {handle.shift + handle.turn.cross(arm), handle.turn}; }
    FeltForce of_handle(const FeltForce& vertices) const {
        return {vertices.force, vertices.moment + arm.cross(vertices.force)};
    }
};

Eigen::Vector3d middle_of_handle(const Constraints& constraints, std::size_t handle, const SurfaceMesh& surface) {
    const auto [begin, end] = constraints.range_of(handle);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = begin; i < end; ++i) sum += surface.vertices.col(constraints.set.handles[static_cast<std::size_t>(i)]);
    return sum / (end - begin);
}

FeltHandle make_felt_handle(const FeelOptions& options, const Document& document, Control& control) {
    const SceneMesh mesh = load_scene_mesh(document.mesh, options.scene, control);
    require_material(document.material, document.method, options.scene);
    const auto surface = std::make_shared<const SurfaceMesh>(mesh.checked.mesh);
    const Constraints shown = make_constraints(document, *surface, options.scene);
    const std::size_t felt = find_handle(shown, options.handle, options.scene);
    require_no_other_force(shown, felt, options.scene);

    Body body{.name = mesh.name, .surface = surface, .material = document.material};
    std::optional<CarriedConstraints> carried;
    if (needs_proxy(document.proxy, mesh.checked.report, document.method)) {
        const auto proxy = make_proxy(mesh.name, surface, mesh.checked.report, document.proxy, control);
        carried.emplace(proxy).set(shown);
        body.surface = proxy->surface;
        for (const std::string& text : words(findings_of_proxy(*proxy, mesh.name)))
            std::cerr << "elastolab: warning: " << text << '\n';
    } else {
        require_usable(mesh, document.method);
    }
    const Constraints& constraints = carried ? carried->constraints() : shown;
    require_balance(document, constraints, *body.surface, options.scene);
    const auto [begin, end] = constraints.range_of(felt);
    if (begin == end)
        throw Error(options.scene +
                    ": the handle that is led is smaller than the proxy's triangles, and another one has "
                    "the vertices there. Ask for more proxy vertices.");
    Deformer deformer(precompute(body, {.kind = document.method}, control));
    deformer.constrain(constraints.set, control);
    FeltHandle handle;
    handle.stiffness =
        std::make_unique<GripStiffness>(deformer, constraints.values, std::vector<Grip>{{begin, end}}, control);
    handle.arm = handle.stiffness->middle(0) - middle_of_handle(shown, felt, *surface);
    handle.size = (surface->vertices.rowwise().maxCoeff() - surface->vertices.rowwise().minCoeff()).maxCoeff();
    return handle;
}

void require_sensible(const FeelOptions& options, const Document& document) {
    if (!document.method->linear)
        throw Error(options.scene +
                    ": forces at haptic rate need a method that is linear. Choose another with --method.");
    constexpr double kMostSeconds = 86400.0;
    if (!(options.seconds > 0.0 && options.seconds <= kMostSeconds))
        throw UsageError("--seconds: must be positive and at most a day, " + exact(kMostSeconds) + ".");
    if (options.forces.empty()) return;
    std::vector<fs::path> inputs = files_of_scene(options.scene, document.mesh);
    if (!options.path.empty()) inputs.emplace_back(options.path);
    require_distinct({options.forces}, inputs);
    AtomicFile::require_writable(options.forces);
}

void run_feel(const FeelOptions& options) {
    Document document = load_scene(options.scene);
    if (!options.method.empty()) document.method = *parse_method_kind(options.method);
    require_sensible(options, document);
    Control control;
    const InterruptGuard interrupt(control);
    FeltHandle handle;
    {
        const ProgressBar progress(control, true);
        handle = make_felt_handle(options, document, control);
    }
    const std::vector<PathPoint> path = options.path.empty() ? figure_of_eight(handle.size) : read_path(options.path);
    std::vector<std::pair<double, FeltForce>> forces;
    if (!options.forces.empty()) forces.reserve(static_cast<std::size_t>(1000.0 * options.seconds) + 1000);
    HapticTimings timings;
    {
        HapticLoop loop(
            *handle.stiffness, [&](double seconds) { return handle.of_vertices(pose_at(path, seconds)); },
            [&](double seconds, const FeltForce& felt) {
                if (forces.size() < forces.capacity()) forces.emplace_back(seconds, handle.of_handle(felt));
            });
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds);
        while (std::chrono::steady_clock::now() < end) {
            control.checkpoint();
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        timings = loop.timings();
    }
    forces.resize(std::min(forces.size(), static_cast<std::size_t>(timings.ticks)));  // another tick may have followed
    if (!options.forces.empty()) {
        AtomicFile file(options.forces);
        write_felt(file.stream(), forces);
        file.close();
        file.commit();
    }
    std::cout << timings.ticks << " ticks, " << timings.late << " late by more than a millisecond (the worst by "
              << readable_number(timings.worst_lateness_ms, 3) << " ms), 99.9 % computed in "
              << readable_number(timings.computation_p999_ms, 3) << " ms, " << (timings.real_time ? "with" : "without")
              << " real-time priority\n";
}

}  // namespace

Command add_feel_command(CLI::App& program) {
    const auto options = std::make_shared<FeelOptions>();
    CLI::App* parser = program.add_subcommand(
        "feel", "leads a handle along a path 1000 times a second and tells the forces and how time was kept");
    parser->add_option("scene", options->scene, "scene file")->required();
    parser->add_option("--method", options->method, "default: the scene's own")->check(CLI::IsMember(method_names()));
    parser->add_option("--handle", options->handle, "name of the handle (default: the first)");
    parser->add_option("--path", options->path,
                       "CSV: time_s,tx,ty,tz,rx,ry,rz, shift of the handle's middle and rotation vector; repeated "
                       "(default: a figure of eight)");
    parser->add_option("--seconds", options->seconds, "how long (default 10)");
    parser->add_option("--forces", options->forces, "CSV: what the hand feels at each tick");
    return {parser, [options] { run_feel(*options); }};
}

}  // namespace elastolab
