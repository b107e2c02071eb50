#include "app/scene_files.hpp"

#include <utility>
#include <vector>

#include "mesh/input/export.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr double kLowestPart = 0.06;  ///< of a bare mesh that is held, of its height

/// Holds the lowest part of a body that nothing holds yet. The person has changed nothing by that.
void hold_lowest(LiveScene& scene, const Eigen::Vector3d& up) {
    const Eigen::RowVectorXd heights = up.transpose() * scene.mesh().vertices;
    const double limit = heights.minCoeff() + kLowestPart * (heights.maxCoeff() - heights.minCoeff());
    std::vector<int> lowest;
    for (Eigen::Index v = 0; v < heights.size(); ++v)
        if (heights[v] <= limit) lowest.push_back(static_cast<int>(v));
    scene.fix(lowest);
    scene.commit();
    scene.mark_saved();
}

}  // namespace

/// Our scenes have Z up; bare meshes mostly Y, as most modelling programs have it.
LoadedScene load_scene_or_mesh(const fs::path& file, Control& control) {
    if (is_scene_file(file))
        return {std::make_unique<LiveScene>(load_scene(file), file, control), Eigen::Vector3d::UnitZ(),
                fs::absolute(file)};
    auto scene = std::make_unique<LiveScene>(document_for_mesh(file), file.parent_path() / "scene.json", control);
    const Eigen::Vector3d up = Eigen::Vector3d::UnitY();
    hold_lowest(*scene, up);
    return {std::move(scene), up, {}};
}

void write_scene(const fs::path& file, const LiveScene& scene, MethodKind method, const ViewPoint& camera) {
    Document document = scene.document();
    document.method = method;
    document.camera = camera;
    if (auto* mesh = std::get_if<MeshFile>(&document.mesh)) {
        const fs::path absolute = fs::absolute(scene.file().parent_path() / mesh->file).lexically_normal();
        const fs::path relative = absolute.lexically_relative(fs::absolute(file).parent_path());
        mesh->file = relative.empty() ? absolute.string() : relative.string();
    }
    save_scene(file, document);
}

void write_deformed_mesh(const fs::path& file, const LiveScene& scene, const Eigen::VectorXd& displacement) {
    SurfaceMesh mesh = scene.mesh();
    if (displacement.size() == mesh.vertices.size())
        mesh.vertices += Eigen::Map<const Eigen::Matrix3Xd>(displacement.data(), 3, displacement.size() / 3);
    save_surface(file, mesh);
}

Document default_document() {
    Document document;
    document.method = first_method();
    document.mesh = Primitive{.name = "cube", .resolution = 13, .size = {}};
    document.fixed = Selector{PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-6}};
    return document;
}

Document document_for_mesh(const fs::path& mesh) {
    Document document;
    document.method = first_method();
    document.mesh = MeshFile{fs::absolute(mesh).string()};
    return document;
}

}  // namespace elastolab
