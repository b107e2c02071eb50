// Loads under large deformations: their derivatives, homogeneous states and a hanging bar in closed form, balance.
#include "fem/nonlinear/loads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "elasticity/neo_hookean.hpp"
#include "fem/load_vectors.hpp"
#include "fem/nonlinear/bodies.hpp"

namespace elastolab {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

using Where = std::function<bool(const Vector3d&)>;

/// A box [0, size] with its surface as loads number it.
struct LoadedBox {
    LoadedBox(const Eigen::Vector3i& cells, const Vector3d& size, ElementDegree degree, double jitter = 0.1) {
        const TetMesh mesh = test::make_tet_box(cells, size, jitter);
        surface = test::boundary(mesh);
        if (degree == ElementDegree::linear) {
            elements = std::make_shared<FiniteElements>(mesh.vertices, mesh.tetrahedra);
            return;
        }
        const QuadraticMesh quadratic(mesh);
        midpoints = midpoints_of(surface.triangles, quadratic);
        elements = std::make_shared<FiniteElements>(quadratic.positions, quadratic.elements);
    }
    std::vector<int> triangles(const Where& where) const {
        std::vector<int> found;
        for (int t = 0; t < surface.n_triangles(); ++t) {
            const Eigen::Vector3i corners = surface.triangles.col(t);
            bool all = true;
            for (const int v : corners) all = all && where(surface.vertices.col(v));
            if (all) found.push_back(t);
        }
        return found;
    }
    NonlinearLoads loads(const std::vector<UnitLoad>& units) const {
        return {elements, surface.triangles, midpoints, units};
    }
    /// Values of these nodes by x -> F x, then factors.
    VectorXd values(const std::vector<int>& nodes, const Matrix3d& F, const VectorXd& factors) const {
        const VectorXd all = test::affine(*elements, F);
        VectorXd values(3 * std::ssize(nodes) + factors.size());
        for (std::size_t i = 0; i < nodes.size(); ++i)
            values.segment<3>(3 * static_cast<Eigen::Index>(i)) = all.segment<3>(3 * nodes[i]);
        values.tail(factors.size()) = factors;
        return values;
    }
    NodeSolution solve(const std::vector<int>& nodes, const std::vector<UnitLoad>& units, const VectorXd& values,
                       const Material& material) const {
        Control control;
        const NonlinearSolver solver(elements, material, {nodes, static_cast<int>(nodes.size()), !nodes.empty()},
                                     control, loads(units));
        return solver.solve(values, true);
    }

    SurfaceMesh surface;
    Triangles midpoints;
    std::shared_ptr<const FiniteElements> elements;
};

VectorXd random_vector(Eigen::Index n, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-size, size);
    return VectorXd::NullaryExpr(n, [&] { return number(random); });
}

