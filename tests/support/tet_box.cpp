#include "support/tet_box.hpp"

#include <algorithm>
#include <array>
#include <Eigen/Dense>
#include <map>
#include <random>

namespace elastolab::test {

namespace {

constexpr std::array<std::array<int, 3>, 6> kAxisOrders = {
    {{{0, 1, 2}}, {{1, 2, 0}}, {{2, 0, 1}}, {{0, 2, 1}}, {{2, 1, 0}}, {{1, 0, 2}}}};

bool on_surface(const Eigen::Vector3i& p, const Eigen::Vector3i& cells) {
    return (p.array() == 0).any() || (p.array() == cells.array()).any();
}

/// All grid points, those of the surface first.
std::vector<Eigen::Vector3i> grid_points(const Eigen::Vector3i& cells) {
    std::vector<Eigen::Vector3i> points;
    for (int k = 0; k <= cells[2]; ++k)
        for (int j = 0; j <= cells[1]; ++j)
            for (int i = 0; i <= cells[0]; ++i) points.emplace_back(i, j, k);
    std::stable_partition(points.begin(), points.end(), [&](const auto& p) { return on_surface(p, cells); });
    return points;
}

}  // namespace

TetMesh make_tet_box(const Eigen::Vector3i& cells, const Eigen::Vector3d& size, double jitter) {
    const std::vector<Eigen::Vector3i> points = grid_points(cells);
    const Eigen::Array3d step = size.array() / cells.cast<double>().array();
    std::map<std::array<int, 3>, int> number;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> offset(-jitter, jitter);
    TetMesh mesh;
    mesh.vertices.resize(3, std::ssize(points));
    for (std::size_t v = 0; v < points.size(); ++v) {
        const Eigen::Vector3i& p = points[v];
        number[{p[0], p[1], p[2]}] = static_cast<int>(v);
        if (on_surface(p, cells)) ++mesh.n_surface_vertices;
        for (int axis = 0; axis < 3; ++axis) {
            const bool inside = p[axis] > 0 && p[axis] < cells[axis];
            mesh.vertices(axis, static_cast<Eigen::Index>(v)) =
                step[axis] * (p[axis] + (inside ? offset(random) : 0.0));
        }
    }
    mesh.tetrahedra.resize(4, 6 * cells.prod());
    Eigen::Index t = 0;
    for (const Eigen::Vector3i& p : points) {
        if ((p.array() == cells.array()).any()) continue;
        // A path along the three axes from one corner to the opposite one makes a tetrahedron; odd paths are mirrored.
        for (std::size_t order = 0; order < kAxisOrders.size(); ++order) {
            Eigen::Vector3i q = p;
            Eigen::Vector4i tet;
            for (int corner = 0; corner < 4; ++corner) {
                tet[corner] = number.at({q[0], q[1], q[2]});
                if (corner < 3) ++q[kAxisOrders[order][static_cast<std::size_t>(corner)]];
            }
            if (order >= 3) std::swap(tet[1], tet[2]);
            mesh.tetrahedra.col(t++) = tet;
        }
    }
    return mesh;
}

SurfaceMesh boundary(const TetMesh& mesh) {
    constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    std::map<std::array<int, 3>, std::pair<int, Eigen::Vector3i>> faces;  // by sorted corners: how often, and as seen
    for (const auto& tet : mesh.tetrahedra.colwise())
        for (const auto& f : kFaces) {
            const Eigen::Vector3i face(tet[f[0]], tet[f[1]], tet[f[2]]);
            std::array<int, 3> key = {face[0], face[1], face[2]};
            std::sort(key.begin(), key.end());
            auto& [count, seen] = faces[key];
            ++count;
            seen = face;
        }
    std::vector<Eigen::Vector3i> outer;
    for (const auto& [key, face] : faces)
        if (face.first == 1) outer.push_back(face.second);
    SurfaceMesh surface;
    surface.vertices = mesh.vertices.leftCols(mesh.n_surface_vertices);
    surface.triangles.resize(3, std::ssize(outer));
    for (std::size_t i = 0; i < outer.size(); ++i) surface.triangles.col(static_cast<Eigen::Index>(i)) = outer[i];
    return surface;
}

}  // namespace elastolab::test
