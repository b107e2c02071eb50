#include <gmock/gmock.h>

#include <cmath>
#include <Eigen/Geometry>
#include <numbers>
#include <numeric>
#include <vector>

#include "mesh/input/readers/polygons.hpp"
#include "mesh/input/readers/readers.hpp"

namespace elastolab {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Cut {
    std::vector<Vector3d> vertices;
    std::vector<Eigen::Vector3i> triangles;
    Vector3d normal;
};

/// Triangulates a plane polygon, turned and moved in space.
Cut cut(const std::vector<Vector2d>& polygon) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
    Cut result{{}, {}, R.col(2)};
    for (const Vector2d& p : polygon) result.vertices.push_back(R * Vector3d(p.x(), p.y(), 0.0) + Vector3d(5, -3, 2));
    std::vector<int> corners(polygon.size());
    std::iota(corners.begin(), corners.end(), 0);
    triangulate(corners, result.vertices, result.triangles);
    return result;
}

/// Signed areas of the triangles along the polygon's normal.
std::vector<double> areas(const Cut& cut) {
    std::vector<double> result;
    for (const Eigen::Vector3i& t : cut.triangles) {
        const auto at = [&](int i) { return cut.vertices[static_cast<std::size_t>(t[i])]; };
        result.push_back(0.5 * cut.normal.dot((at(1) - at(0)).cross(at(2) - at(0))));
    }
    return result;
}

double shoelace(const std::vector<Vector2d>& p) {
    double twice = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vector2d &a = p[i], &b = p[(i + 1) % p.size()];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * twice;
}

/// Triangles that all face along the polygon and have its area together do not overlap, if they lie in it.
void expect_covered(const std::vector<Vector2d>& polygon, double least_part) {
    const std::vector<double> parts = areas(cut(polygon));
    ASSERT_EQ(parts.size(), polygon.size() - 2);
    EXPECT_NEAR(std::accumulate(parts.begin(), parts.end(), 0.0), shoelace(polygon), 1e-12);
    for (const double area : parts) EXPECT_GT(area, least_part * shoelace(polygon));
}

TEST(Polygons, AreCoveredByTheirTriangles) {
    expect_covered({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.4);
    expect_covered({{0, 0}, {2, 2}, {0, 0.5}, {-2, 2}}, 0.1);                                // an arrow
    expect_covered({{2, 2}, {0, 0.5}, {-2, 2}, {0, 0}}, 0.1);                                // begun elsewhere
    expect_covered({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 0.05);                  // an L
    expect_covered({{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 0.01);  // a U
    expect_covered({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}, 0.01);  // corners on edges
    // A square with a square hole, joined by an edge there and back.
    expect_covered({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}}, 0.01);
    std::vector<Vector2d> star;
    for (int i = 0; i < 40; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 40.0, radius = i % 2 == 0 ? 1.0 : 0.4;
        star.push_back(radius * Vector2d(std::cos(angle), std::sin(angle)));
    }
    expect_covered(star, 1e-3);
}

TEST(Polygons, CountCornersAtTheSamePlaceOnce) {
    const Cut repeated = cut({{0, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}, {0, 0}});
    EXPECT_EQ(repeated.triangles.size(), 2u);
    EXPECT_TRUE(cut({{0, 0}, {1, 0}, {1, 0}, {0, 0}}).triangles.empty());
}

TEST(Polygons, ThatAreNotFlatBecomeASurfaceWithTheirRim) {
    std::vector<Vector3d> saddle;
    for (int i = 0; i < 12; ++i) {
        const double angle = std::numbers::pi * i / 6.0;
        saddle.emplace_back(std::cos(angle), std::sin(angle), 0.3 * std::cos(2.0 * angle));
    }
    std::vector<int> corners(saddle.size());
    std::iota(corners.begin(), corners.end(), 0);
    std::vector<Eigen::Vector3i> triangles;
    triangulate(corners, saddle, triangles);
    ASSERT_EQ(triangles.size(), 10u);
    int rim = 0;  // half-edges from a corner to the next one
    for (const Eigen::Vector3i& t : triangles)
        for (int k = 0; k < 3; ++k) rim += t[(k + 1) % 3] == (t[k] + 1) % 12 ? 1 : 0;
    EXPECT_EQ(rim, 12);
}

/// A disc of 100 000 corners is split at once; a comb of as many is refused with a word.
TEST(Polygons, OfManyCornersAreSplitOrRefusedWithAWord) {
    constexpr int kCorners = 100'000;
    std::vector<Eigen::Vector3d> disc, comb;
    std::vector<int> all;
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kCorners;
        disc.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        const bool is_tooth = i % 2 == 1;
        comb.emplace_back((is_tooth ? 2.0 : 1.0) * disc.back());
        all.push_back(i);
    }
    std::vector<Eigen::Vector3i> triangles;
    triangulate(all, disc, triangles);
    ASSERT_EQ(std::ssize(triangles), kCorners - 2);
    double area = 0.0;
    for (const Eigen::Vector3i& t : triangles) {
        const auto corner = [&](int k) { return disc[static_cast<std::size_t>(t[k])]; };
        area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).z();
    }
    EXPECT_NEAR(area, std::numbers::pi, 1e-6);
    try {
        triangulate(all, comb, triangles);
        FAIL();
    } catch (const Refusal& refusal) {
        EXPECT_NE(std::string(refusal.what()).find("Triangulate the mesh"), std::string::npos) << refusal.what();
    }
}

}  // namespace
}  // namespace elastolab
