#include "scene/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/overloaded.hpp"
#include "mesh/measures.hpp"
#include "scene/scene_failure.hpp"
#include "scene/selectors.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr int kNobody = -1;
constexpr std::size_t kLongestName = 60;  ///< in messages: names come from scene files
constexpr int kFirstFixed = -2;           ///< owner for the first fixed set; later sets count downwards

std::string handle_path(std::size_t i) { return "/handles/" + std::to_string(i); }

std::string fixed_path(const Document& document, std::size_t i) {
    return is_plain(document.fixed) ? "/fixed" : "/fixed/" + std::to_string(i);
}

/// Collects constraints and notices a vertex that is claimed twice.
class Collector {
public:
    Collector(const Document& document, const SurfaceMesh& mesh, const fs::path& scene_file,
              ConstrainedTriangles loaded)
        : document_(document),
          mesh_(mesh),
          scene_file_(scene_file),
          loaded_(loaded),
          owner_(static_cast<std::size_t>(mesh.n_vertices()), kNobody) {}

    Constraints collect() && {
        for (std::size_t i = 0; i < document_.fixed.size(); ++i) add_fixed(i);
        if (!result_.fixed_sets.empty()) result_.groups.push_back({"fixed", 0, result_.fixed_sets.back().end});
        for (std::size_t i = 0; i < document_.handles.size(); ++i) add_handle(i);
        if (document_.gravity) apply({.name = "gravity", .kind = AppliedLoad::Kind::gravity});
        for (std::size_t i = 0; i < document_.loads.size(); ++i) add_load(i);
        result_.values = Eigen::Map<const Eigen::VectorXd>(values_.data(), std::ssize(values_));
        return std::move(result_);
    }

private:
    void add_fixed(std::size_t i) {
        const FixedSet& set = document_.fixed[i];
        const std::string path = fixed_path(document_, i), select = path == "/fixed" ? path : path + "/select";
        const std::vector<int> vertices = claim(set.select, select, kFirstFixed - static_cast<int>(i));
        std::string name = set.name.empty() ? default_fixed_name(i) : set.name;
        for (const ConstraintGroup& other : result_.fixed_sets)
            if (other.name == name) fail_named_twice("/fixed", name);
        const auto begin = static_cast<int>(result_.set.fixed.size());
        result_.set.fixed.insert(result_.set.fixed.end(), vertices.begin(), vertices.end());
        result_.fixed_sets.push_back({std::move(name), begin, static_cast<int>(result_.set.fixed.size())});
    }

    void add_handle(std::size_t i) {
        const Handle& handle = document_.handles[i];
        if (handle.name == "fixed")
            fail_at(scene_file_, handle_path(i) + "/name",
                    "\"fixed\" is what the fixed part is called. Choose another name.");
        const std::vector<int> vertices = claim(handle.select, handle_path(i) + "/select", static_cast<int>(i));
        std::visit([&](const auto& motion) { add_values(motion, vertices, i); }, handle.motion);
        result_.motions.push_back(handle.motion);
        result_.forces.push_back(handle.force);
        result_.set.handles.insert(result_.set.handles.end(), vertices.begin(), vertices.end());
        add_group(handle.name.empty() ? "handle-" + std::to_string(i) : handle.name, vertices.size());
    }

    void add_load(std::size_t i) {
        const Load& load = document_.loads[i];
        const std::string path = "/loads/" + std::to_string(i);
        std::vector<char> selected(owner_.size(), 0);
        for (const int v : select_vertices(mesh_, load.select, place(scene_file_, path + "/select")))
            selected[static_cast<std::size_t>(v)] = 1;
        std::vector<int> triangles;
        bool selects_any = false;
        for (int t = 0; t < mesh_.n_triangles(); ++t) {
            bool whole = true, constrained = true;
            for (const int v : mesh_.triangles.col(t)) {
                whole = whole && selected[static_cast<std::size_t>(v)] != 0;
                constrained = constrained && owner_[static_cast<std::size_t>(v)] != kNobody;
            }
            if (!whole) continue;
            selects_any = true;
            if (constrained && loaded_ == ConstrainedTriangles::left_out) continue;
            if (constrained)
                fail_at(scene_file_, path + "/select",
                        "triangle " + std::to_string(t) +
                            " has three constrained vertices, where a load has no effect. "
                            "Load triangles that are free.");
            triangles.push_back(t);
        }
        if (!selects_any)
            fail_at(scene_file_, path + "/select",
                    "selects no triangle: of none are all three vertices selected. Select more vertices.");
        const std::string name = load.name.empty() ? default_load_name(i) : load.name;
        if (name == "gravity")
            fail_at(scene_file_, path + "/name", "\"gravity\" is what the weight is called. Choose another name.");
        for (const AppliedLoad& other : result_.loads)
            if (other.name == name) fail_named_twice("/loads", name);
        if (triangles.empty()) return;
        if (!has_area(triangles)) {
            if (loaded_ == ConstrainedTriangles::left_out) return;
            fail_at(scene_file_, path + "/select",
                    "selects triangles without area, on which no load acts. Select others.");
        }
        apply({.name = name,
               .kind = static_cast<AppliedLoad::Kind>(1 + load.value.index()),
               .triangles = std::move(triangles),
               .number = static_cast<int>(i)});
    }

