// Bodies with re-entrant edges, where stresses are singular as at rims.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bem/galerkin/method.hpp"
#include "methods/finer_mesh.hpp"
#include "methods/problem.hpp"

namespace elastolab::test {
namespace {

/// The surface of some cells of a grid, each in n x n x n cubes of edge 1 / n.
SurfaceMesh surface_of_cells(const Eigen::Array3i& size, const std::function<bool(int, int, int)>& is_kept, int n) {
    const auto filled = [&](const Eigen::Array3i& cube) {
        if ((cube < 0).any() || (cube >= n * size).any()) return false;
        return is_kept(cube[0] / n, cube[1] / n, cube[2] / n);
    };
    std::map<std::array<int, 3>, int> numbers;
    std::vector<Eigen::Vector3i> triangles;
    const auto number = [&](const Eigen::Array3i& at) {
        return numbers.try_emplace({at[0], at[1], at[2]}, static_cast<int>(numbers.size())).first->second;
    };
    Eigen::Array3i cube;
    for (cube[0] = 0; cube[0] < n * size[0]; ++cube[0])
        for (cube[1] = 0; cube[1] < n * size[1]; ++cube[1])
            for (cube[2] = 0; cube[2] < n * size[2]; ++cube[2])
                for (int side = 0; side < 6 && filled(cube); ++side) {
                    const int axis = side / 2, up = side % 2;
                    Eigen::Array3i out = cube, a = cube, p = Eigen::Array3i::Zero(), q = p;
                    out[axis] += up == 1 ? 1 : -1;
                    if (filled(out)) continue;
                    a[axis] += up;
                    p[(axis + 1) % 3] = q[(axis + 2) % 3] = 1;
                    if (up == 0) std::swap(p, q);
                    const int v[4] = {number(a), number(a + p), number(a + p + q), number(a + q)};
                    triangles.emplace_back(v[0], v[1], v[2]);
                    triangles.emplace_back(v[0], v[2], v[3]);
                }
    SurfaceMesh mesh;
    mesh.vertices.resize(3, std::ssize(numbers));
    for (const auto& [at, v] : numbers) mesh.vertices.col(v) = Eigen::Vector3d(at[0], at[1], at[2]) / n;
    mesh.triangles.resize(3, std::ssize(triangles));
    for (std::size_t t = 0; t < triangles.size(); ++t) mesh.triangles.col(static_cast<Eigen::Index>(t)) = triangles[t];
    return mesh;
}

/// A plate with a notch in its middle, pulled at its ends: the error sits at the re-entrant edges of the notch, far
/// from the rims of the constrained faces.
CoarseAndFine notched_plate() {
    const auto is_kept = [](int x, int y, int) { return x != 4 || y > 1; };
    const auto plate = [&](int n) { return surface_of_cells({9, 4, 1}, is_kept, n); };
    return {"notched plate",
            plate(1),
            plate(3),
            [](const auto& x) { return x[0] < kEdge; },
            [](const auto& x) { return x[0] > 9.0 - kEdge; },
            {0.5, 0.0, 0.0}};
}

/// Triangles halved there, as they were before, left half of it by any number of rows.
TEST(FinerRims, TakeMostOfTheErrorAtReentrantEdges) {
    const CoarseAndFine example = notched_plate();
    const Eigen::VectorXd truth = truth_of(example, {.kind = kGalerkinBem, .rims = 2});
    ConstrainedSet set;
    const Eigen::VectorXd values = values_of(example, example.coarse, set);
    std::vector<double> errors;
    for (const int rims : {0, 1, 2}) {
        const Method method{.kind = kGalerkinBem, .rims = rims};
        const Eigen::VectorXd u = displaced(precomputed(make_body(example.coarse), method), set, values);
        errors.push_back(error_against(truth, u));
        print_measured("notched plate, " + std::to_string(rims) + " rows, largest error", errors.back());
    }
    EXPECT_LT(errors[1], 0.42 * errors[0]);
    EXPECT_LT(errors[2], 0.35 * errors[0]);
}

TEST(DiscretisationCheck, SeesTheErrorOfGalerkinAtReentrantEdges) {
    const CoarseAndFine example = notched_plate();
    Control control;
    Deformer deformer(precomputed(make_body(example.coarse), Method{.kind = kGalerkinBem}));
    ConstrainedSet set;
    const Eigen::VectorXd values = values_of(example, example.coarse, set);
    deformer.constrain(set, control);
    const DiscretisationCheck check = deformer.discretisation_check(values, control).value();
    const double error = error_against(truth_of(example, {.kind = kGalerkinBem}), deformer.displace(values));
    print_measured("notched plate, largest error", error);
    print_measured("notched plate, estimate", check.relative_error);
    EXPECT_LT(check.relative_error, 2.0 * error);
    EXPECT_GT(check.relative_error, 0.5 * error);
    EXPECT_LT((example.coarse.vertices.col(check.vertex) - Eigen::Vector3d(4.5, 1.0, 0.5)).norm(), 2.5);
}

}  // namespace
}  // namespace elastolab::test
