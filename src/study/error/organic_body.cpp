#include "study/error/organic_body.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "study/error/sphere_triangulation.hpp"

namespace elastolab {

namespace {

/// A swelling of the unit sphere around a direction: radius += height * exp((p . direction - 1) / width).
struct Bump {
    Eigen::Vector3d direction;
    double height, width;
};

/// A smooth star-shaped surface: the sphere with bumps, then scaled along the axes.
struct Shape {
    std::vector<Bump> bumps;
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();

    Eigen::Vector3d place(const Eigen::Vector3d& p) const {
        double radius = 1.0;
        for (const Bump& bump : bumps)
            radius += bump.height * std::exp((p.dot(bump.direction.normalized()) - 1.0) / bump.width);
        return scale.cwiseProduct(radius * p);
    }
};

/// n of many random points, each as far as possible from those before it, by distances on the shape: spaced evenly but
/// irregularly there.
Positions spread_directions(const Shape& shape, int n) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    Positions candidates(3, 60 * n), places(3, 60 * n);
    for (Eigen::Index i = 0; i < candidates.cols(); ++i) {
        candidates.col(i) = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
        places.col(i) = shape.place(candidates.col(i));
    }
    Eigen::VectorXd distance = Eigen::VectorXd::Constant(candidates.cols(), std::numeric_limits<double>::max());
    Positions chosen(3, n);
    Eigen::Index next = 0;
    for (int k = 0; k < n; ++k) {
        chosen.col(k) = candidates.col(next);
        distance = distance.cwiseMin((places.colwise() - places.col(next)).colwise().squaredNorm().transpose());
        distance.maxCoeff(&next);
    }
    return chosen;
}

SurfaceMesh make_surface(const Shape& shape, int n) {
    const Positions directions = spread_directions(shape, n);
    SurfaceMesh mesh;
    mesh.vertices.resize(3, n);
    for (int i = 0; i < n; ++i) mesh.vertices.col(i) = shape.place(directions.col(i));
    mesh.triangles = triangulate_sphere(directions);
    flip_to_delaunay(mesh.triangles, directions, mesh.vertices);
    return mesh;
}

/// Vertices that a predicate selects and that have a triangle of selected vertices.
std::vector<int> patch(const SurfaceMesh& mesh, const std::function<bool(const Eigen::Vector3d&)>& selects) {
    std::vector<char> kept(static_cast<std::size_t>(mesh.n_vertices()), 0);
    for (const auto& t : mesh.triangles.colwise())
        if (std::all_of(t.begin(), t.end(), [&](int v) { return selects(mesh.vertices.col(v)); }))
            for (int v : t) kept[static_cast<std::size_t>(v)] = 1;
    std::vector<int> vertices;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (kept[static_cast<std::size_t>(v)]) vertices.push_back(v);
    return vertices;
}

/// `tip`: direction of the pulled bump. The cap is within `cap` of its summit; the fixed set is the lowest part, `foot`
/// of the height.
OrganicBody make_body(std::string name, const Shape& shape, int n, const Eigen::Vector3d& tip, double cap,
                      double foot) {
    OrganicBody body{std::move(name), make_surface(shape, n), {}, {}, tip.normalized()};
    const double bottom = body.surface.vertices.row(2).minCoeff(), top = body.surface.vertices.row(2).maxCoeff();
    const Eigen::Vector3d summit = shape.place(tip.normalized());
    body.fixed = patch(body.surface, [&](const auto& p) { return p[2] < bottom + foot * (top - bottom); });
    body.pull = patch(body.surface, [&](const auto& p) { return (p - summit).norm() < cap; });
    return body;
}

/// Element sizes shrink like 1/sqrt(n), and small caps should not vanish between the vertices of a coarse mesh.
double cap_for(int n, double least) { return std::max(least, 6.5 / std::sqrt(static_cast<double>(n))); }

}  // namespace

std::vector<int> OrganicBody::constrained() const {
    std::vector<int> vertices = fixed;
    vertices.insert(vertices.end(), pull.begin(), pull.end());
    return vertices;
}

Positions OrganicBody::values(double distance) const {
    Positions values = Positions::Zero(3, std::ssize(fixed) + std::ssize(pull));
    values.rightCols(std::ssize(pull)).colwise() = distance * pull_direction;
    return values;
}

Positions OrganicBody::turned_values(double angle) const {
    Positions values = Positions::Zero(3, std::ssize(fixed) + std::ssize(pull));
    const Positions rest = surface.vertices(Eigen::all, pull);
    const Eigen::Vector3d middle = rest.rowwise().mean();
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, pull_direction.unitOrthogonal()).toRotationMatrix();
    values.rightCols(std::ssize(pull)) = (turn - Eigen::Matrix3d::Identity()) * (rest.colwise() - middle);
    return values;
}

OrganicBody make_rabbit(int n_vertices) {
    const Eigen::Vector3d ear(0.45, 0.1, 1.0);
    const Shape shape{{{ear, 1.0, 0.03},
                       {{-0.5, 0.15, 1.0}, 0.9, 0.03},
                       {{0.2, -1.0, 0.5}, 0.45, 0.12},
                       {{-0.3, 1.0, -0.4}, 0.25, 0.2}},
                      {0.8, 1.0, 0.9}};
    return make_body("rabbit", shape, n_vertices, ear, cap_for(n_vertices, 0.2), 0.12);
}

OrganicBody make_potato(int n_vertices) {
    const Eigen::Vector3d bump(0.6, -0.3, 0.9);
    const Shape shape{{{bump, 0.35, 0.15},
                       {{-1.0, 0.4, 0.2}, 0.3, 0.25},
                       {{0.1, 1.0, 0.1}, -0.2, 0.2},
                       {{-0.2, -0.7, -0.6}, 0.25, 0.15}},
                      {1.2, 0.8, 0.9}};
    return make_body("potato", shape, n_vertices, bump, cap_for(n_vertices, 0.25), 0.12);
}

OrganicBody make_cactus(int n_vertices) {
    const Eigen::Vector3d arm(1.0, 0.2, 0.45);
    const Shape shape{{{{0.0, 0.1, 1.0}, 0.9, 0.1},
                       {arm, 1.1, 0.035},
                       {{-1.0, 0.3, 0.6}, 0.9, 0.04},
                       {{-0.1, -1.0, 0.1}, 0.8, 0.05},
                       {{0.0, 0.0, -1.0}, 0.4, 0.2}},
                      {0.7, 0.7, 0.9}};
    return make_body("cactus", shape, n_vertices, arm, cap_for(n_vertices, 0.2), 0.1);
}

std::vector<OrganicBody> organic_bodies() { return {make_rabbit(), make_potato(), make_cactus()}; }

}  // namespace elastolab
