// Organic bodies under weight and pressure, against quadratic finite elements graded towards the rim of the fixed part
// and extrapolated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "mesh/measures.hpp"
#include "methods/known_truth.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"
#include "study/error/organic_body.hpp"

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

    KnownTruth truth(double nu) const {
        return known_truth("loaded_" + body.name + ".csv", body.surface, [&] {
            return compute_truth(body.surface, body.fixed, Positions::Zero(3, std::ssize(body.fixed)), {1.0, nu}, {1},
                                 {set.loads, factors});
        });
    }
    Deformer::Answer answer(double nu, MethodKind kind, Deformer::Wanted wanted, int rims = 0) const {
        Control control;
        const Method method{.kind = kind, .update = Update::direct, .rims = rims};
        Deformer deformer(precomputed(make_body(body.surface, {1.0, nu}), method));
        deformer.constrain(set, control);
        return deformer.answer(factors, wanted, control);
    }
    /// The estimated error over that of the worst vertex.
    static double estimate_over_error(const Deformer::Answer& answer, const Positions& truth) {
        const Eigen::Matrix3Xd off = answer.displacements.reshaped(3, truth.cols()) - truth;
        return answer.check.value().relative_error * truth.colwise().norm().maxCoeff() /
               off.colwise().norm().maxCoeff();
    }
    double rms_error(const Eigen::VectorXd& u, const Positions& truth) const {
        return (u - truth.reshaped()).norm() / truth.norm();  // both vanish where the body is fixed
    }
};

/// The body is too stiff at the rim of its fixed part, and the whole answer is too small by the same share: 2.25 % on
/// the rabbit with triangles as given, a fifth of that with a row of thin ones along the rim.
void expect_galerkin_close(const LoadedBody& loaded, double nu, const std::vector<int>& all_rims) {
    const KnownTruth truth = loaded.truth(nu);
    const Deformer::Answer galerkin = loaded.answer(nu, kGalerkinBem, {.check = true});
    const double error = loaded.rms_error(galerkin.displacements, truth.displacements);
    print_measured(loaded.body.name + " under weight and pressure, Galerkin BEM, relative rms error", error);
    print_measured(loaded.body.name + ", truth, estimated relative error", truth.relative_error);
    EXPECT_LT(error, 0.03);
    EXPECT_LT(error, loaded.rms_error(loaded.answer(nu, kFem, {}).displacements, truth.displacements));
    const double estimate = LoadedBody::estimate_over_error(galerkin, truth.displacements);
    print_measured(loaded.body.name + ", the estimate over the largest error", estimate);
    EXPECT_GT(estimate, 1.0 / 5.0);
    EXPECT_LT(estimate, 5.0);
    for (const int rims : all_rims) {
        const Deformer::Answer finer = loaded.answer(nu, kGalerkinBem, {.residual = true, .check = true}, rims);
        const double left = loaded.rms_error(finer.displacements, truth.displacements);
        const double its_estimate = LoadedBody::estimate_over_error(finer, truth.displacements);
        print_measured(std::to_string(rims) + " rows along the rim, relative rms error", left);
        print_measured(std::to_string(rims) + " rows along the rim, the estimate over the largest error", its_estimate);
        EXPECT_LT(left, rims == 1 ? 0.007 : 0.005);
        EXPECT_GT(its_estimate, 1.0 / 2.0);
        EXPECT_LT(its_estimate, 2.5);
        EXPECT_LT(finer.residual.value(), 1e-7);
    }
    const Eigen::Vector3d support = galerkin.reactions.forces.rowwise().sum();
    EXPECT_LT((support - truth.support).norm(), 1e-6 * truth.support.norm()) << "both balance the same loads";
}

TEST(OrganicLoads, MoveARabbitOfSixHundredVerticesWithinOnePercentByGalerkinWithFinerRims) {
    expect_galerkin_close(LoadedBody(make_rabbit(600)), 0.3, {1});
}

TEST(OrganicLoads, MoveANearlyIncompressiblePotatoOfSixHundredVerticesWithinOnePercentByGalerkinWithFinerRims) {
    expect_galerkin_close(LoadedBody(make_potato(600)), 0.45, {2});
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
