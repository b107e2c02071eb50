// elastolab-import: reads a mesh file with assimp for load_surface(). In a process of its own, because assimp aborts,
// crashes or loops on some damaged files. Standard input is a socket to the caller.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <Eigen/LU>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesh/input/helper_io.hpp"
#include "mesh/input/import_protocol.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

using Eigen::Vector3d;
namespace fs = std::filesystem;

namespace {

/// Everything of a scene in one mesh.
class Collector {
public:
    void add(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& parent) {
        const Eigen::Matrix4d to_world = parent * matrix(node.mTransformation);
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            if (node.mMeshes[i] >= scene.mNumMeshes)
                throw std::runtime_error("refers to a mesh that it lacks. Export it again.");
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
            throw std::runtime_error("has more than a hundred million vertices or triangles. Simplify it.");
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
                throw std::runtime_error("a face refers to vertex " +
                                         std::to_string(face.mIndices[corner] + std::uint64_t{1}) + " of " +
                                         std::to_string(n_vertices) + ". Export the mesh again.");
            return first + static_cast<int>(face.mIndices[corner]);
        };
        triangles_.emplace_back(at(0), at(mirrored ? 2 : 1), at(mirrored ? 1 : 2));
    }

    std::vector<Vector3d> vertices_;
    std::vector<Eigen::Vector3i> triangles_;
};

/// Positions in the order of an OBJ file's "v" lines: assimp hands out an OBJ's vertices in the order of its faces.
/// Given these lines alone, it takes them for a point cloud and keeps their order, and reads the very same numbers.
Positions obj_vertex_order(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string points;
    for (std::string line; std::getline(stream, line);) {
        if (line.size() > 1 && line[0] == 'v' && (line[1] == ' ' || line[1] == '\t')) points += line + "\n";
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

struct Imported {
    SurfaceMesh mesh;
    Positions order{3, 0};
    std::string problem;
};

bool is_obj(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".obj";
}

Imported read_scene(const fs::path& file) {
    Assimp::Importer importer;
    // Only polygons matter; every other step could reorder, merge or drop.
    const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
    if (scene == nullptr)
        throw std::runtime_error("cannot be read as a mesh (" + std::string(importer.GetErrorString()) +
                                 "). Export it again as OBJ, PLY or STL.");
    Collector collector;
    if (scene->mRootNode != nullptr) collector.add(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity());
    Imported result{collector.mesh(), Positions(3, 0), ""};
    if (result.mesh.n_triangles() == 0)
        throw std::runtime_error("holds no triangle. Export the surface with its faces.");
    if (is_obj(file)) result.order = obj_vertex_order(file);
    return result;
}

Imported import(const fs::path& file) {
    Imported failed;
    try {
        return read_scene(file);
    } catch (const std::bad_alloc&) {
        failed.problem = "asks for more memory than there is. Is it damaged? Export it again.";
    } catch (const std::exception& error) {
        failed.problem = error.what();
    }
    return failed;
}

void reply(const Imported& imported) {
    ImportReplyHeader header;
    header.n_vertices = imported.mesh.n_vertices();
    header.n_order = static_cast<std::int32_t>(imported.order.cols());
    header.n_triangles = imported.mesh.n_triangles();
    header.text_size = static_cast<std::int32_t>(imported.problem.size());
    write_bytes(&header, sizeof(header));
    const auto write = [](const auto& matrix) {
        write_bytes(matrix.data(), sizeof(*matrix.data()) * static_cast<std::size_t>(matrix.size()));
    };
    write(imported.mesh.vertices);
    write(imported.order);
    write(imported.mesh.triangles);
    write(imported.problem);
}

}  // namespace

}  // namespace elastolab

namespace {

void limit(const elastolab::ImportRequestHeader& request) {
    const auto seconds = static_cast<rlim_t>(request.cpu_seconds);
    const rlimit cpu{seconds, seconds};
    ::setrlimit(RLIMIT_CPU, &cpu);
    ::alarm(static_cast<unsigned>(4 * seconds));  // it may also wait: for memory, or for a slow disk
    if (elastolab::kSanitized) return;            // their bookkeeping takes terabytes of addresses
    const auto bytes = static_cast<rlim_t>(request.memory_bytes);
    const rlimit memory{bytes, bytes};
    ::setrlimit(RLIMIT_DATA, &memory);
}

}  // namespace

int main() {
    using namespace elastolab;
    begin_helper();
    ImportRequestHeader request;
    read_bytes(&request, sizeof(request));
    if (request.magic != kImportMagic) return kHelperMisused;
    const std::vector<char> path = read_array<char>(request.path_size);
    limit(request);
    reply(import(std::string(path.begin(), path.end())));
    std::_Exit(0);  // at once: nothing is left to do, and assimp need not tidy up
}
