// Weight, pressure and forces by hierarchical matrices, beside the same by dense ones.
#include <gtest/gtest.h>

#include <algorithm>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "bem/hierarchical/cases.hpp"
#include "mesh/measures.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

/// A method by dense matrices, and by hierarchical ones.
struct Pair {
    Method dense, hierarchical;
};
std::vector<Pair> pairs() {
    std::vector<Pair> all;
    for (const MethodKind kind : {kGalerkinBem, kLinearBem})
        all.push_back({{.kind = kind, .update = Update::direct}, {.kind = kind, .hierarchical_from = 0}});
    return all;
}

/// All kinds of loads on a body that is held below and pulled above.
ConstrainedSet loaded_set(const OrganicBody& body) {
    ConstrainedSet set{body.fixed, body.pull};
    std::vector<char> is_constrained(static_cast<std::size_t>(body.surface.n_vertices()), 0);
    for (const int v : body.constrained()) is_constrained[static_cast<std::size_t>(v)] = 1;
    std::vector<int> left, right;
    for (int t = 0; t < body.surface.n_triangles(); ++t) {
        const auto corners = body.surface.triangles.col(t);
        if (std::all_of(corners.begin(), corners.end(),
                        [&](int v) { return is_constrained[static_cast<std::size_t>(v)]; }))
            continue;
        (centroid(body.surface, t).x() < 0.0 ? left : right).push_back(t);
    }
    set.loads = {body_force_along(0), body_force_along(2), unit_pressure(body.surface, left),
                 unit_force(body.surface, right, {0.2, -0.5, 0.3})};
    return set;
}

TEST(HierarchicalLoads, AreAnsweredAsByDenseMatrices) {
    const OrganicBody body = make_rabbit(300);
    const ConstrainedSet set = loaded_set(body);
    Eigen::VectorXd values(set.n_values());
    values << Eigen::Vector3d(0.1, -0.05, 0.1).replicate(std::ssize(set.handles), 1), 0.2, -0.4, 0.1, 0.3;
    for (const double nu : {0.3, 0.5})
        for (const Pair& pair : pairs()) {
            Control control;
            std::vector<Deformer::Answer> answers;
            for (const Method& method : {pair.dense, pair.hierarchical}) {
                Deformer deformer(precomputed(make_body(body.surface, {2.0, nu}), method));
                deformer.constrain(set, control);
                answers.push_back(deformer.answer(values, {.residual = true}, control));
            }
            const std::string what = std::string(pair.hierarchical.kind->name) + ", nu " + std::to_string(nu);
            EXPECT_LT(off(answers[1].displacements, answers[0].displacements), 1e-6) << what;
            EXPECT_LT(off(answers[1].reactions.forces, answers[0].reactions.forces), 1e-4) << what;
            EXPECT_LT(answers[1].residual.value(), 1e-6) << what;
        }
}

/// A load's column of a drag is the difference that its factor makes.
TEST(HierarchicalLoads, HaveColumnsOfTheirOwn) {
    const OrganicBody body = make_rabbit(350);
    const ConstrainedSet set = loaded_set(body);
    const auto n_loads = std::ssize(set.loads);
    for (const Pair& pair : pairs()) {
        Control control;
        Deformer deformer(precomputed(make_body(body.surface), pair.hierarchical));
        deformer.constrain(set, control);
        Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(set.n_values(), n_loads);
        basis.bottomRows(n_loads).setIdentity();
        const DragResponse drag =
            deformer.drag_response(Eigen::VectorXd::Zero(set.n_values()), basis, control, kSolveTolerance);
        Eigen::VectorXd values = Eigen::VectorXd::Zero(set.n_values()), u;
        values.tail(n_loads) << 0.2, -0.4, 0.1, 0.3;
        drag.displace(values.tail(n_loads), u);
        EXPECT_LT(off(u, deformer.displace(values)), 1e-6) << pair.hierarchical.kind->name;
    }
}

}  // namespace
}  // namespace elastolab::test