    bool has_area(const std::vector<int>& triangles) const {
        return std::any_of(triangles.begin(), triangles.end(),
                           [&](int t) { return area_vector(triangle_points(mesh_, t)).stableNorm() > 0.0; });
    }

    void apply(AppliedLoad load) {
        const std::vector<UnitLoad> units = unit_loads(load.kind, mesh_, load.triangles);
        load.first = static_cast<int>(result_.set.loads.size());
        load.count = static_cast<int>(units.size());
        const Eigen::VectorXd factors = load_factors(document_, load);
        if (!std::isfinite(gross_force(mesh_, units, factors) / document_.material.young_modulus))
            fail_at(scene_file_, load.number < 0 ? "/gravity" : "/loads/" + std::to_string(load.number),
                    "is beyond double precision as a force, or as a force over Young's modulus. Make it smaller.");
        values_.insert(values_.end(), factors.begin(), factors.end());
        result_.set.loads.insert(result_.set.loads.end(), units.begin(), units.end());
        result_.loads.push_back(std::move(load));
    }

    std::vector<int> claim(const Selector& selector, const std::string& path, int owner) {
        std::vector<int> vertices = select_vertices(mesh_, selector, place(scene_file_, path));
        for (const int v : vertices) {
            int& present = owner_[static_cast<std::size_t>(v)];
            if (present != kNobody) fail_claimed(path, v, present);
            present = owner;
        }
        return vertices;
    }

    [[noreturn]] void fail_claimed(const std::string& path, int vertex, int owner) const {
        const std::string other = owner <= kFirstFixed
                                      ? fixed_path(document_, static_cast<std::size_t>(kFirstFixed - owner))
                                      : handle_path(static_cast<std::size_t>(owner));
        const Eigen::Vector3d x = mesh_.vertices.col(vertex);
        fail_at(scene_file_, path,
                "vertex " + std::to_string(vertex) + " at (" + readable_number(x.x(), 6) + ", " +
                    readable_number(x.y(), 6) + ", " + readable_number(x.z(), 6) + ") also belongs to " + other +
                    ". Make the selectors disjoint.");
    }

    void add_values(const AffineMotion& motion, const std::vector<int>& vertices, std::size_t i) {
        const AffineMap map = map_of(motion);
        for (const int v : vertices) add_value(map.displacement(mesh_.vertices.col(v)), v, i);
    }

    void add_values(const VertexMotion& motion, const std::vector<int>& vertices, std::size_t i) {
        if (motion.displacements.size() != vertices.size())
            fail_at(scene_file_, handle_path(i) + "/displacements",
                    "has " + std::to_string(motion.displacements.size()) + " entries for " +
                        std::to_string(vertices.size()) + " selected vertices. Give one for each.");
        for (std::size_t k = 0; k < vertices.size(); ++k) add_value(motion.displacements[k], vertices[k], i);
    }

    void add_value(const Eigen::Vector3d& u, int vertex, std::size_t i) {
        if (!u.allFinite())
            fail_at(scene_file_, handle_path(i),
                    "moves vertex " + std::to_string(vertex) +
                        " by a number beyond double precision. Make the motion smaller.");
        values_.insert(values_.end(), u.begin(), u.end());
    }

    void add_group(std::string name, std::size_t n_vertices) {
        for (const ConstraintGroup& group : result_.groups)
            if (group.name == name) fail_named_twice("/handles", name);
        for (const ConstraintGroup& set : result_.fixed_sets)
            if (set.name == name)
                fail_at(scene_file_, "/handles",
                        "one of them and a fixed set are called \"" + shortened(name, kLongestName) +
                            "\". Give them different names.");
        const int begin = result_.groups.empty() ? 0 : result_.groups.back().end;
        result_.groups.push_back({std::move(name), begin, begin + static_cast<int>(n_vertices)});
    }

    [[noreturn]] void fail_named_twice(const std::string& path, const std::string& name) const {
        fail_at(scene_file_, path,
                "two of them are called \"" + shortened(name, kLongestName) + "\". Give them different names.");
    }

    const Document& document_;
    const SurfaceMesh& mesh_;
    const fs::path& scene_file_;
    ConstrainedTriangles loaded_;
    std::vector<int> owner_;  ///< for every vertex: kNobody, its handle, or kFirstFixed and below
    std::vector<double> values_;
    Constraints result_;
};

}  // namespace

