// Organic bodies under weight and pressure, against quadratic finite elements graded towards the rim of the fixed part
// and extrapolated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "mesh/measures.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"
#include "study/error/organic_body.hpp"
#include "study/error/organic_truth.hpp"

namespace elastolab::test {
namespace {

/// Held at its bottom, bent by its weight along x and z, and pressed on one side.
struct LoadedBody {
    OrganicBody body;
    ConstrainedSet set;
    Eigen::VectorXd factors = Eigen::Vector3d(0.02, -0.05, 0.05);

    explicit LoadedBody(OrganicBody organic) : body(std::move(organic)), set{body.fixed, {}} {
        std::vector<char> is_fixed(static_cast<std::size_t>(body.surface.n_vertices()), 0);
        for (const int v : body.fixed) is_fixed[static_cast<std::size_t>(v)] = 1;
        std::vector<int> side;
        for (int t = 0; t < body.surface.n_triangles(); ++t) {
            const auto corners = body.surface.triangles.col(t);
            const bool is_free = std::none_of(corners.begin(), corners.end(),
                                              [&](int v) { return is_fixed[static_cast<std::size_t>(v)]; });
            if (is_free && centroid(body.surface, t).x() < 0.0) side.push_back(t);
        }
        set.loads = {body_force_along(0), body_force_along(2), unit_pressure(body.surface, side)};
    }

    OrganicTruth truth(double nu) const {
        return compute_truth(body.surface, body.fixed, Positions::Zero(3, std::ssize(body.fixed)), {1.0, nu}, {1},
                             {set.loads, factors});
    }
    Deformer::Answer answer(double nu, MethodKind kind, Deformer::Wanted wanted) const {
        Control control;
        Deformer deformer(precomputed(make_body(body.surface, {1.0, nu}), make_method(kind)));
        deformer.constrain(set, control);
        return deformer.answer(factors, wanted, control);
    }
    double rms_error(const Eigen::VectorXd& u, const Positions& truth) const {
        return (u - truth.reshaped()).norm() / truth.norm();  // both vanish where the body is fixed
    }
};

/// The error is that of the stiffness: flat triangles of these sizes bend too little, and the whole answer by the same
/// part (2.25 % on the rabbit). most: relative rms error.
void expect_galerkin_within(double most, const LoadedBody& loaded, double nu) {
    const OrganicTruth truth = loaded.truth(nu);
    const Deformer::Answer galerkin = loaded.answer(nu, kGalerkinBem, {.check = true});
    const double error = loaded.rms_error(galerkin.displacements, truth.displacements);
    print_measured(loaded.body.name + " under weight and pressure, Galerkin BEM, relative rms error", error);
    print_measured(loaded.body.name + ", truth, estimated relative error", truth.relative_error);
    EXPECT_LT(error, most);
    EXPECT_LT(error, loaded.rms_error(loaded.answer(nu, kFem, {}).displacements, truth.displacements));
    ASSERT_TRUE(galerkin.check.has_value());
    const Eigen::Matrix3Xd off = galerkin.displacements.reshaped(3, truth.displacements.cols()) - truth.displacements;
    const double worst = off.colwise().norm().maxCoeff() / truth.displacements.colwise().norm().maxCoeff();
    print_measured(loaded.body.name + ", the estimate over the largest error", galerkin.check->relative_error / worst);
    EXPECT_GT(galerkin.check->relative_error, worst / 5.0);
    EXPECT_LT(galerkin.check->relative_error, worst * 5.0);
    const Eigen::Vector3d support = galerkin.reactions.forces.rowwise().sum(),
                          true_support = truth.reactions.forces.rowwise().sum();
    EXPECT_LT((support - true_support).norm(), 1e-6 * true_support.norm()) << "both balance the same loads";
}

TEST(OrganicLoads, MoveARabbitOfSixHundredVerticesWithinThreePercentByGalerkin) {
    expect_galerkin_within(0.03, LoadedBody(make_rabbit(600)), 0.3);
}

TEST(OrganicLoads, MoveANearlyIncompressiblePotatoOfSixHundredVerticesWithinThreePercentByGalerkin) {
    expect_galerkin_within(0.03, LoadedBody(make_potato(600)), 0.45);
}

/// No finite elements here can take nu = 1/2: the answers go there smoothly, and forces balance.
TEST(OrganicLoads, AreAnsweredAtHalfByBoundaryElementsAsJustBelow) {
    const LoadedBody loaded(make_potato(300));
    for (const MethodKind kind : {kLinearBem, kGalerkinBem}) {
        const Deformer::Answer at_half = loaded.answer(0.5, kind, {}), below = loaded.answer(0.4999, kind, {});
        const Eigen::VectorXd further = loaded.answer(0.4998, kind, {}).displacements;
        const double step = (at_half.displacements - below.displacements).norm();
        EXPECT_LT(step, 1e-2 * at_half.displacements.norm()) << name(kind);
        EXPECT_LT((at_half.displacements - 2.0 * below.displacements + further).norm(), 0.1 * step) << name(kind);
    }
}

}  // namespace
}  // namespace elastolab::test
