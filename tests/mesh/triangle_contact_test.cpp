// Contact of two triangles that share a corner, against that of the rest of each with the other one.
#include "mesh/checks/triangle_contact.hpp"

#include <gtest/gtest.h>

#include <random>

namespace elastolab {
namespace {

using Eigen::Vector3d;

/// Corners that triangles around one vertex have beside it, a and b. With small whole numbers many lie in one plane,
/// touch along an edge or cross; moved by a rounding, they hardly do or hardly do not.
class Corners {
public:
    explicit Corners(bool moved) : moved_(moved) {}
    Vector3d next() {
        Vector3d p;
        for (double& x : p) x = whole_(random_) * (moved_ ? 1.0 + 1e-15 * whole_(random_) : 1.0);
        return p;
    }

private:
    std::mt19937 random_{7};
    std::uniform_int_distribution<int> whole_{-2, 2};
    bool moved_;
};

/// Whether the triangle (0, a, b) without a part at 0 meets the triangle (0, c, d); they have no corner in common.
bool rest_meets(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    SurfaceMesh mesh;
    mesh.vertices.resize(3, 7);
    mesh.vertices << a / 16.0, b / 16.0, a, b, Vector3d::Zero(), c, d;
    mesh.triangles.resize(3, 3);
    mesh.triangles << 0, 0, 4,  //
        2, 3, 5,                //
        3, 1, 6;
    return in_contact(mesh, 0, 2) || in_contact(mesh, 1, 2);
}

void expect_right_contacts(bool moved) {
    Corners corners(moved);
    int n_meeting = 0, n_apart = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vector3d a = corners.next(), b = corners.next(), c = corners.next(), d = corners.next();
        const Vector3d zero = Vector3d::Zero();
        if (is_degenerate(zero, a, b) || is_degenerate(zero, c, d)) continue;
        SurfaceMesh mesh;
        mesh.vertices.resize(3, 5);
        mesh.vertices << zero, a, b, c, d;
        mesh.triangles.resize(3, 2);
        mesh.triangles << 0, 0, 1, 3, 2, 4;
        const bool meets = rest_meets(a, b, c, d) || rest_meets(c, d, a, b);
        ASSERT_EQ(in_contact(mesh, 0, 1), meets) << "corners " << mesh.vertices;
        ++(meets ? n_meeting : n_apart);
    }
    EXPECT_GT(n_meeting, 2000);
    EXPECT_GT(n_apart, 2000);
}

TEST(TriangleContact, OfTrianglesAroundAVertexIsThatOfTheirRests) { expect_right_contacts(false); }

TEST(TriangleContact, OfTrianglesAroundAVertexIsExactWithinARounding) { expect_right_contacts(true); }

}  // namespace
}  // namespace elastolab
