// Scenes whose handles turn by more than half a circle, as `solve` answers them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"
#include "scene/solve.hpp"

namespace elastolab {
namespace {

/// A bar of 4 x 1 x 1, one end fixed, the other turned about the bar.
Solution twisted(double degrees, MethodKind kind = kNonlinearFem) {
    const Document document = parse_scene(R"({"elastolab": 1,
      "mesh": {"primitive": "beam", "resolution": 2},
      "material": {"young_modulus": 2.0, "poisson_ratio": 0.3},
      "method": "fem",
      "fixed": {"box": {"min": [0, 0, 0], "max": [0, 1, 1]}},
      "handles": [{"name": "end", "select": {"box": {"min": [4, 0, 0], "max": [4, 1, 1]}},
                   "rotate": {"axis": [1, 0, 0], "degrees": )" +
                                              std::to_string(degrees) + R"(, "center": [4, 0.5, 0.5]}}]})",
                                          "scene.json");
    Method method{.kind = kind};
    method.elements = ElementDegree::linear;
    Control control;
    return solve({.scene_file = "scene.json", .document = document, .method = method}, control);
}

constexpr double kCoarse = 6.0;  ///< what four-node elements of this size leave of symmetry [degree]

/// How far an edge of the bar is turned halfway between its ends [degree], from -180 to 180.
double turn_in_the_middle(const Solution& solution) {
    Eigen::Index vertex = 0;
    const Eigen::Vector3d edge(2, 1, 1), axis(2, 0.5, 0.5);
    EXPECT_LT((solution.surface->vertices.colwise() - edge).colwise().norm().minCoeff(&vertex), 1e-9);
    const Eigen::Vector2d from = (edge - axis).tail<2>();
    const Eigen::Vector2d to = (edge - axis + solution.displacement.col(vertex)).tail<2>();
    return std::atan2(from[0] * to[1] - from[1] * to[0], from.dot(to)) * 180.0 / std::numbers::pi;
}

TEST(SolvedTurns, HalfATurnGoesTheWayThatItSays) {
    EXPECT_NEAR(turn_in_the_middle(twisted(180)), 90, kCoarse);
    EXPECT_NEAR(turn_in_the_middle(twisted(-180)), -90, kCoarse);
    EXPECT_NEAR(turn_in_the_middle(twisted(250)), 125, kCoarse);
}

TEST(SolvedTurns, AFullTurnIsNotRest) {
    const Solution none = twisted(0), half = twisted(180), full = twisted(360);
    EXPECT_EQ(none.facts->energy, 0.0);
    EXPECT_GT(half.facts->energy, 0.0);
    EXPECT_GT(full.facts->energy, 2.0 * half.facts->energy);
    EXPECT_LT(none.displacement.norm(), 1e-12);
    EXPECT_GT(std::abs(turn_in_the_middle(full)), 135) << "half a turn, as far as so few elements tell";
    EXPECT_LT(*full.residual, 1e-7);
}

TEST(SolvedTurns, LinearTheorySeesNothingOfAFullTurn) {
    const Solution full = twisted(360, kQuadraticFem), none = twisted(0, kQuadraticFem);
    EXPECT_LT(full.displacement.norm(), 1e-12);
    ASSERT_TRUE(full.linear_theory_error);
    EXPECT_NEAR(*full.linear_theory_error, 1.0, 1e-6);
    EXPECT_FALSE(none.linear_theory_error);
}

}  // namespace
}  // namespace elastolab
