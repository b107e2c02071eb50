#include "bem/boundary_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "elasticity/exact_fields.hpp"
#include "elasticity/stress.hpp"
#include "mesh/primitives.hpp"

namespace elastolab::test {
namespace {

/// Points well inside the box of size 2 x 1 x 1.
Positions inside_points() {
    Positions points(3, 27);
    for (int i = 0; i < 27; ++i)
        points.col(i) = Eigen::Vector3d(0.5 + 0.47 * (i % 3), 0.29 + 0.2 * (i / 3 % 3), 0.31 + 0.18 * (i / 9));
    return points;
}

/// Largest error of the stress from exact displacements of the vertices and exact tractions at all corners, over the
/// largest stress.
template <class Field>
double stress_error(const Field& field, int cells) {
    const auto boundary = std::make_shared<const Boundary>(make_box(cells, {2.0, 1.0, 1.0}));
    const SurfaceMesh& mesh = boundary->mesh();
    Eigen::MatrixXd u(3 * mesh.n_vertices(), 1);
    for (int v = 0; v < mesh.n_vertices(); ++v)
        u.middleRows<3>(3 * v) = field.displacement(mesh.vertices.col(v)) / field.material.young_modulus;
    Elements corners{Elements::Order::linear, 3 * mesh.n_triangles(), {}};
    Eigen::MatrixXd t(9 * mesh.n_triangles(), 1);
    for (int i = 0; i < mesh.n_triangles(); ++i) {
        corners.elements.push_back({i, {3 * i, 3 * i + 1, 3 * i + 2}});
        const Eigen::Map<const Eigen::Vector3d> n(boundary->triangle(i).n);
        for (int k = 0; k < 3; ++k)
            t.middleRows<3>(9 * i + 3 * k) = field.stress(mesh.vertices.col(mesh.triangles(k, i))) * n;
    }
    SurfaceTractions tractions(1);
    tractions.add(corners, t);
    Control control;
    const Positions points = inside_points();
    const BoundaryField solid(boundary, field.material.poisson_ratio, u, tractions);
    const InteriorValues values = solid.at(points, control);
    double error = 0.0, size = 0.0;
    for (int i = 0; i < points.cols(); ++i) {
        const StressNumbers truth = stress_numbers(field.stress(points.col(i)));
        error = std::max(error, (values.stresses.col(0).segment<6>(6 * i) - truth).norm());
        size = std::max(size, truth.norm());
    }
    return error / size;
}

/// The tolerance of the rules far from a point is 1e-5; times lambda / mu it would be 5000 and 0.5.
TEST(BoundaryField, KeepsLinearStressUpToIncompressibility) {
    for (const double nu : {0.0, 0.3, 0.499, 0.49999, 0.5})
        EXPECT_LT(stress_error(UniaxialStretch{{1.0, nu}, 0.7}, 3), 2e-5) << nu;
}

TEST(BoundaryField, ConvergesAsFastWhenIncompressible) {
    const auto bending = [](double nu, int cells) { return stress_error(PureBending{{1.0, nu}}, cells); };
    for (const int cells : {3, 6}) {
        const double compressible = bending(0.3, cells);
        for (const double nu : {0.499, 0.49999, 0.5}) EXPECT_LT(bending(nu, cells), 2.0 * compressible) << nu;
    }
    EXPECT_LT(bending(0.5, 6), 0.35 * bending(0.5, 3));
}

}  // namespace
}  // namespace elastolab::test
