#include "mesh/tets/boundary.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace elastolab {

namespace {

using Face = std::array<int, 3>;

Triangles sorted(std::vector<Face> faces) {
    for (Face& face : faces) std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    std::sort(faces.begin(), faces.end());
    Triangles triangles(3, std::ssize(faces));
    for (std::size_t i = 0; i < faces.size(); ++i)
        triangles.col(static_cast<Eigen::Index>(i)) << faces[i][0], faces[i][1], faces[i][2];
    return triangles;
}

}  // namespace

Triangles boundary_triangles(const TetMesh& mesh) {
    constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    std::vector<std::pair<Face, Face>> faces;  // sorted vertices, and the face as it is
    for (const auto& t : mesh.tetrahedra.colwise())
        for (const auto& f : kFaces) {
            const Face face{t[f[0]], t[f[1]], t[f[2]]};
            Face key = face;
            std::sort(key.begin(), key.end());
            faces.emplace_back(key, face);
        }
    std::sort(faces.begin(), faces.end());
    std::vector<Face> boundary;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const bool shared = (i > 0 && faces[i - 1].first == faces[i].first) ||
                            (i + 1 < faces.size() && faces[i + 1].first == faces[i].first);
        if (!shared) boundary.push_back(faces[i].second);
    }
    return sorted(std::move(boundary));
}

Triangles canonical(const Triangles& triangles) {
    std::vector<Face> faces;
    for (const auto& t : triangles.colwise()) faces.push_back({t[0], t[1], t[2]});
    return sorted(std::move(faces));
}

}  // namespace elastolab
