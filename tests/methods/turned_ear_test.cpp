// Nonlinear FEM against other code on an organic body: the tip of the rabbit's ear turned by 60 degrees about the ear's
// root, by FEniCSx (scripts/reference_turns.py).
#include <gtest/gtest.h>

#include "fem/nonlinear/bodies.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/input/import.hpp"
#include "methods/problem.hpp"
#include "methods/reference.hpp"

namespace elastolab::test {
namespace {

/// With tetrahedra that grow away from the surface: a sixth of the time, and as near to the reference.
Method roomy(MethodKind kind) { return {.kind = kind, .update = Update::direct, .growth = 1.0}; }

class TurnedEar : public testing::Test {
protected:
    /// The difference to the reference at the vertices of the file, rms, over that of the reference.
    double off_reference(const Method& method) const {
        const Eigen::VectorXd u = displaced(precomputed(make_body(mesh_), method), set_, values());
        double apart = 0.0, whole = 0.0;
        for (std::size_t v = 0; v < reference_.positions.size(); ++v) {
            apart += (u.segment<3>(3 * static_cast<Eigen::Index>(v)) - reference_.displacements[v]).squaredNorm();
            whole += reference_.displacements[v].squaredNorm();
        }
        return std::sqrt(apart / whole);
    }

    const SurfaceMesh mesh_ = load_surface(ELASTOLAB_ASSETS "/meshes/rabbit.obj");
    const ConstrainedSet set_{
        .fixed = vertices_where(mesh_, [](const auto& p) { return p[2] <= 0.12; }),
        .handles = vertices_where(mesh_, [](const auto& p) { return p[0] >= 0.0 && p[2] >= 2.05; })};
    const Reference reference_ = read_reference("turned_ear.csv");

private:
    Eigen::VectorXd values() const {
        const Eigen::Vector3d root(0.2, -0.26, 1.7);
        const Eigen::Matrix3Xd arms = mesh_.vertices(Eigen::all, set_.handles).colwise() - root;
        const Eigen::Matrix3Xd values = rotation(Eigen::Vector3d::UnitX(), 60) * arms - arms;
        return values.reshaped();
    }
};

TEST_F(TurnedEar, HasTheVerticesOfTheReference) {
    ASSERT_EQ(mesh_.n_vertices(), std::ssize(reference_.positions));
    for (int v = 0; v < mesh_.n_vertices(); ++v)
        EXPECT_LT((mesh_.vertices.col(v) - reference_.positions[static_cast<std::size_t>(v)]).norm(), 1e-8) << v;
}

TEST_F(TurnedEar, OfTenNodesIsThatOfOtherCode) {
    const double rms = off_reference(roomy(kNonlinearFem));
    print_measured("ear turned by 60 degrees, ten nodes, relative rms difference to FEniCSx", rms);
    EXPECT_LT(rms, 3.5e-3);  // the reference itself is known to some 2e-3
}

TEST_F(TurnedEar, OfFourNodesIsTwoPerCentOff) {
    Method method = make_method(kNonlinearFem);
    method.elements = ElementDegree::linear;
    const double rms = off_reference(method);
    print_measured("ear turned by 60 degrees, four nodes, relative rms difference to FEniCSx", rms);
    EXPECT_NEAR(rms, 0.02, 0.005);
}

TEST_F(TurnedEar, ByLinearTheoryIsTensOfPerCentOff) {
    const double rms = off_reference(roomy(kQuadraticFem));
    print_measured("ear turned by 60 degrees, linear theory, relative rms difference to FEniCSx", rms);
    EXPECT_GT(rms, 0.5);
}

}  // namespace
}  // namespace elastolab::test
