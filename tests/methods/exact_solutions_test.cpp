#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "elasticity/exact_fields.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/method.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

Eigen::VectorXd solve(const SurfaceMesh& mesh, const Material& material, const Method& method,
                      const std::vector<int>& constrained, const Eigen::VectorXd& exact) {
    return displaced(precomputed(make_body(mesh, material), method), {{}, constrained}, at(exact, constrained));
}

double relative_error(const Eigen::VectorXd& u, const Eigen::VectorXd& exact) {
    return (u - exact).norm() / exact.norm();
}

/// A box whose surface vertices inside the faces are moved at random in their faces.
SurfaceMesh irregular_box(int cells) {
    SurfaceMesh mesh = make_box(cells);
    std::mt19937 random(31);
    std::uniform_real_distribution<double> shift(-0.25 / cells, 0.25 / cells);
    for (auto x : mesh.vertices.colwise())
        for (int axis = 0; axis < 3; ++axis)
            if (x[axis] > kEdge && x[axis] < 1.0 - kEdge) x[axis] += shift(random);
    return mesh;
}

std::vector<Method> linear_methods() {
    std::vector<Method> methods = method_variants();
    std::erase_if(methods, [](const Method& method) { return method.kind == kConstantBem; });
    return methods;
}

/// Where all others are exact, Galerkin BEM is so to the tolerance of its integrals.
double exactness(const Method& method, double of_the_others) {
    return std::max(of_the_others, 3.0 * method.kind->integral_tolerance * (method.kind == kGalerkinBem ? 1.0 : 0.0));
}

TEST(ExactSolutions, ReproduceARigidRotationToRounding) {
    const std::vector<std::pair<std::string, SurfaceMesh>> bodies = {
        {"cube", make_box(4)}, {"sphere", make_sphere(4)}, {"rabbit", make_rabbit(300).surface}};
    for (const auto& [name, mesh] : bodies) {
        const Eigen::VectorXd exact = rigid_motion(mesh.vertices, {0.1, 0.2, -0.3}, {0.3, -0.5, 0.8});
        std::vector<int> constrained;
        for (int v = 0; v < mesh.n_vertices(); v += 9) constrained.push_back(v);
        for (const Method& method : linear_methods())
            EXPECT_LT(relative_error(solve(mesh, {1.0, 0.3}, method, constrained, exact), exact), 1e-12)
                << name << " " << describe(method);
    }
}

TEST(ExactSolutions, PassThePatchTestOnRegularAndIrregularBoxes) {
    for (const SurfaceMesh& mesh : {make_box(4), irregular_box(5)})
        for (const double nu : {-0.3, 0.0, 0.3, 0.49}) {
            const Material material{2.0, nu};
            const Eigen::VectorXd exact = exact_displacements(mesh, UniaxialStretch{material});
            const auto ends = vertices_where(mesh, [](const auto& x) { return x[0] < kEdge || x[0] > 1.0 - kEdge; });
            for (const Method& method : linear_methods()) {
                if (method.kind == kLinearBem && method.tractions == Tractions::continuous) continue;
                EXPECT_LT(relative_error(solve(mesh, material, method, ends, exact), exact), exactness(method, 1e-12))
                    << describe(method) << ", nu " << nu;
            }
        }
}

TEST(ExactSolutions, ShowTheLeakOfContinuousTractionsInThePatchTest) {
    const SurfaceMesh mesh = make_box(4);
    const Eigen::VectorXd exact = exact_displacements(mesh, UniaxialStretch{{1.0, 0.3}});
    const auto ends = vertices_where(mesh, [](const auto& x) { return x[0] < kEdge || x[0] > 1.0 - kEdge; });
    const Method method = make_method(kLinearBem, Tractions::continuous);
    const Eigen::VectorXd u = solve(mesh, {1.0, 0.3}, method, ends, exact);
    EXPECT_GT((u - exact).cwiseAbs().maxCoeff(), 0.010);  // 1 to 2 % at 4 cells, depending on the diagonals
    EXPECT_LT((u - exact).cwiseAbs().maxCoeff(), 0.025);
}

