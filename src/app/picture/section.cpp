#include "app/picture/section.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace elastolab {

namespace {

/// Corners of the face opposite each corner of a positively oriented tetrahedron, counter-clockwise from outside.
constexpr std::array<std::array<int, 3>, 4> kFaces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct Face {
    std::array<int, 3> sorted, corners;
    bool operator<(const Face& other) const { return sorted < other.sorted; }
};

bool is_kept(const TetMesh& mesh, Eigen::Index t, const SectionPlane& plane) {
    const double center = mesh.vertices(plane.axis, mesh.tetrahedra.col(t)).mean();
    return (center < plane.coordinate) != plane.flip;
}

}  // namespace

Triangles cut_faces(const TetMesh& mesh, const SectionPlane& plane) {
    std::vector<Face> faces;
    for (Eigen::Index t = 0; t < mesh.tetrahedra.cols(); ++t) {
        if (!is_kept(mesh, t, plane)) continue;
        for (const auto& face : kFaces) {
            Face f;
            for (std::size_t i = 0; i < 3; ++i) f.corners[i] = mesh.tetrahedra(face[i], t);
            f.sorted = f.corners;
            std::sort(f.sorted.begin(), f.sorted.end());
            faces.push_back(f);
        }
    }
    std::sort(faces.begin(), faces.end());
    std::vector<Face> outer;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const bool shared = (i > 0 && faces[i].sorted == faces[i - 1].sorted) ||
                            (i + 1 < faces.size() && faces[i].sorted == faces[i + 1].sorted);
        if (!shared) outer.push_back(faces[i]);
    }
    Triangles triangles(3, std::ssize(outer));
    for (std::size_t i = 0; i < outer.size(); ++i)
        triangles.col(static_cast<Eigen::Index>(i)) = Eigen::Vector3i(outer[i].corners.data());
    return triangles;
}

}  // namespace elastolab
