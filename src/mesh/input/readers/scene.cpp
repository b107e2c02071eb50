#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/IOSystem.hpp>
#include <cctype>
#include <cstdint>
#include <Eigen/LU>
#include <limits>
#include <string>
#include <system_error>

#include "mesh/input/readers/polygons.hpp"
#include "mesh/input/readers/readers.hpp"
#include "mesh/input/readers/regular_file.hpp"

namespace elastolab {

using Eigen::Vector3d;
namespace fs = std::filesystem;

namespace {

/// What assimp may open: regular files in the folder of the mesh or below it (a glTF file names its buffers), to read
/// them. Anything else does not exist for it.
class FolderOfMesh : public Assimp::IOSystem {
public:
    explicit FolderOfMesh(const fs::path& mesh) : mesh_(fs::weakly_canonical(mesh)), folder_(folder_of(mesh)) {}

    bool Exists(const char* file) const override {
        std::error_code ignored;
        return fs::is_regular_file(file, ignored) && is_allowed(file);
    }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode) override {
        if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos || !is_allowed(file)) return nullptr;
        const std::optional<std::string> bytes = read_regular_file(file);
        if (!bytes || bytes->empty()) return nullptr;
        auto* copy = new std::uint8_t[bytes->size()];  // NOLINT: the stream owns it, with delete[]
        std::copy(bytes->begin(), bytes->end(), copy);
        return new Assimp::MemoryIOStream(copy, bytes->size(), true);  // NOLINT: Close deletes it
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }  // NOLINT

private:
    static fs::path folder_of(const fs::path& mesh) { return fs::weakly_canonical(fs::absolute(mesh).parent_path()); }

    bool is_allowed(const fs::path& file) const {
        std::error_code error;
        const fs::path place = fs::weakly_canonical(fs::absolute(file), error);
        if (error) return false;
        const auto [rest, unused] = std::mismatch(folder_.begin(), folder_.end(), place.begin(), place.end());
        return place == mesh_ || rest == folder_.end();
    }

    fs::path mesh_, folder_;
};

/// Everything of a scene in one mesh.
class Collector {
public:
    void add(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& parent) {
        const Eigen::Matrix4d to_world = parent * matrix(node.mTransformation);
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            if (node.mMeshes[i] >= scene.mNumMeshes) throw Refusal("refers to a mesh that it lacks. Export it again.");
            add(*scene.mMeshes[node.mMeshes[i]], to_world);
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], to_world);
    }

    const PolygonMesh& mesh() const { return mesh_; }

private:
    static Eigen::Matrix4d matrix(const aiMatrix4x4& m) {
        Eigen::Matrix4d result;
        for (unsigned i = 0; i < 4; ++i)
            for (unsigned j = 0; j < 4; ++j) result(static_cast<int>(i), static_cast<int>(j)) = m[i][j];
        return result;
    }

    void add(const aiMesh& mesh, const Eigen::Matrix4d& to_world) {
        if (!mesh.HasFaces() || !mesh.HasPositions()) return;
        const auto first = static_cast<std::int64_t>(mesh_.vertices.size());
        const bool moved = !to_world.isIdentity(0.0);  // do not touch the digits of what stays
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const Vector3d p(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
            mesh_.vertices.push_back(
                moved ? Vector3d(to_world.topLeftCorner<3, 3>() * p + to_world.topRightCorner<3, 1>()) : p);
        }
        if (mesh_.vertices.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
            throw Refusal("has too many vertices. Simplify it.");
        const bool mirrored = to_world.topLeftCorner<3, 3>().determinant() < 0.0;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) add(mesh.mFaces[f], first, mesh.mNumVertices, mirrored);
    }

    void add(const aiFace& face, std::int64_t first, unsigned n_vertices, bool mirrored) {
        if (face.mNumIndices < 3) return;  // a point or a line
        const std::size_t begin = mesh_.corners.size();
        for (unsigned i = 0; i < face.mNumIndices; ++i)
            mesh_.corners.push_back(static_cast<int>(first + checked_index(face.mIndices[i], n_vertices)));
        if (mirrored) std::reverse(mesh_.corners.begin() + static_cast<std::ptrdiff_t>(begin) + 1, mesh_.corners.end());
        mesh_.close_polygon();
    }

    PolygonMesh mesh_;
};

/// What assimp says, which may quote anything from the file.
std::string reason(const Assimp::Importer& importer) {
    constexpr std::size_t kLongest = 200;
    std::string text = importer.GetErrorString();
    if (text.find("bad_alloc") != std::string::npos) return "it asks for more memory than there is";
    if (text.find("JSON") != std::string::npos) return "its JSON is not complete";
    if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
    while (!text.empty() && (text.back() == '.' || text.back() == '\n')) text.pop_back();
    return text;
}

}  // namespace

SurfaceMesh read_scene(const fs::path& file) {
    Assimp::Importer importer;
    importer.SetIOHandler(new FolderOfMesh(file));  // NOLINT: the importer owns it
    // No step of assimp's own: each could reorder, merge or drop.
    const aiScene* scene = importer.ReadFile(file.string(), 0);
    if (scene == nullptr)
        throw Refusal("cannot be read as a mesh (" + reason(importer) + "). Export it again as OBJ, PLY or STL.");
    Collector collector;
    if (scene->mRootNode != nullptr) collector.add(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity());
    return triangulated(collector.mesh());
}

}  // namespace elastolab