/// One exact problem on meshes of two sizes; least squares is not needed for two points.
struct Study {
    std::vector<double> errors;
    double order(double refinement) const { return std::log(errors[0] / errors[1]) / std::log(refinement); }
    void print(const std::string& what, const Method& method, double refinement) const {
        print_measured(what + ", " + describe(method) + ", relative L2 error", errors.back());
        print_measured(what + ", " + describe(method) + ", observed order", order(refinement));
    }
};

std::ostream& operator<<(std::ostream& out, const Study& study) {
    for (const double error : study.errors) out << error << " ";
    return out;
}

Study bend(const Method& method, double nu, const std::vector<int>& sizes) {
    Study study;
    const Material material{1.0, nu};
    for (const int cells : sizes) {
        const SurfaceMesh mesh = make_box(cells, {2.0, 1.0, 1.0});
        const Eigen::VectorXd exact = exact_displacements(mesh, PureBending{material});
        const auto ends = vertices_where(mesh, [](const auto& x) { return x[0] < kEdge || x[0] > 2.0 - kEdge; });
        study.errors.push_back(relative_error(solve(mesh, material, method, ends, exact), exact));
    }
    return study;
}

Study twist(const Method& method, double nu, const std::vector<int>& sizes) {
    Study study;
    const Material material{1.0, nu};
    for (const int cells : sizes) {
        const SurfaceMesh mesh = make_cylinder(cells);
        const Eigen::VectorXd exact = exact_displacements(mesh, Torsion{material});
        const double end = 1.0 - kEdge;
        const auto ends = vertices_where(mesh, [&](const auto& x) { return std::fabs(x[2]) > end; });
        study.errors.push_back(relative_error(solve(mesh, material, method, ends, exact), exact));
    }
    return study;
}

Study inflate(const Method& method, double nu, const std::vector<int>& sizes) {
    Study study;
    HollowSphereField field;
    field.material = {1.0, nu};
    for (const int cells : sizes) {
        const SurfaceMesh mesh = make_hollow_sphere(cells);
        const Eigen::VectorXd exact = exact_displacements(mesh, field);
        const auto inner = vertices_where(mesh, [](const auto& x) { return x.norm() < 0.75; });
        study.errors.push_back(relative_error(solve(mesh, field.material, method, inner, exact), exact));
    }
    return study;
}

/// One set each: the system of that set alone is solved.
Method for_one_set(MethodKind kind, Tractions tractions = Tractions::discontinuous) {
    return make_method(kind, tractions, Mode::on_demand, Update::direct);
}

const Method kRestricted = for_one_set(kLinearBem, Tractions::restricted);
const Method kDiscontinuous = for_one_set(kLinearBem);
const Method kConstant = for_one_set(kConstantBem);
const Method kLinearTets = for_one_set(kFem);

TEST(PureBending, ConvergesWithTheOrderOfEachMethod) {
    for (const auto& [method, order] : {std::pair{kLinearTets, 1.8}, {kConstant, 0.9}}) {
        const Study study = bend(method, 0.3, {3, 6});
        study.print("bending", method, 2.0);
        EXPECT_GT(study.order(2.0), order) << describe(method) << ": " << study;
    }
    // The order of linear elements rises slowly to 2 (1.6 from 2 to 4 cells, 1.8 from 8 to 12).
    for (const auto& [method, order] : {std::pair{kRestricted, 1.8}, {kDiscontinuous, 1.65}}) {
        const Study study = bend(method, 0.3, {8, 12});
        study.print("bending", method, 1.5);
        EXPECT_GT(study.order(1.5), order) << describe(method) << ": " << study;
    }
}

TEST(PureBending, DoesNotLockByLinearElementsTowardsIncompressibility) {
    const double at_03 = bend(kRestricted, 0.3, {5}).errors[0];
    for (const double nu : {0.49, 0.5}) EXPECT_LT(bend(kRestricted, nu, {5}).errors[0], 2.0 * at_03) << "nu " << nu;
    EXPECT_GT(bend(kLinearTets, 0.4999, {5}).errors[0],
              3.0 * bend(kLinearTets, 0.3, {5}).errors[0]);  // linear tetrahedra do lock
}

TEST(Torsion, ConvergesWithTheOrderOfEachMethod) {
    for (const auto& [method, order] :
         {std::pair{kRestricted, 1.8}, {kDiscontinuous, 1.8}, {kLinearTets, 1.8}, {kConstant, 0.9}}) {
        const Study study = twist(method, 0.3, {3, 6});
        study.print("torsion", method, 2.0);
        EXPECT_GT(study.order(2.0), order) << describe(method) << ": " << study;
    }
}