/// The root of a function that rises.
double root(const std::function<double(double)>& f, double low, double high) {
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (f(middle) > 0.0 ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

/// Principal stretches of a bar with free sides under the nominal traction `along(lambda, lateral)`: the two scalar
/// equations P_11 = along and P_22 = 0, written out.
Vector3d uniaxial(const Material& m, const std::function<double(double, double)>& along) {
    const double mu = m.shear_modulus(), lambda = m.lame_lambda();
    const auto P = [&](double own, double J) { return mu * (own - 1.0 / own) + lambda * std::log(J) / own; };
    const auto lateral = [&](double s) { return root([&](double b) { return P(b, s * b * b); }, 0.05, 4.0); };
    const double s =
        root([&](double x) { return P(x, x * lateral(x) * lateral(x)) - along(x, lateral(x)); }, 0.1, 10.0);
    return {s, lateral(s), lateral(s)};
}

double difference(const VectorXd& a, const VectorXd& b) { return (a - b).norm() / b.norm(); }

class LoadsOfDegree : public testing::TestWithParam<ElementDegree> {};
INSTANTIATE_TEST_SUITE_P(NonlinearLoads, LoadsOfDegree,
                         testing::Values(ElementDegree::linear, ElementDegree::quadratic), [](const auto& degree) {
                             return degree.param == ElementDegree::linear ? "FourNodes" : "TenNodes";
                         });

/// A weight, a force and a pressure on the upper half of a box.
std::vector<UnitLoad> three_loads(const LoadedBox& box) {
    const auto half = box.triangles([](const Vector3d& x) { return x[2] > 0.4; });
    return {body_force_along(1), unit_force(box.surface, half, {1.0, 0.5, -2.0}), unit_pressure(box.surface, half)};
}

TEST_P(LoadsOfDegree, ForcesChangeAsTheirDerivativesSay) {
    const LoadedBox box({2, 2, 2}, {1, 1, 1}, GetParam());
    const NonlinearLoads loads = box.loads(three_loads(box));
    const Eigen::Index n = 3 * box.elements->n_nodes();
    const VectorXd u = random_vector(n, 0.1, 1), motion = random_vector(n, 0.1, 2), factors = random_vector(3, 1, 3),
                   change = random_vector(3, 1, 4);
    constexpr double h = 1e-5;
    const VectorXd numerical =
        (loads.forces(u + h * motion, factors + h * change) - loads.forces(u - h * motion, factors - h * change)) /
        (2.0 * h);
    EXPECT_LT(difference(loads.force_change(u, factors, motion, change), numerical), 1e-9);
}

/// v . S w of the element blocks against the mean of v . D w and w . D v.
TEST_P(LoadsOfDegree, TheTangentIsTheSymmetricPartOfTheDerivative) {
    const LoadedBox box({2, 1, 2}, {1, 1, 1}, GetParam());
    const NonlinearLoads loads = box.loads(three_loads(box));
    const Eigen::Index n = 3 * box.elements->n_nodes();
    const VectorXd u = random_vector(n, 0.1, 1), v = random_vector(n, 1, 2), w = random_vector(n, 1, 3),
                   factors = random_vector(3, 1, 4), none = loads.none();
    ElementWork work = box.elements->make_work();
    std::fill(work.stiffness.begin(), work.stiffness.end(), 0.0);
    loads.add_tangent(u, factors, work);
    const int nodes = box.elements->nodes_per_element();
    double sum = 0.0;
    for (int e = 0; e < box.elements->n_elements(); ++e)
        for (int a = 0; a < nodes; ++a)
            for (int b = 0; b < nodes; ++b) {
                const double* block =
                    work.stiffness.data() + 9 * (block_count(nodes) * e + block_index(std::max(a, b), std::min(a, b)));
                const Eigen::Map<const Matrix3d> own(block);
                const Matrix3d S = a >= b ? Matrix3d(own) : Matrix3d(own.transpose());
                sum += v.segment<3>(3 * box.elements->elements()(a, e))
                           .dot(S * w.segment<3>(3 * box.elements->elements()(b, e)));
            }
    const double Dw = v.dot(loads.force_change(u, factors, w, none)),
                 Dv = w.dot(loads.force_change(u, factors, v, none));
    EXPECT_NEAR(sum, -0.5 * (Dw + Dv), 1e-11 * (std::abs(Dw) + std::abs(Dv)));
    EXPECT_GT(std::abs(Dw - Dv), 1e-3 * std::abs(Dw)) << "the rim of the pressed part is free here";
}

/// On a closed surface a pressure has an energy, p times the volume.
TEST_P(LoadsOfDegree, PressureAllAroundDoesTheWorkOfTheVolumeThatIsLost) {
    const LoadedBox box({2, 2, 2}, {1, 1, 1}, GetParam());
    const NonlinearLoads loads =
        box.loads({unit_pressure(box.surface, box.triangles([](const auto&) { return true; }))});
    const Vector3d s(1.3, 0.8, 1.1);
    const VectorXd factor = VectorXd::Constant(1, 0.7), u = test::affine(*box.elements, s.asDiagonal()),
                   zero = VectorXd::Zero(u.size());
    EXPECT_NEAR(loads.work(zero, u, factor), -0.7 * (s.prod() - 1.0), 1e-13);
    const VectorXd v = random_vector(u.size(), 1, 1), w = random_vector(u.size(), 1, 2);
    const double Dw = v.dot(loads.force_change(u, factor, w, loads.none()));
    EXPECT_NEAR(Dw, w.dot(loads.force_change(u, factor, v, loads.none())), 1e-12 * std::abs(Dw)) << "symmetric";
    const Eigen::MatrixXd sum = loads.resultants(u, factor);
    EXPECT_LT(sum.norm(), 1e-13);
}

TEST_P(LoadsOfDegree, ADeadTractionStretchesABarAsTheScalarEquationsSay) {
    const Material material{1.0, 0.3};
    const LoadedBox box({3, 2, 2}, {2, 1, 1}, GetParam());
    const auto left = test::nodes_where(*box.elements, [](const auto& x) { return x[0] == 0.0; });
    const auto right = box.triangles([](const Vector3d& x) { return x[0] == 2.0; });
    for (const double traction : {-0.03, 0.3, 1.0}) {
        const Matrix3d F = uniaxial(material, [=](double, double) { return traction; }).asDiagonal();
        const VectorXd factor = VectorXd::Constant(1, traction);
        const NodeSolution solution =
            box.solve(left, {unit_traction(right, Vector3d::UnitX())}, box.values(left, F, factor), material);
        EXPECT_LT(difference(solution.displacements.col(0), test::affine(*box.elements, F)), 1e-7) << traction;
        EXPECT_NEAR(solution.state->facts().work_of_loads, traction * 2.0 * (F(0, 0) - 1.0), 1e-7);
        const Eigen::Matrix3Xd reactions = solution.loads.col(0).reshaped(3, std::ssize(left));
        EXPECT_NEAR(reactions.row(0).sum(), -traction, 1e-8 * std::abs(traction));
    }
}

/// Cauchy's stress is minus the pressure: it stays on the area that is there. The rim is free.
TEST_P(LoadsOfDegree, APressureFollowsTheAreaOfTheEndOfABar) {
    const Material material{1.0, 0.3};
    const LoadedBox box({3, 2, 2}, {2, 1, 1}, GetParam());
    const auto left = test::nodes_where(*box.elements, [](const auto& x) { return x[0] == 0.0; });
    const auto right = box.triangles([](const Vector3d& x) { return x[0] == 2.0; });
    for (const double pressure : {-0.5, -0.2, 0.02}) {
        const Matrix3d F = uniaxial(material, [=](double, double b) { return -pressure * b * b; }).asDiagonal();
        const NodeSolution solution = box.solve(left, {unit_pressure(box.surface, right)},
                                                box.values(left, F, VectorXd::Constant(1, pressure)), material);
        EXPECT_LT(difference(solution.displacements.col(0), test::affine(*box.elements, F)), 1e-7) << pressure;
        EXPECT_NEAR(solution.resultants(0, 0), -pressure * F(1, 1) * F(1, 1), 1e-7);
    }
}

/// Nothing is fixed: the answer is known but for a rigid motion.
TEST_P(LoadsOfDegree, PressureAllAroundAndOppositePullsDeformAFreeBodyHomogeneously) {
    const Material material{1.0, 0.35};
    const LoadedBox box({2, 2, 2}, {1, 1, 1}, GetParam());
    const double mu = material.shear_modulus(), lambda = material.lame_lambda();
    const double s =
        root([&](double x) { return mu * (x - 1 / x) + 3 * lambda * std::log(x) / x + 0.6 * x * x; }, 0.2, 1);
    const NodeSolution pressed =
        box.solve({}, {unit_pressure(box.surface, box.triangles([](const auto&) { return true; }))},
                  VectorXd::Constant(1, 0.6), material);
    const Vector3d stretches = uniaxial(material, [](double, double) { return 0.8; });
    const auto end = [&](double x) { return box.triangles([=](const Vector3d& at) { return at[0] == x; }); };
    const NodeSolution pulled =
        box.solve({}, {unit_traction(end(0.0), -Vector3d::UnitX()), unit_traction(end(1.0), Vector3d::UnitX())},
                  VectorXd::Constant(2, 0.8), material);
    EXPECT_TRUE(pressed.state->facts().stable && pulled.state->facts().stable)
        << "on the way the tangent says that turning changes the energy, and in equilibrium it does not";
    for (int e = 0; e < box.elements->n_elements(); ++e) {
        const Matrix3d F = Matrix3d::Identity() + box.elements->gradient(pressed.displacements.col(0), e, 0),
                       G = Matrix3d::Identity() + box.elements->gradient(pulled.displacements.col(0), e, 0);
        EXPECT_LT((F.transpose() * F - s * s * Matrix3d::Identity()).norm(), 1e-6);
        EXPECT_LT((G.transpose() * G - Matrix3d(stretches.array().square().matrix().asDiagonal())).norm(), 1e-6);
    }
}

/// About the forces' direction, or about any axis, nothing resists: of all turns that of rest is shown.
TEST_P(LoadsOfDegree, AFreeBodyIsNotTurnedForNothing) {
    const LoadedBox box({4, 2, 1}, {2, 1, 0.4}, GetParam());
    const auto end = [&](double x) { return box.triangles([=](const Vector3d& at) { return at[0] == x; }); };
    const std::vector<int> all = box.triangles([](const auto&) { return true; });
    const std::vector<UnitLoad> pulled = {unit_traction(end(0.0), -Vector3d::UnitX()),
                                          unit_traction(end(2.0), Vector3d::UnitX())};
    std::vector<UnitLoad> pulled_and_pressed = pulled;
    pulled_and_pressed.push_back(unit_pressure(box.surface, all));
    for (const auto& [loads, factor] :
         {std::pair(pulled, 0.05), std::pair(pulled, 0.6), std::pair(pulled_and_pressed, 0.3),
          std::pair(std::vector{unit_pressure(box.surface, all)}, 0.5)}) {
        const NodeSolution solution = box.solve({}, loads, VectorXd::Constant(std::ssize(loads), factor), {1.0, 0.3});
        const Positions& rest = box.elements->positions();
        const Positions u = solution.displacements.col(0).reshaped(3, rest.cols());
        EXPECT_LT(u.rowwise().mean().norm(), 1e-6 * u.norm());
        const Vector3d centre = rest.rowwise().mean();
        Vector3d turn = Vector3d::Zero();
        double size = 0.0;
        for (Eigen::Index i = 0; i < rest.cols(); ++i) {
            turn += (rest.col(i) - centre).cross(u.col(i));
            size += (rest.col(i) - centre).squaredNorm();
        }
        EXPECT_LT(std::abs(turn[0]), 1e-8 * size) << factor;
        if (loads.size() == 1) {
            EXPECT_LT(turn.norm(), 1e-8 * size);
        }
        EXPECT_LT(solution.state->facts().energy, 1.0);
    }
}

/// Poisson's ratio 0: no lateral strain, and mu (s - 1/s) = weight below the point is all there is.
TEST(NonlinearLoads, ABarHangsUnderItsWeightAsTheClosedSolutionSays) {
    const Material material{1.0, 0.0};
    const double mu = material.shear_modulus(), weight = 1.0, length = 2.0;
    const auto stretch = [&](double z) {
        const double q = weight * z / mu;
        return 0.5 * (q + std::sqrt(q * q + 4.0));
    };
    // By Simpson's rule, z from the lower end: int (s - 1) dz is how far that end sinks, and weight int z (s - 1) dz
    // the work of the weight.
    double tip = 0.0, work = 0.0;
    constexpr int kParts = 200;
    for (int i = 0; i < kParts; ++i)
        for (const auto& [place, part] : {std::pair{0.0, 1.0}, {0.5, 4.0}, {1.0, 1.0}}) {
            const double h = length / kParts, z = (i + place) * h;
            tip += part * h / 6.0 * (stretch(z) - 1.0);
            work += part * h / 6.0 * weight * z * (stretch(z) - 1.0);
        }
    std::vector<double> errors;
    for (const int cells : {2, 4, 8}) {
        const LoadedBox box({cells, 1, 1}, {length, 1, 1}, ElementDegree::quadratic, 0.0);
        const auto top = test::nodes_where(*box.elements, [](const auto& x) { return x[0] == 0.0; });
        const auto low = test::nodes_where(*box.elements, [=](const auto& x) { return x[0] == length; });
        const NodeSolution solution = box.solve(
            top, {body_force_along(0)}, box.values(top, Matrix3d::Identity(), VectorXd::Constant(1, weight)), material);
        for (const int node : low) EXPECT_NEAR(solution.displacements(3 * node, 0), tip, 5e-3 * tip);
        errors.push_back(std::abs(solution.state->facts().work_of_loads - work) / work);
        const Eigen::Matrix3Xd reactions = solution.loads.col(0).reshaped(3, std::ssize(top));
        EXPECT_NEAR(reactions.row(0).sum(), -weight * length, 1e-8);
    }
    EXPECT_GT(tip, 0.9) << "a large deformation";
    EXPECT_LT(errors[2], 1e-5);
    EXPECT_GT(std::log2(errors[1] / errors[2]), 2.7) << errors[0] << ", " << errors[1] << ", " << errors[2];
}

TEST_P(LoadsOfDegree, SmallLoadsGiveTheLinearAnswerToSecondOrder) {
    const Material material{1.0, 0.3};
    const LoadedBox box({4, 2, 2}, {3, 1, 1}, GetParam());
    const auto left = test::nodes_where(*box.elements, [](const auto& x) { return x[0] == 0.0; });
    std::vector<UnitLoad> units = three_loads(box);
    Control control;
    const NonlinearSolver solver(box.elements, material, {left, static_cast<int>(left.size()), true}, control,
                                 box.loads(units));
    const VectorXd shape = box.values(left, Matrix3d::Identity(), Vector3d(0.0006, 0.0004, 0.002));
    const NodeSolution linear =
        solver.solve_task({.prescribed = VectorXd::Zero(shape.size()), .changes = shape}, 1e-10, control);
    std::vector<double> off;
    for (const double size : {1.0, 0.5, 0.25})
        off.push_back((solver.solve_task({.prescribed = size * shape}, 1e-10, control).displacements.col(0) -
                       size * linear.displacements.col(1))
                          .norm());
    EXPECT_LT(off[0], 0.2 * linear.displacements.col(1).norm());
    EXPECT_NEAR(off[1] / off[2], 4.0, 0.2);
}

/// Large loads from rest in one jump, and in steps from one equilibrium to the next; everything balances.
TEST_P(LoadsOfDegree, ReactionsAndLoadsBalanceAtPresentPositions) {
    const Material material{1.0, 0.3};
    const LoadedBox box({6, 2, 2}, {4, 1, 1}, GetParam());
    const auto left = test::nodes_where(*box.elements, [](const auto& x) { return x[0] == 0.0; });
    const std::vector<UnitLoad> units = three_loads(box);
    Control control;
    const NonlinearSolver solver(box.elements, material, {left, static_cast<int>(left.size()), true}, control,
                                 box.loads(units));
    const VectorXd whole = box.values(left, Matrix3d::Identity(), Vector3d(0.004, 0.008, 0.008));
    const NodeSolution jump = solver.solve(whole, true);
    NodeSolution step = solver.solve(0.25 * whole, true);
    for (const double part : {0.5, 0.75, 1.0})
        step = solver.solve_task({.prescribed = part * whole, .start = step.state.get(), .want_loads = true}, 1e-8,
                                 control);
    EXPECT_LT(difference(step.displacements, jump.displacements), 1e-6);
    EXPECT_GT(jump.displacements.cwiseAbs().maxCoeff(), 1.0) << "a large deformation";
    Vector3d force = jump.resultants.topRows<3>().rowwise().sum(),
             moment = jump.resultants.bottomRows<3>().rowwise().sum();
    const double size = jump.resultants.topRows<3>().norm();
    for (std::size_t i = 0; i < left.size(); ++i) {
        const Vector3d f = jump.loads.col(0).segment<3>(3 * static_cast<Eigen::Index>(i));
        force += f;
        moment += box.elements->positions().col(left[i]).cross(f);
    }
    EXPECT_LT(force.norm(), 1e-8 * size);
    EXPECT_LT(moment.norm(), 4e-8 * size) << "arms of up to 4";
}

TEST_P(LoadsOfDegree, ColumnsOfLoadsPredictTheNextEquilibriumToSecondOrder) {
    const Material material{1.0, 0.3};
    const LoadedBox box({4, 2, 2}, {3, 1, 1}, GetParam());
    const auto left = test::nodes_where(*box.elements, [](const auto& x) { return x[0] == 0.0; });
    Control control;
    const NonlinearSolver solver(box.elements, material, {left, static_cast<int>(left.size()), true}, control,
                                 box.loads(three_loads(box)));
    const VectorXd at = box.values(left, Matrix3d::Identity(), Vector3d(0.005, 0.005, 0.02));
    VectorXd change = VectorXd::Zero(at.size());
    change.tail<3>() << 0.0005, -0.00025, 0.0025;
    const NodeSolution start = solver.solve_task({.prescribed = at, .changes = change}, 1e-9, control);
    std::vector<double> off;
    for (const double part : {1.0, 0.5})
        off.push_back((solver.solve_task({.prescribed = at + part * change, .start = start.state.get()}, 1e-9, control)
                           .displacements.col(0) -
                       start.displacements.col(0) - part * start.displacements.col(1))
                          .norm());
    EXPECT_LT(off[0], 0.1 * start.displacements.col(1).norm());
    EXPECT_NEAR(off[0] / off[1], 4.0, 0.3);
}

}  // namespace
}  // namespace elastolab
