// Constrained sets on demand: whichever way is taken, the answer is that of a factorisation with the set eliminated.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "fem/fem_body.hpp"
#include "fem/forward_elimination.hpp"
#include "fem/method.hpp"
#include "fem/model.hpp"
#include "fem/prices.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

using test::relative_error;

/// Held at its lower end.
struct Potato {
    explicit Potato(int cells) : surface(make_sphere(cells)) {
        surface.vertices.row(2) *= 1.7;
        surface.vertices.row(0) += 0.2 * surface.vertices.row(2).array().square().matrix();
        fixed = where([](const Eigen::Vector3d& x) { return x[2] < -1.3; });
    }
    template <class Where>
    std::vector<int> where(const Where& where) const {
        return test::vertices_where(surface.vertices, surface.n_vertices(), where);
    }
    /// So many vertices that are nearest to a point, without the fixed set.
    std::vector<int> patch(const Eigen::Vector3d& centre, int size) const {
        std::vector<int> vertices = where([](const Eigen::Vector3d& x) { return x[2] >= -1.3; });
        std::sort(vertices.begin(), vertices.end(), [&](int a, int b) {
            return (surface.vertices.col(a) - centre).norm() < (surface.vertices.col(b) - centre).norm();
        });
        vertices.resize(static_cast<std::size_t>(size));
        return vertices;
    }
    std::shared_ptr<const FemModel> model(Update update, ElementDegree degree) const {
        Method method{.kind = degree == ElementDegree::linear ? kFem : kQuadraticFem};
        method.update = update;
        Control control;
        return std::make_shared<FemModel>(surface, "potato", 0.3, method, control, degree);
    }

    SurfaceMesh surface;
    std::vector<int> fixed;
};

struct SetAnswer {
    Eigen::MatrixXd u;
    Reactions reactions;
    double residual = 0.0;
};

/// Base at rest, handles moved at random, several columns at once.
SetAnswer constrained_answer(const FemModel& model, const std::vector<int>& fixed, const std::vector<int>& handles) {
    Control control;
    const auto solid = model.constrain(fixed, handles, {}, control);
    std::srand(5);
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(3 * std::ssize(fixed) + 3 * std::ssize(handles), 3);
    values.bottomRows(3 * std::ssize(handles)).setRandom();
    NodeSolution solution = solid->solve(values.leftCols(1), true);
    SetAnswer answer{{}, solid->reactions(solution), solid->residual(solution, control)};
    answer.u = solid->displacements(solid->solve(values, false));
    return answer;
}

class SetPrices : public testing::TestWithParam<ElementDegree> {};

TEST_P(SetPrices, EveryWayGivesTheAnswerOfAFactorisationOfItsOwn) {
    // Few columns are kept on the first, none on the second.
    for (const int cells : GetParam() == ElementDegree::linear ? std::array{4, 10} : std::array{3, 6}) {
        const Potato potato(cells);
        const auto direct = potato.model(Update::direct, GetParam()),
                   reduced = potato.model(Update::reduced, GetParam());
        std::vector<int> two = potato.patch({0, 0, 1.7}, 5), other = potato.patch({0, -1, -0.5}, 5);
        two.insert(two.end(), other.begin(), other.end());
        struct Set {
            const char* what;
            std::vector<int> fixed, handles;
        };
        for (const Set& set :
             {Set{"a handle", potato.fixed, potato.patch({0, 0, 1.7}, 5)},
              Set{"another on the same fixed set", potato.fixed, potato.patch({1, 0, 0}, 4)},
              Set{"more than half of the surface", potato.fixed,
                  potato.patch({0, 0, 1.7}, potato.surface.n_vertices() * 2 / 3)},
              Set{"two handles, no fixed set", {}, two}, Set{"the fixed set alone", potato.fixed, {}},
              Set{"a fixed set that does not hold", potato.patch({1, 0, 0}, 2), potato.patch({0, 0, 1.7}, 5)}}) {
            SCOPED_TRACE(testing::Message() << cells << " cells, " << set.what);
            const SetAnswer truth = constrained_answer(*direct, set.fixed, set.handles),
                            answer = constrained_answer(*reduced, set.fixed, set.handles);
            if (set.handles.empty()) {
                EXPECT_EQ(answer.u.norm(), 0.0);
                continue;
            }
            EXPECT_LT(relative_error(answer.u, truth.u), 1e-9);
            EXPECT_LT(relative_error(answer.reactions.forces, truth.reactions.forces), 1e-9);
            EXPECT_LT(relative_error(answer.reactions.moments, truth.reactions.moments), 1e-9);
            EXPECT_LT(answer.residual, 1e-12);
        }
    }
}

TEST_P(SetPrices, ANewHandleOnAKeptBaseNeedsNoFactor) {
    const Potato potato(GetParam() == ElementDegree::linear ? 14 : 8);
    const auto model = potato.model(Update::reduced, GetParam());
    const std::uint64_t factor = model->facts().memory_bytes;
    const std::vector<int> first = potato.patch({0, 0, 1.7}, 12), next = potato.patch({1, 0, 0}, 12);
    EXPECT_GT(model->constrain_memory(potato.fixed, first), factor);
    Control control;
    const auto solid = model->constrain(potato.fixed, first, {}, control);
    EXPECT_LT(model->constrain_memory(potato.fixed, next), factor / 4);
    // Most of the surface: cheaper with all of it eliminated.
    EXPECT_GT(model->constrain_memory(potato.fixed, potato.patch({0, 0, 1.7}, potato.surface.n_vertices() * 3 / 4)),
              factor);
}

INSTANTIATE_TEST_SUITE_P(Degrees, SetPrices, testing::Values(ElementDegree::linear, ElementDegree::quadratic),
                         [](const auto& degree) {
                             return degree.param == ElementDegree::linear ? "linear" : "quadratic";
                         });

TEST(Flops, OfAFactorisationOfADenseMatrixAreAThirdOfItsCube) {
    const int n = 60;
    const SparseMatrix A = (Eigen::MatrixXd::Ones(n, n) + n * Eigen::MatrixXd::Identity(n, n)).sparseView();
    const CholeskyAnalysis analysis(A);
    EXPECT_NEAR(factorisation_flops(analysis.view()), n * n * n / 3.0, 1e-9 * n * n * n);
    // Y is the inverse factor: as many rows as the matrix, in each of the columns.
    const std::vector<int> nodes = {0, 7};
    EXPECT_EQ(compressed_inverse_cost(analysis.view(), nodes).bytes, 8u * n * 6);
    EXPECT_NEAR(compressed_inverse_cost(analysis.view(), nodes).flops, 6.0 * n * n + 6.0 * 6.0 * n, 1e-9);
}

}  // namespace
}  // namespace elastolab