TEST(HollowSphere, ConvergesWithTheOrderOfEachMethod) {
    for (const auto& [method, order] :
         {std::pair{kRestricted, 1.8}, {kDiscontinuous, 1.8}, {kLinearTets, 1.8}, {kConstant, 0.9}}) {
        const Study study = inflate(method, 0.3, {4, 8});
        study.print("hollow sphere", method, 2.0);
        EXPECT_GT(study.order(2.0), order) << describe(method) << ": " << study;
    }
}

/// All displacements prescribed: only the tractions are unknown, and their resultant over the constrained surface is
/// known to be zero for a source outside the body.
TEST(PointForceOutside, LeavesTheBodyInEquilibrium) {
    const SurfaceMesh mesh = make_box(4);
    const Material material{1.0, 0.3};
    const PointForceField field{material, {1.8, 0.4, 0.6}, {1.0, 0.5, -0.2}};
    const Eigen::VectorXd exact = exact_displacements(mesh, field);
    std::vector<int> all(static_cast<std::size_t>(mesh.n_vertices()));
    for (int v = 0; v < mesh.n_vertices(); ++v) all[static_cast<std::size_t>(v)] = v;
    for (const Method& method : method_variants()) {
        Control control;
        Deformer deformer(precomputed(make_body(mesh, material), method));
        deformer.constrain({{}, all}, control);
        EXPECT_LT(relative_error(deformer.displace(exact), exact), method.kind == kConstantBem ? 0.2 : 1e-12);
        const Reactions reactions = deformer.reactions(exact);
        const double size = reactions.forces.colwise().norm().sum();
        EXPECT_LT(reactions.forces.rowwise().sum().norm(), 2e-2 * size) << describe(method);
    }
}

TEST(Reactions, OfAStretchedBoxAreStressTimesArea) {
    const SurfaceMesh mesh = make_box(4);
    const Material material{2.5, 0.3};
    const Eigen::VectorXd exact = exact_displacements(mesh, UniaxialStretch{material});
    const auto left = vertices_where(mesh, [](const auto& x) { return x[0] < kEdge; });
    auto ends = vertices_where(mesh, [](const auto& x) { return x[0] > 1.0 - kEdge; });
    const std::size_t n_right = ends.size();
    ends.insert(ends.end(), left.begin(), left.end());
    for (const Method& method : linear_methods()) {
        if (method.kind == kLinearBem && method.tractions == Tractions::continuous) continue;
        Control control;
        Deformer deformer(precomputed(make_body(mesh, material), method));
        deformer.constrain({{}, ends}, control);
        const Reactions reactions = deformer.reactions(at(exact, ends));
        const Eigen::Vector3d pull = reactions.forces.leftCols(static_cast<Eigen::Index>(n_right)).rowwise().sum();
        EXPECT_LT((pull - Eigen::Vector3d(2.5, 0.0, 0.0)).norm(), exactness(method, 1e-10)) << describe(method);
        EXPECT_LT(reactions.forces.rowwise().sum().norm(), 1e-10) << describe(method);
        EXPECT_LT(reactions.moments.rowwise().sum().norm(), 1e-10) << describe(method);
    }
}

TEST(Residual, IsRoundingForASolution) {
    const SurfaceMesh mesh = make_box(4);
    const auto fixed = vertices_where(mesh, [](const auto& x) { return x[0] < kEdge; });
    const auto pull = vertices_where(mesh, [](const auto& x) { return x[0] > 1.0 - kEdge; });
    const Eigen::VectorXd values = Eigen::Vector3d(0.1, 0.05, 0.0).replicate(std::ssize(pull), 1);
    for (const Method& method : method_variants()) {
        Control control;
        Deformer deformer(precomputed(make_body(mesh), method));
        deformer.constrain({fixed, pull}, control);
        // That of Galerkin BEM integrates some rows afresh, which shows what the integrals' tolerance of 1e-8 leaves.
        EXPECT_LT(deformer.residual(values, control), method.kind == kGalerkinBem ? 1e-10 : 1e-12) << describe(method);
    }
}

}  // namespace
}  // namespace elastolab::test
