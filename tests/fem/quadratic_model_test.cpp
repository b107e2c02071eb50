// FemModel with ten-node elements: what is prescribed, how the updates agree, and what the reactions are.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "elasticity/rigid_motion.hpp"
#include "fem/fem_body.hpp"
#include "fem/model.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

using test::relative_error;
using test::vertices_where;

constexpr double kNu = 0.3;

/// A ball held at its lower side; a patch on its top that touches the held part at its side, and two lone vertices.
struct Ball {
    SurfaceMesh surface = make_sphere(4, 1.0);
    std::vector<int> fixed =
        vertices_where(surface.vertices, surface.n_vertices(), [](const auto& p) { return p[2] < -0.4; });
    std::vector<int> handles = vertices_where(surface.vertices, surface.n_vertices(), [](const auto& p) {
        return p[2] >= -0.4 && (p[0] > 0.75 || p[0] < -0.97 || p[1] > 0.97);
    });

    int n_constrained() const { return static_cast<int>(fixed.size() + handles.size()); }
    std::shared_ptr<const FemModel> model(Update update) const {
        Method method{.kind = kQuadraticFem};
        method.update = update;
        Control control;
        return std::make_shared<FemModel>(surface, "ball", kNu, method, control, ElementDegree::quadratic);
    }
    /// The fixed set at rest, or moving too when it is taken for handles.
    Eigen::VectorXd values() const {
        std::srand(7);
        Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * n_constrained());
        u.tail(3 * std::ssize(handles)).setRandom();
        return u;
    }
    Positions constrained_positions() const {
        Positions p(3, n_constrained());
        p << surface.vertices(Eigen::all, fixed), surface.vertices(Eigen::all, handles);
        return p;
    }
};

struct Answer {
    Eigen::VectorXd u;
    Reactions reactions;
    double residual = 0.0;
};

Answer answer(const FemModel& model, const std::vector<int>& fixed, const std::vector<int>& handles,
              const Eigen::VectorXd& values) {
    Control control;
    const auto solid = model.constrain(fixed, handles, {}, control);
    NodeSolution solution = solid->solve(values, true);
    Answer result{{}, solid->reactions(solution), solid->residual(solution, control)};
    result.u = solid->displacements(std::move(solution));
    return result;
}

TEST(QuadraticModel, UpdatesAgreeWithABaseAndWithout) {
    const Ball ball;
    const Answer direct = answer(*ball.model(Update::direct), ball.fixed, ball.handles, ball.values());
    const auto reduced = ball.model(Update::reduced);
    std::vector<int> all = ball.fixed;
    all.insert(all.end(), ball.handles.begin(), ball.handles.end());
    for (const Answer& other :
         {answer(*reduced, ball.fixed, ball.handles, ball.values()), answer(*reduced, {}, all, ball.values())}) {
        EXPECT_LT(relative_error(other.u, direct.u), 1e-9);
        EXPECT_LT(relative_error(other.reactions.forces, direct.reactions.forces), 1e-9);
        EXPECT_LT(relative_error(other.reactions.moments, direct.reactions.moments), 1e-9);
        EXPECT_LT(other.residual, 1e-12);
    }
    EXPECT_EQ(direct.u.size(), 3 * ball.surface.n_vertices());
}

TEST(QuadraticModel, ForcesAndMomentsBalance) {
    const Ball ball;
    const Answer a = answer(*ball.model(Update::reduced), ball.fixed, ball.handles, ball.values());
    EXPECT_LT(a.reactions.forces.rowwise().sum().norm(), 1e-10 * a.reactions.forces.cwiseAbs().sum());
    EXPECT_LT(a.reactions.moments.rowwise().sum().norm(), 1e-10 * a.reactions.moments.cwiseAbs().sum());
}

TEST(QuadraticModel, ReactionsAreTheDerivativeOfTheEnergy) {
    const Ball ball;
    const auto model = ball.model(Update::direct);
    Control control;
    const auto energy_of = [&](const Eigen::VectorXd& values) {
        const auto solid = model->constrain(ball.fixed, ball.handles, {}, control);
        const Eigen::VectorXd u = solid->solve(values, false).displacements;  // of all nodes
        return 0.5 * u.dot(*model->sparse_stiffness() * u);
    };
    const Eigen::VectorXd values = ball.values();
    const Reactions reactions = answer(*model, ball.fixed, ball.handles, values).reactions;
    const double size = reactions.forces.cwiseAbs().maxCoeff();
    // The energy is quadratic, so that a central difference is exact. One of the fixed set, and of the handles.
    for (const int k : {0, 5, static_cast<int>(std::ssize(ball.fixed)) + 1, ball.n_constrained() - 1})
        for (int i = 0; i < 3; ++i) {
            const Eigen::VectorXd step = Eigen::VectorXd::Unit(values.size(), 3 * k + i);
            EXPECT_NEAR(reactions.forces(i, k), 0.5 * (energy_of(values + step) - energy_of(values - step)),
                        1e-9 * size);
        }
}

TEST(QuadraticModel, MovesAsAWholeWithItsConstrainedVertices) {
    const Ball ball;
    const Eigen::Vector3d translation(0.1, -0.2, 0.3), rotation(1.0, 2.0, -0.5);
    const Eigen::VectorXd values = rigid_motion(ball.constrained_positions(), translation, rotation);
    const Answer a = answer(
        *ball.model(Update::reduced), {},
        [&] {
            std::vector<int> all = ball.fixed;
            all.insert(all.end(), ball.handles.begin(), ball.handles.end());
            return all;
        }(),
        values);
    EXPECT_LT(relative_error(a.u, rigid_motion(ball.surface.vertices, translation, rotation)), 1e-10);
}

TEST(QuadraticModel, PrescribesMidpointsOfConstrainedTrianglesOnly) {
    // Two triangles 0 1 2 and 1 3 2 with midpoints 4 .. 8; lone vertices prescribe themselves only.
    SurfaceMidpoints surface{Triangles(3, 2), Triangles(3, 2)};
    surface.triangles << 0, 1, 1, 3, 2, 2;
    surface.midpoints << 4, 7, 5, 8, 6, 5;
    const Positions positions = Positions::Random(3, 9);
    EXPECT_EQ(constrain_nodes(positions, surface, std::vector{0, 1}, {}).prescribed.nodes, (std::vector{0, 1}));
    EXPECT_EQ(constrain_nodes(positions, surface, std::vector{0, 1, 2}, std::vector{3}).prescribed.nodes,
              (std::vector{0, 1, 2, 4, 5, 6, 3, 7, 8}));
    const ConstrainedFemNodes mixed = constrain_nodes(positions, surface, std::vector{2, 1}, std::vector{3});
    EXPECT_EQ(mixed.n_fixed, 2);
    EXPECT_EQ(mixed.prescribed.nodes, (std::vector{2, 1, 3, 5, 7, 8}));
    const Eigen::VectorXd values = Eigen::VectorXd::Random(9);
    const Eigen::VectorXd at_nodes = mixed.prescribed.prescribe * values;
    EXPECT_EQ(at_nodes.head(9), values);
    EXPECT_LT((at_nodes.segment<3>(9) - 0.5 * (values.head(3) + values.segment<3>(3))).norm(), 1e-15);
    EXPECT_LT((at_nodes.segment<3>(15) - 0.5 * (values.head(3) + values.tail(3))).norm(), 1e-15);
}

}  // namespace
}  // namespace elastolab
