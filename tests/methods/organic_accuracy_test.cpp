#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "mesh/rims.hpp"
#include "methods/known_truth.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

/// Root mean square error over the free vertices, relative to the root mean square of their true displacements.
double free_error(const SurfaceMesh& mesh, const std::vector<int>& constrained, const Eigen::VectorXd& u,
                  const Positions& truth) {
    const std::set<int> fixed(constrained.begin(), constrained.end());
    double off = 0.0, size = 0.0;
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        if (fixed.contains(v)) continue;
        off += (u.segment<3>(3 * v) - truth.col(v)).squaredNorm();
        size += truth.col(v).squaredNorm();
    }
    return std::sqrt(off / size);
}

/// Of make_potato(200), pulled or turned.
KnownTruth truth_of_200(const OrganicBody& organic, bool turned) {
    return known_truth(turned ? "turned_potato_of_200.csv" : "pulled_potato_of_200.csv", organic.surface, [&] {
        return compute_truth(organic.surface, organic.constrained(),
                             turned ? organic.turned_values(0.35) : organic.values(0.2), {1.0, 0.3}, {1});
    });
}

/// A small patch pulled on an organic body, against quadratic finite elements graded towards the rims and extrapolated:
/// where the traction model decides.
TEST(OrganicBody, IsDisplacedNoWorseByTheDefaultTractionsThanByFem) {
    for (const double nu : {0.3, 0.45}) {
        const OrganicBody organic = make_potato();
        const Material material{1.0, nu};
        const std::vector<int> constrained = organic.constrained();
        const Positions values = organic.values(0.2);
        const std::string file = nu == 0.3 ? "pulled_potato.csv" : "pulled_potato_nearly_incompressible.csv";
        const KnownTruth truth = known_truth(
            file, organic.surface, [&] { return compute_truth(organic.surface, constrained, values, material, {1}); });
        const Body body = make_body(organic.surface, material);
        const auto error = [&](const Method& method) {
            const Eigen::VectorXd u = displaced(precomputed(body, method), {{}, constrained}, values.reshaped());
            return free_error(organic.surface, constrained, u, truth.displacements);
        };
        const double by_default = error(Method{.kind = kLinearBem});
        print_measured("organic body, default tractions, relative rms error", by_default);
        print_measured("organic body, fem, relative rms error", error(make_method(kFem)));
        print_measured("organic body, constant-bem, relative rms error", error(make_method(kConstantBem)));
        print_measured("organic body, truth, estimated relative error", truth.relative_error);
        EXPECT_LT(by_default + truth.relative_error, error(make_method(kFem))) << "nu " << nu;
        EXPECT_LT(by_default, error(make_method(kLinearBem, Tractions::restricted))) << "nu " << nu;
        EXPECT_LT(by_default, 0.05) << "nu " << nu;
    }
}

/// A potato whose small patch is pulled, then turned.
struct PulledAndTurned {
    OrganicBody organic = make_potato(200);
    std::vector<int> constrained = organic.constrained();
    std::vector<Positions> values = {organic.values(0.2), organic.turned_values(0.35)};
    std::vector<KnownTruth> truths = {truth_of_200(organic, false), truth_of_200(organic, true)};

    double error(std::size_t motion, const Eigen::VectorXd& u) const {
        return free_error(organic.surface, constrained, u, truths[motion].displacements);
    }
    static std::string name(std::size_t motion) { return motion == 0 ? ", pulled" : ", turned"; }
};

/// Small patches, whose rims are most of the error of all triangles.
TEST(OrganicBody, IsDisplacedThreeTimesAsAccuratelyWithARowOfThinTrianglesAlongTheRims) {
    const PulledAndTurned potato;
    std::vector<double> as_given;
    for (const int rows : {0, 1, 3}) {
        Control control;
        Deformer deformer(
            precomputed(make_body(potato.organic.surface, {1.0, 0.3}), {.kind = kGalerkinBem, .rims = rows}));
        deformer.constrain({{}, potato.constrained}, control);
        for (const std::size_t motion : {0u, 1u}) {
            const Deformer::Answer answer =
                deformer.answer(potato.values[motion].reshaped(), {.check = rows > 0}, control);
            const double left = potato.error(motion, answer.displacements);
            if (rows == 0) {
                as_given.push_back(left);
                continue;
            }
            const Positions& truth = potato.truths[motion].displacements;
            const Eigen::Matrix3Xd off = answer.displacements.reshaped(3, truth.cols()) - truth;
            const double estimate = answer.check.value().relative_error * truth.colwise().norm().maxCoeff() /
                                    off.colwise().norm().maxCoeff();
            print_measured(std::to_string(rows) + " rows" + PulledAndTurned::name(motion), left);
            print_measured("the estimate over the largest error", estimate);
            EXPECT_LT(left, (rows == 1 ? 0.33 : 0.25) * as_given[motion]) << rows;
            EXPECT_GT(estimate, 1.0 / 2.5) << rows;
            EXPECT_LT(estimate, 2.5) << rows;
        }
    }
}

/// What the advice beside a coarse mesh says: the triangles along the rims of the constrained patches decide, for a
/// patch that is turned as for one that is pulled, whatever carries the tractions.
TEST(OrganicBody, HalvingTheTrianglesAlongTheRimsHalvesTheError) {
    const PulledAndTurned potato;
    const SurfaceMesh& coarse = potato.organic.surface;
    std::vector<char> is_constrained(static_cast<std::size_t>(coarse.n_vertices()), 0), in_region;
    for (const int v : potato.constrained) is_constrained[static_cast<std::size_t>(v)] = 1;
    for (const auto& triangle : coarse.triangles.colwise())
        in_region.push_back(std::all_of(triangle.begin(), triangle.end(),
                                        [&](int v) { return is_constrained[static_cast<std::size_t>(v)] != 0; }));
    const RefinedSurface whole = unrefined(coarse), halved = refine_marked(whole, around_rim(whole, in_region));
    // Of both motions.
    const auto errors = [&](const RefinedSurface& surface, const Method& method) {
        std::set<int> held;
        for (int t = 0; t < surface.mesh.n_triangles(); ++t)
            if (in_region[static_cast<std::size_t>(surface.coarse_triangle[static_cast<std::size_t>(t)])])
                for (const int v : surface.mesh.triangles.col(t)) held.insert(v);
        const std::vector<int> set(held.begin(), held.end());
        Control control;
        Deformer deformer(precomputed(make_body(surface.mesh), method));
        deformer.constrain({{}, set}, control);
        std::array<double, 2> both{};
        for (const std::size_t motion : {0u, 1u}) {
            Positions everywhere = Positions::Zero(3, coarse.n_vertices());
            everywhere(Eigen::all, potato.constrained) = potato.values[motion];
            const Positions all = surface.interpolate(everywhere);
            both[motion] =
                potato.error(motion, deformer.displace(at(all.reshaped(), set)).head(3 * coarse.n_vertices()));
        }
        return both;
    };
    for (const Method& method : {make_method(kLinearBem), make_method(kLinearBem, Tractions::restricted),
                                 make_method(kLinearBem, Tractions::continuous), make_method(kGalerkinBem)}) {
        const std::array<double, 2> before = errors(whole, method), after = errors(halved, method);
        for (const std::size_t motion : {0u, 1u}) {
            const std::string what = describe(method) + PulledAndTurned::name(motion);
            print_measured(what + ", rims as they are", before[motion]);
            print_measured(what + ", rims halved", after[motion]);
            EXPECT_LT(after[motion], 0.7 * before[motion]) << what;
        }
    }
}

}  // namespace
}  // namespace elastolab::test
