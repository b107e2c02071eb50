#include "scene/setup.hpp"

#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/input/import.hpp"
#include "mesh/primitives.hpp"
#include "scene/selectors.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr int kNobody = -1;
constexpr int kFirstFixed = -2;  ///< owner for the first fixed set; later sets count downwards

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
    Collector(const Document& document, const SurfaceMesh& mesh, const fs::path& scene_file)
        : document_(document),
          mesh_(mesh),
          scene_file_(scene_file),
          owner_(static_cast<std::size_t>(mesh.n_vertices()), kNobody) {}

    Constraints collect() && {
        for (std::size_t i = 0; i < document_.fixed.size(); ++i) add_fixed(i);
        if (!result_.fixed_sets.empty()) result_.groups.push_back({"fixed", 0, result_.fixed_sets.back().end});
        for (std::size_t i = 0; i < document_.handles.size(); ++i) add_handle(i);
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
        result_.set.handles.insert(result_.set.handles.end(), vertices.begin(), vertices.end());
        add_group(handle.name.empty() ? "handle-" + std::to_string(i) : handle.name, vertices.size());
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
                     "one of them and a fixed set are called \"" + name + "\". Give them different names.");
        const int begin = result_.groups.empty() ? 0 : result_.groups.back().end;
        result_.groups.push_back({std::move(name), begin, begin + static_cast<int>(n_vertices)});
    }

    [[noreturn]] void fail_named_twice(const std::string& path, const std::string& name) const {
        fail(scene_file_, path, "two of them are called \"" + name + "\". Give them different names.");
    }

    const Document& document_;
    const SurfaceMesh& mesh_;
    const fs::path& scene_file_;
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
        checked.report.defects.push_back(
            {.kind = Defect::Kind::coarse_coordinates, .count = 1, .places = {}, .text = imported.warning});
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

Constraints make_constraints(const Document& document, const SurfaceMesh& mesh, const fs::path& scene_file) {
    return Collector(document, mesh, scene_file).collect();
}

}  // namespace elastolab
