#include "scene/setup.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/overloaded.hpp"
#include "base/text.hpp"
#include "deform/load_parts.hpp"
#include "mesh/input/import.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "mesh/solids.hpp"
#include "scene/selectors.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr int kNobody = -1;
constexpr std::size_t kLongestName = 60;  ///< in messages: names come from scene files
constexpr int kFirstFixed = -2;           ///< owner for the first fixed set; later sets count downwards

std::string place(const fs::path& scene_file, const std::string& path) { return scene_file.string() + ": " + path; }

std::string handle_path(std::size_t i) { return "/handles/" + std::to_string(i); }

std::string fixed_path(const Document& document, std::size_t i) {
    return is_plain(document.fixed) ? "/fixed" : "/fixed/" + std::to_string(i);
}

[[noreturn]] void fail(const fs::path& scene_file, const std::string& path, const std::string& finding) {
    throw SceneError(one_line(place(scene_file, path) + ": " + finding));
}

SurfaceMesh make_mesh(const Primitive& primitive, const fs::path& scene_file) {
    try {
        return make_primitive(primitive.name, primitive.resolution, primitive.size);
    } catch (const MeshError& error) {
        fail(scene_file, "/mesh", error.what());
    }
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
        const auto begin = static_cast<int>(result_.set.base.size());
        result_.set.base.insert(result_.set.base.end(), vertices.begin(), vertices.end());
        result_.fixed_sets.push_back({std::move(name), begin, static_cast<int>(result_.set.base.size())});
    }

    void add_handle(std::size_t i) {
        const Handle& handle = document_.handles[i];
        if (handle.name == "fixed")
            fail(scene_file_, handle_path(i) + "/name",
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
                fail(scene_file_, path + "/select",
                     "triangle " + std::to_string(t) +
                         " has three constrained vertices, where a load has no effect. "
                         "Load triangles that are free.");
            triangles.push_back(t);
        }
        if (!selects_any)
            fail(scene_file_, path + "/select",
                 "selects no triangle: of none are all three vertices selected. Select more vertices.");
        const std::string name = load.name.empty() ? default_load_name(i) : load.name;
        for (const AppliedLoad& other : result_.loads)
            if (other.name == name) fail_named_twice("/loads", name);
        if (triangles.empty()) return;
        apply({.name = name,
               .kind = static_cast<AppliedLoad::Kind>(1 + load.value.index()),
               .triangles = std::move(triangles),
               .number = static_cast<int>(i)});
    }

    void apply(AppliedLoad load) {
        const std::vector<UnitLoad> units = unit_loads(load.kind, mesh_, load.triangles);
        load.first = static_cast<int>(result_.set.loads.size());
        load.count = static_cast<int>(units.size());
        const Eigen::VectorXd factors = load_factors(document_, load);
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
        fail(scene_file_, path,
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
            fail(scene_file_, handle_path(i) + "/displacements",
                 "has " + std::to_string(motion.displacements.size()) + " entries for " +
                     std::to_string(vertices.size()) + " selected vertices. Give one for each.");
        for (std::size_t k = 0; k < vertices.size(); ++k) add_value(motion.displacements[k], vertices[k], i);
    }

    void add_value(const Eigen::Vector3d& u, int vertex, std::size_t i) {
        if (!u.allFinite())
            fail(scene_file_, handle_path(i),
                 "moves vertex " + std::to_string(vertex) +
                     " by a number beyond double precision. Make the motion smaller.");
        values_.insert(values_.end(), u.begin(), u.end());
    }

    void add_group(std::string name, std::size_t n_vertices) {
        for (const ConstraintGroup& group : result_.groups)
            if (group.name == name) fail_named_twice("/handles", name);
        for (const ConstraintGroup& set : result_.fixed_sets)
            if (set.name == name)
                fail(scene_file_, "/handles",
                     "one of them and a fixed set are called \"" + shortened(name, kLongestName) +
                         "\". Give them different names.");
        const int begin = result_.groups.empty() ? 0 : result_.groups.back().end;
        result_.groups.push_back({std::move(name), begin, begin + static_cast<int>(n_vertices)});
    }

    [[noreturn]] void fail_named_twice(const std::string& path, const std::string& name) const {
        fail(scene_file_, path,
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

SceneMesh load_scene_mesh(const MeshSource& source, const fs::path& scene_file, Control& control) {
    if (const auto* primitive = std::get_if<Primitive>(&source))
        return {primitive->name, check_and_repair(make_mesh(*primitive, scene_file), control)};
    const fs::path file = scene_file.parent_path() / std::get<MeshFile>(source).file;
    ImportedSurface imported = import_surface(file, control);
    CheckedMesh checked = check_and_repair(std::move(imported.mesh), control);
    if (!imported.warning.empty())
        checked.report.defects.push_back({.kind = Defect::Kind::coarse_coordinates,
                                          .count = 1,
                                          .places = {},
                                          .found = imported.warning,
                                          .text = imported.warning});
    return {file.string(), std::move(checked)};
}

bool needs_proxy(const ProxyChoice& choice, const MeshReport& mesh, MethodKind kind) {
    switch (choice.use) {
        case ProxyUse::automatic:
        case ProxyUse::fill:
            return kind->has_inside ? !mesh.usable_for_fem() : !mesh.usable();
        case ProxyUse::always:
            return true;
        case ProxyUse::never:
            break;
    }
    return false;
}

void require_usable(const SceneMesh& mesh, MethodKind kind) {
    require_usable(mesh.checked.report, mesh.name, kind->has_inside);
}

void require_material(const Material& material, MethodKind kind, const fs::path& scene_file) {
    if (!std::isnormal(material.young_modulus))
        fail(scene_file, "/material/young_modulus",
             "is " + exact(material.young_modulus) +
                 ", below the range of numbers that keep all their digits. Choose another unit of force.");
    if (const std::string why = refusal({.kind = kind}, material.poisson_ratio); !why.empty())
        throw SceneError(one_line(place(scene_file, "/material/" + why)));
}

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

std::vector<AffineMotion> Constraints::move_grips(const GripStiffness& stiffness, const Positions& vertices) {
    const std::vector<std::size_t> handles = gripped();
    Eigen::VectorXd wanted(6 * std::ssize(handles)), springs(std::ssize(handles));
    for (Eigen::Index g = 0; g < springs.size(); ++g) {
        const GripForce& grip = *forces[handles[static_cast<std::size_t>(g)]];
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

std::pair<int, int> Constraints::range_of(std::size_t handle) const {
    const ConstraintGroup& group = groups[handle + (has_fixed() ? 1 : 0)];
    const auto n_base = static_cast<int>(set.base.size());
    return {group.begin - n_base, group.end - n_base};
}

void Constraints::move(std::size_t handle, const AffineMotion& motion, const Positions& vertices) {
    motions[handle] = motion;
    const auto [begin, end] = range_of(handle);
    for (int i = begin; i < end; ++i)
        values.segment<3>(3 * i) =
            motion.matrix * vertices.col(set.handles[static_cast<std::size_t>(i)]) + motion.translate;
}

namespace {

/// The loads of one solid: their resultant, and the sum of their sizes.
struct SumOfLoads {
    Resultant resultant;
    double size = 0.0;

    void add(const Resultant& load, double load_size) {
        resultant.force += load.force;
        resultant.moment += load.moment;
        size += load_size;
    }
    /// Whether it does no work in these rigid motions (free_rigid_motions), but for a millionth.
    bool balances(const Eigen::MatrixXd& motions, const Eigen::Vector3d& centre, double length) const {
        Eigen::Matrix<double, 6, 1> about_centre;
        about_centre << resultant.force, (resultant.moment - centre.cross(resultant.force)) / length;
        return !((motions.transpose() * about_centre).stableNorm() > 1e-6 * size);
    }
};

std::vector<int> numbers_among(const std::vector<int>& chosen, int n) {
    std::vector<int> numbers(static_cast<std::size_t>(n), -1);
    for (std::size_t i = 0; i < chosen.size(); ++i) numbers[static_cast<std::size_t>(chosen[i])] = static_cast<int>(i);
    return numbers;
}

/// Total size of a load's forces, whether they balance or not.
double size_of(const SurfaceMesh& surface, const UnitLoad& load) {
    double size = load.is_body_force() ? resultant(surface, load).force.norm() : 0.0;
    for (std::size_t k = 0; k < load.triangles.size(); ++k)
        size += 0.5 * area_vector(triangle_points(surface, load.triangles[k])).norm() *
                load.tractions.col(static_cast<Eigen::Index>(k)).norm();
    return size;
}

SumOfLoads loads_on(const Solid& solid, const Constraints& constraints, const SurfaceMesh& surface) {
    SumOfLoads sum;
    const std::vector<int> own = numbers_among(solid.triangles, surface.n_triangles());
    const Eigen::VectorXd factors = constraints.values.tail(std::ssize(constraints.set.loads));
    for (std::size_t k = 0; k < constraints.set.loads.size(); ++k) {
        const UnitLoad part = on_triangles(constraints.set.loads[k], own);
        if (part.triangles.empty() && !constraints.set.loads[k].is_body_force()) continue;
        const double factor = factors[static_cast<Eigen::Index>(k)];
        const Resultant unit = resultant(solid.surface, part);
        sum.add({factor * unit.force, factor * unit.moment}, std::abs(factor) * size_of(solid.surface, part));
    }
    const std::vector<int> local = numbers_among(solid.vertices, surface.n_vertices());
    for (std::size_t h = 0; h < constraints.forces.size(); ++h) {
        const auto [begin, end] = constraints.range_of(h);
        if (!constraints.forces[h] || begin == end) continue;
        const std::vector<int> patch(constraints.set.handles.begin() + begin, constraints.set.handles.begin() + end);
        if (local[static_cast<std::size_t>(patch.front())] < 0) continue;
        const Eigen::Vector3d middle = surface.vertices(Eigen::all, patch).rowwise().mean();
        const GripForce& grip = *constraints.forces[h];
        sum.add({grip.force, grip.moment + middle.cross(grip.force)}, grip.force.norm());
    }
    return sum;
}

/// Vertices of a solid, by its own numbers, that hold it: all constrained ones but those that move by a force.
std::vector<int> holding(const Solid& solid, const Constraints& constraints, const SurfaceMesh& surface) {
    const std::vector<int> local = numbers_among(solid.vertices, surface.n_vertices());
    std::vector<int> held;
    const auto add = [&](int v) {
        if (const int own = local[static_cast<std::size_t>(v)]; own >= 0) held.push_back(own);
    };
    for (const int v : constraints.set.base) add(v);
    for (std::size_t h = 0; h < constraints.forces.size(); ++h) {
        const auto [begin, end] = constraints.range_of(h);
        for (int i = begin; i < end && !constraints.forces[h]; ++i)
            add(constraints.set.handles[static_cast<std::size_t>(i)]);
    }
    return held;
}

}  // namespace

void require_balance(const Document& document, const Constraints& constraints, const SurfaceMesh& surface,
                     const fs::path& scene_file) {
    if (constraints.set.loads.empty() && !constraints.has_forces()) return;
    for (const Solid& solid : split_solids(surface)) {
        const Positions& vertices = solid.surface.vertices;
        const Eigen::Vector3d centre = vertices.rowwise().mean();
        const double length = (vertices.colwise() - centre).colwise().norm().maxCoeff();
        const Eigen::MatrixXd motions =
            free_rigid_motions(vertices, holding(solid, constraints, surface), centre, length);
        if (motions.cols() == 0 || loads_on(solid, constraints, surface).balances(motions, centre, length)) continue;
        fail(scene_file,
             !document.loads.empty() ? "/loads"
             : document.gravity      ? "/gravity"
                                     : "/handles",
             "do not balance, and nothing holds the body against them. Fix a part of it, or add loads until forces and "
             "moments sum to zero.");
    }
}

Constraints make_constraints(const Document& document, const SurfaceMesh& mesh, const fs::path& scene_file,
                             ConstrainedTriangles loaded) {
    return Collector(document, mesh, scene_file, loaded).collect();
}

}  // namespace elastolab
