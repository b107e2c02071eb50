#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "methods/problem.hpp"
#include "methods/registry.hpp"
#include "study/error/organic_body.hpp"
#include "study/error/organic_truth.hpp"

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

/// A small patch pulled on an organic body, against quadratic finite elements graded towards the rims and extrapolated:
/// where the traction model decides.
TEST(OrganicBody, IsDisplacedNoWorseByTheDefaultTractionsThanByFem) {
    for (const double nu : {0.3, 0.45}) {
        const OrganicBody organic = make_potato();
        const Material material{1.0, nu};
        const std::vector<int> constrained = organic.constrained();
        const Positions values = organic.values(0.2);
        const OrganicTruth truth = compute_truth(organic.surface, constrained, values, material, {1});
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

}  // namespace
}  // namespace elastolab::test
