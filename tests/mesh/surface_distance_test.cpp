#include "mesh/surface_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numeric>
#include <random>

#include "mesh/box_tree.hpp"
#include "mesh/measures.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

using Eigen::Vector3d;

/// Every vertex off its place by up to `size`: no two distances are the same.
SurfaceMesh rough(SurfaceMesh mesh, double size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> offset(-size, size);
    for (auto x : mesh.vertices.reshaped()) x += offset(random);
    return mesh;
}

/// Bodies with walls and gaps thin and thick; exact ones, where many vertices are equally close, and rough ones.
std::vector<SurfaceMesh> bodies() {
    const SurfaceMesh plate = make_box(1, {2.0, 2.0, 0.2}), sphere = make_sphere(8);
    const SurfaceMesh hollow = inside_out(scaled(sphere, 0.97));
    return {make_box(3),
            sphere,
            make_torus(3),
            plate,
            rough(plate, 0.01),
            joined(sphere, hollow),
            rough(joined(sphere, hollow), 0.002),
            joined(plate, moved(plate, {0.0, 0.0, 0.21})),
            rough(joined(make_box(1, {9.0, 9.0, 1.0}), moved(make_sphere(6), {0.5, 0.5, 1.52})), 0.001)};
}

double longest_edge(const TrianglePoints& p) {
    return std::max({(p.b - p.a).norm(), (p.c - p.b).norm(), (p.a - p.c).norm()});
}

/// By all pairs.
FacingApproach reference_approach(const SurfaceMesh& mesh) {
    Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, mesh.n_vertices());
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (const int v : mesh.triangles.col(t)) normals.col(v) += area_vector(triangle_points(mesh, t));
    FacingApproach closest;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        for (int t = 0; t < mesh.n_triangles(); ++t) {
            const TrianglePoints p = triangle_points(mesh, t);
            if (area_vector(p).normalized().dot(normals.col(v).normalized()) > -0.5) continue;
            if ((mesh.triangles.col(t).array() == v).any()) continue;
            const double ratio = distance_to_triangle(mesh.vertices.col(v), mesh, t) / longest_edge(p);
            if (ratio < 1.0 && ratio < closest.ratio) closest = {ratio, v};
        }
    return closest;
}

TEST(SurfaceDistance, FindsTheApproachThatAllPairsShow) {
    int n_found = 0;
    for (const SurfaceMesh& body : bodies()) {
        const FacingApproach expected = reference_approach(body);
        Control control;
        const FacingApproach found = closest_facing_approach(body, control);
        EXPECT_EQ(found.ratio, expected.ratio);
        EXPECT_EQ(found.vertex, expected.vertex);
        n_found += static_cast<int>(std::isfinite(found.ratio));
    }
    EXPECT_GE(n_found, 6) << "of which most have thin walls";
}

/// By all pairs, in the order that the header names.
std::optional<Contact> reference_contact(const SurfaceMesh& mesh, const std::vector<std::vector<int>>& parts,
                                         double distance) {
    const auto part_of = [&](int v) {
        return static_cast<std::size_t>(
            std::find_if(parts.begin(), parts.end(),
                         [&](const auto& part) { return std::find(part.begin(), part.end(), v) != part.end(); }) -
            parts.begin());
    };
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (std::size_t own = part_of(mesh.triangles(0, t)), p = 0; p < parts.size(); ++p)
            for (const int v : parts[p])
                if (p != own && distance_to_triangle(mesh.vertices.col(v), mesh, t) < distance)
                    return Contact{std::min(own, p), std::max(own, p), v};
    return std::nullopt;
}

TEST(SurfaceDistance, FindsTheContactThatAllPairsShow) {
    const SurfaceMesh box = make_box(2), ball = make_sphere(3);
    for (const double gap : {0.0, 0.009, 0.011, 1.0}) {
        const double side = box.vertices.row(0).maxCoeff() - box.vertices.row(0).minCoeff();
        const SurfaceMesh two = joined(box, moved(box, {side + gap, 0.1, 0.0}));
        const SurfaceMesh mesh = joined(two, moved(ball, {0.0, 0.0, 30.0}));
        std::vector<std::vector<int>> parts(3);
        for (int v = 0; v < mesh.n_vertices(); ++v)
            parts[static_cast<std::size_t>(std::min(2, v / box.n_vertices()))].push_back(v);
        const std::optional<Contact> expected = reference_contact(mesh, parts, 0.01);
        Control control;
        const std::optional<Contact> found = find_contact(mesh, parts, 0.01, control);
        ASSERT_EQ(found.has_value(), gap < 0.01);
        ASSERT_EQ(expected.has_value(), found.has_value());
        if (!found) continue;
        EXPECT_EQ(found->first, expected->first);
        EXPECT_EQ(found->second, expected->second);
        EXPECT_EQ(found->vertex, expected->vertex);
    }
}

TEST(SurfaceDistance, StopsWhenCancelled) {
    const SurfaceMesh sphere = make_sphere(4);
    Control control;
    control.cancel();
    std::vector<int> all(static_cast<std::size_t>(sphere.n_vertices()));
    std::iota(all.begin(), all.end(), 0);
    EXPECT_THROW(closest_facing_approach(sphere, control), Cancelled);
    EXPECT_THROW(find_contact(sphere, std::vector{all, {}}, 0.1, control), Cancelled);
}

TEST(BoxTree, ShowsAPointTheTrianglesAroundItOnly) {
    for (const int cells : {8, 32}) {
        const SurfaceMesh sphere = make_sphere(cells);
        std::vector<int> all(static_cast<std::size_t>(sphere.n_triangles()));
        std::iota(all.begin(), all.end(), 0);
        const BoxTree tree(sphere, all);
        std::ptrdiff_t n_shown = 0;
        constexpr int kEvery = 20;
        for (int v = 0; v < sphere.n_vertices(); v += kEvery) {
            const Vector3d x = sphere.vertices.col(v);
            std::vector<int> shown;
            tree.for_each_near(
                x, [](double edge) { return 0.5 * edge; }, [&](int t) { shown.push_back(t); });
            n_shown += std::ssize(shown);
            std::sort(shown.begin(), shown.end());
            for (const int t : all)
                if (distance_to_triangle(x, sphere, t) < 0.5 * longest_edge(triangle_points(sphere, t))) {
                    ASSERT_TRUE(std::binary_search(shown.begin(), shown.end(), t));
                }
        }
        const std::ptrdiff_t n_points = (sphere.n_vertices() + kEvery - 1) / kEvery;
        EXPECT_LT(n_shown, 50 * n_points) << "whatever their number";
    }
}

}  // namespace
}  // namespace elastolab