std::vector<UnitLoad> unit_loads(AppliedLoad::Kind kind, const SurfaceMesh& surface,
                                 const std::vector<int>& triangles) {
    if (kind == AppliedLoad::Kind::pressure) return {unit_pressure(surface, triangles)};
    std::vector<UnitLoad> loads;
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
        if (kind == AppliedLoad::Kind::gravity) loads.push_back(body_force_along(axis));
        if (kind == AppliedLoad::Kind::force) loads.push_back(unit_force(surface, triangles, along));
        if (kind == AppliedLoad::Kind::traction) loads.push_back(unit_traction(triangles, along));
    }
    return loads;
}

Eigen::VectorXd load_factors(const LoadValue& value) {
    return std::visit(Overloaded{[](const ForceLoad& load) -> Eigen::VectorXd { return load.force; },
                                 [](const TractionLoad& load) -> Eigen::VectorXd { return load.traction; },
                                 [](const PressureLoad& load) -> Eigen::VectorXd {
                                     return Eigen::VectorXd::Constant(1, load.pressure);
                                 }},
                      value);
}

Eigen::VectorXd load_factors(const Document& document, const AppliedLoad& load) {
    if (load.kind == AppliedLoad::Kind::gravity) return document.density * *document.gravity;
    return load_factors(document.loads[static_cast<std::size_t>(load.number)].value);
}

bool Constraints::has_forces() const {
    return std::any_of(forces.begin(), forces.end(), [](const auto& force) { return force.has_value(); });
}

std::vector<std::size_t> Constraints::gripped() const {
    std::vector<std::size_t> handles;
    for (std::size_t h = 0; h < forces.size(); ++h)
        if (const auto [begin, end] = range_of(h); forces[h] && begin < end) handles.push_back(h);
    return handles;
}

std::vector<Grip> Constraints::grips() const {
    std::vector<Grip> all;
    for (const std::size_t h : gripped()) all.push_back({range_of(h).first, range_of(h).second});
    return all;
}

std::vector<GripForce> Constraints::grip_forces() const {
    std::vector<GripForce> all;
    for (const std::size_t h : gripped()) all.push_back(*forces[h]);
    return all;
}

std::vector<AffineMotion> Constraints::move_grips(const GripStiffness& stiffness, const Positions& vertices) {
    const std::vector<std::size_t> handles = gripped();
    const std::vector<GripForce> forces_wanted = grip_forces();
    Eigen::VectorXd wanted(6 * std::ssize(handles)), springs(std::ssize(handles));
    for (Eigen::Index g = 0; g < springs.size(); ++g) {
        const GripForce& grip = forces_wanted[static_cast<std::size_t>(g)];
        wanted.segment<6>(6 * g) << grip.force, grip.moment;
        springs[g] = grip.spring;
    }
    const Eigen::VectorXd found = stiffness.motions(wanted, springs);
    std::vector<AffineMotion> moved;
    for (std::size_t g = 0; g < handles.size(); ++g) {
        const Eigen::Vector3d shift = found.segment<3>(6 * static_cast<Eigen::Index>(g));
        const Eigen::Vector3d turn = found.segment<3>(6 * static_cast<Eigen::Index>(g) + 3);
        AffineMotion& motion = moved.emplace_back();
        for (int axis = 0; axis < 3; ++axis) motion.matrix.col(axis) = turn.cross(Eigen::Vector3d::Unit(axis));
        motion.translate = shift - motion.matrix * stiffness.middle(static_cast<int>(g));
        move(handles[g], motion, vertices);
    }
    return moved;
}

std::vector<AffineMotion> Constraints::move_grips(const std::vector<GripPlace>& places, const Positions& vertices) {
    const std::vector<std::size_t> handles = gripped();
    std::vector<AffineMotion> moved;
    for (std::size_t g = 0; g < handles.size(); ++g) {
        const auto [begin, end] = range_of(handles[g]);
        const std::vector<int> patch(set.handles.begin() + begin, set.handles.begin() + end);
        const Eigen::Vector3d middle = vertices(Eigen::all, patch).rowwise().mean();
        moved.push_back(rigid_motion(places[g].shift, places[g].turn, middle));
        move(handles[g], moved.back(), vertices);
    }
    return moved;
}

std::pair<int, int> Constraints::range_of(std::size_t handle) const {
    const ConstraintGroup& group = groups[handle + (has_fixed() ? 1 : 0)];
    const auto n_fixed = static_cast<int>(set.fixed.size());
    return {group.begin - n_fixed, group.end - n_fixed};
}

void Constraints::move(std::size_t handle, const AffineMotion& motion, const Positions& vertices) {
    motions[handle] = motion;
    const auto [begin, end] = range_of(handle);
    const AffineMap map = map_of(motion);
    for (int i = begin; i < end; ++i)
        values.segment<3>(3 * i) = map.displacement(vertices.col(set.handles[static_cast<std::size_t>(i)]));
}

Constraints make_constraints(const Document& document, const SurfaceMesh& mesh, const fs::path& scene_file,
                             ConstrainedTriangles loaded) {
    return Collector(document, mesh, scene_file, loaded).collect();
}

}  // namespace elastolab
