#include "mesh/tets/tet_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>
#include <numbers>

namespace elastolab {

using Eigen::Vector3d;

namespace {

using TetPoints = Eigen::Matrix<double, 3, 4>;

TetPoints tet_points(const TetMesh& mesh, int tetrahedron) {
    return mesh.vertices(Eigen::all, mesh.tetrahedra.col(tetrahedron));
}

double volume_of(const TetPoints& p) {
    return (p.col(1) - p.col(0)).dot((p.col(2) - p.col(0)).cross(p.col(3) - p.col(0))) / 6.0;
}

double longest_edge(const TetPoints& p) {
    double longest = 0.0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) longest = std::max(longest, (p.col(i) - p.col(j)).norm());
    return longest;
}

/// Angle [degrees] at edge i-j between the faces towards the other two vertices.
double dihedral(const TetPoints& p, int i, int j) {
    std::array<int, 2> others{};
    for (int k = 0, n = 0; k < 4; ++k)
        if (k != i && k != j) others[static_cast<std::size_t>(n++)] = k;
    const Vector3d edge = (p.col(j) - p.col(i)).normalized();
    const Vector3d a = edge.cross(p.col(others[0]) - p.col(i)), b = edge.cross(p.col(others[1]) - p.col(i));
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

}  // namespace

double tet_volume(const TetMesh& mesh, int tetrahedron) { return volume_of(tet_points(mesh, tetrahedron)); }

double total_volume(const TetMesh& mesh) {
    double volume = 0.0;
    for (int t = 0; t < mesh.n_tetrahedra(); ++t) volume += tet_volume(mesh, t);
    return volume;
}

TetQuality tet_quality(const TetMesh& mesh) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    TetQuality quality{kInfinity, kInfinity, 180.0, 0.0};
    for (int t = 0; t < mesh.n_tetrahedra(); ++t) {
        const TetPoints p = tet_points(mesh, t);
        const double volume = volume_of(p), longest = longest_edge(p);
        quality.least_volume = std::min(quality.least_volume, volume);
        quality.least_shape =
            std::min(quality.least_shape, 6.0 * std::numbers::sqrt2 * volume / (longest * longest * longest));
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) {
                const double angle = dihedral(p, i, j);
                quality.least_dihedral = std::min(quality.least_dihedral, angle);
                quality.greatest_dihedral = std::max(quality.greatest_dihedral, angle);
            }
    }
    return quality;
}

}  // namespace elastolab
