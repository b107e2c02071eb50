#include "mesh/import.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <Eigen/LU>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/merge.hpp"

namespace elastolab {

using Eigen::Vector3d;
namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& finding) {
    throw MeshError(one_line(file.string() + ": " + finding));
}

void require_readable(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) fail(file, "there is no such file. Check the path.");
    if (fs::is_directory(status)) fail(file, "is a folder. Name a mesh file in it.");
    if (!fs::is_regular_file(status)) fail(file, "is not a regular file. Copy the mesh into one.");
    if (fs::file_size(file, error) == 0) fail(file, "is empty. Export the mesh again.");
    if (!std::ifstream(file)) fail(file, "cannot be opened. Check its permissions.");
}

std::string lower_case_extension(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

/// Everything of a scene in one mesh.
class Collector {
public:
    explicit Collector(const fs::path& file) : file_(file) {}

    void add(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& parent) {
        const Eigen::Matrix4d to_world = parent * matrix(node.mTransformation);
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            if (node.mMeshes[i] >= scene.mNumMeshes) fail(file_, "refers to a mesh that it lacks. Export it again.");
            add(*scene.mMeshes[node.mMeshes[i]], to_world);
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], to_world);
    }

    SurfaceMesh mesh() const {
        SurfaceMesh mesh{Positions(3, static_cast<Eigen::Index>(vertices_.size())),
                         Triangles(3, static_cast<Eigen::Index>(triangles_.size()))};
        for (std::size_t i = 0; i < vertices_.size(); ++i)
            mesh.vertices.col(static_cast<Eigen::Index>(i)) = vertices_[i];
        for (std::size_t i = 0; i < triangles_.size(); ++i)
            mesh.triangles.col(static_cast<Eigen::Index>(i)) = triangles_[i];
        return mesh;
    }

private:
    static Eigen::Matrix4d matrix(const aiMatrix4x4& m) {
        Eigen::Matrix4d result;
        for (unsigned i = 0; i < 4; ++i)
            for (unsigned j = 0; j < 4; ++j) result(static_cast<int>(i), static_cast<int>(j)) = m[i][j];
        return result;
    }

    void add(const aiMesh& mesh, const Eigen::Matrix4d& to_world) {
        if (!mesh.HasFaces() || !mesh.HasPositions()) return;
        constexpr std::size_t kMost = 100'000'000;  // 3 x triangles must fit into an int
        if (vertices_.size() + mesh.mNumVertices > kMost || triangles_.size() + mesh.mNumFaces > kMost)
            fail(file_, "has more than a hundred million vertices or triangles. Simplify it.");
        const auto first = static_cast<int>(vertices_.size());
        const bool moved = !to_world.isIdentity(0.0);  // do not touch the digits of what stays
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const Vector3d p(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
            vertices_.push_back(moved ? Vector3d(to_world.topLeftCorner<3, 3>() * p + to_world.topRightCorner<3, 1>())
                                      : p);
        }
        const bool mirrored = to_world.topLeftCorner<3, 3>().determinant() < 0.0;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) add(mesh.mFaces[f], first, mesh.mNumVertices, mirrored);
    }

    void add(const aiFace& face, int first, unsigned n_vertices, bool mirrored) {
        if (face.mNumIndices != 3) return;  // a point or a line: polygons have been triangulated
        const auto at = [&](unsigned corner) {
            if (face.mIndices[corner] >= n_vertices)
                fail(file_, "a face refers to vertex " + std::to_string(face.mIndices[corner] + std::uint64_t{1}) +
                                " of " + std::to_string(n_vertices) + ". Export the mesh again.");
            return first + static_cast<int>(face.mIndices[corner]);
        };
        triangles_.emplace_back(at(0), at(mirrored ? 2 : 1), at(mirrored ? 1 : 2));
    }

    const fs::path& file_;
    std::vector<Vector3d> vertices_;
    std::vector<Eigen::Vector3i> triangles_;
};

/// Positions in the order of an OBJ file's "v" lines: assimp hands out an OBJ's vertices in the order of its faces.
/// Given these lines alone, it takes them for a point cloud and keeps their order, and reads the very same numbers.
Positions obj_vertex_order(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string points;
    for (std::string line; std::getline(stream, line);) {
        const std::size_t text = line.find_first_not_of(" \t");
        if (text != std::string::npos && line[text] == 'v' && text + 1 < line.size() &&
            std::isspace(line[text + 1] & 0x7f))
            points += line + "\n";
    }
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFileFromMemory(points.data(), points.size(), 0, "obj");
    if (scene == nullptr || scene->mNumMeshes != 1) return Positions(3, 0);
    const aiMesh& cloud = *scene->mMeshes[0];
    Positions order(3, cloud.mNumVertices);
    for (unsigned i = 0; i < cloud.mNumVertices; ++i)
        order.col(i) << cloud.mVertices[i].x, cloud.mVertices[i].y, cloud.mVertices[i].z;
    return order;
}

SurfaceMesh read_scene(const fs::path& file) {
    Assimp::Importer importer;
    // Only points, lines and polygons matter; every other step could reorder, merge or drop.
    const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
    if (scene == nullptr) {
        const std::string reason = importer.GetErrorString();
        fail(file, "cannot be read as a mesh (" + (reason.empty() ? "unknown reason" : reason) +
                       "). Export it again as OBJ, PLY or STL.");
    }
    Collector collector(file);
    if (scene->mRootNode != nullptr) collector.add(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity());
    return collector.mesh();
}

}  // namespace

SurfaceMesh load_surface(const fs::path& file) try {
    require_readable(file);
    const SurfaceMesh mesh = read_scene(file);
    if (mesh.n_triangles() == 0) fail(file, "holds no triangle. Export the surface with its faces.");
    return lower_case_extension(file) == ".obj" ? merged(mesh, obj_vertex_order(file)) : merged(mesh);
} catch (const Error&) {
    throw;
} catch (const std::bad_alloc&) {
    fail(file, "asks for more memory than there is. Is it damaged? Export it again.");
} catch (const std::exception& error) {
    fail(file, "cannot be read (" + std::string(error.what()) + "). Export it again.");
}

}  // namespace elastolab
