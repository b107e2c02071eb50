#include "scene/scene_mesh.hpp"

#include <cmath>

#include "mesh/input/import.hpp"
#include "mesh/primitives.hpp"
#include "scene/scene_failure.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

SurfaceMesh make_mesh(const Primitive& primitive, const fs::path& scene_file) {
    try {
        return make_primitive(primitive.name, primitive.resolution, primitive.size);
    } catch (const MeshError& error) {
        fail_at(scene_file, "/mesh", error.what());
    }
}

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
        fail_at(scene_file, "/material/young_modulus",
                "is " + exact(material.young_modulus) +
                    ", below the range of numbers that keep all their digits. Choose another unit of force.");
    if (const std::string why = refusal({.kind = kind}, material.poisson_ratio); !why.empty())
        throw SceneError(one_line(place(scene_file, "/material/" + why)));
}

}  // namespace elastolab
