// Displacements by FEM do not depend on how a body is numbered, oriented or scaled.
#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Dense>

#include "fem/fem_body.hpp"
#include "fem/method.hpp"
#include "fem/model.hpp"
#include "mesh/meshes.hpp"

namespace elastolab {
namespace {

using test::relative_error;
using test::vertices_where;

/// Held below, one side pulled along `pull`; displacements by vertex, 3 x n.
Positions displaced(const SurfaceMesh& surface, const std::vector<int>& fixed, const std::vector<int>& handles,
                    const Eigen::Vector3d& pull, ElementDegree degree) {
    Method method{.kind = kFem};
    Control control;
    const FemModel model(surface, "ball", 0.3, method, control, degree);
    const auto solid = model.constrain(fixed, handles, {}, control);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * std::ssize(fixed));
    values.conservativeResize(values.size() + 3 * std::ssize(handles));
    values.tail(3 * std::ssize(handles)) = pull.replicate(std::ssize(handles), 1);
    return solid->displacements(solid->solve(values, false)).reshaped(3, surface.n_vertices());
}

std::vector<int> placed(std::vector<int> vertices, const Disguised& disguise) {
    for (int& v : vertices) v = disguise.place[static_cast<std::size_t>(v)];
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

class Disguise : public testing::TestWithParam<ElementDegree> {};

TEST_P(Disguise, DoesNotChangeDisplacements) {
    const SurfaceMesh surface = make_lumpy_ball(4);
    const auto where = [&](const auto& predicate) {
        return vertices_where(surface.vertices, surface.n_vertices(), predicate);
    };
    const std::vector<int> fixed = where([](const auto& p) { return p[2] < -0.4; });
    const std::vector<int> handles = where([](const auto& p) { return p[0] > 0.8; });
    const Eigen::Vector3d pull(0.3, -0.2, 0.5);
    const Positions u = displaced(surface, fixed, handles, pull, GetParam());
    unsigned seed = 11;
    for (const Eigen::Matrix3d& turn : disguises()) {
        SCOPED_TRACE(testing::Message() << "turned by\n" << turn);
        const Disguised disguise(surface, turn, seed++);
        const Positions other =
            displaced(disguise.mesh, placed(fixed, disguise), placed(handles, disguise), turn * pull, GetParam());
        EXPECT_LT(relative_error(other(Eigen::all, disguise.place), turn * u), 1e-10);
    }
}

INSTANTIATE_TEST_SUITE_P(Degrees, Disguise, testing::Values(ElementDegree::linear, ElementDegree::quadratic),
                         [](const auto& parameter) {
                             return parameter.param == ElementDegree::linear ? "linear" : "quadratic";
                         });

}  // namespace
}  // namespace elastolab
