// Slender columns beyond Euler's load, bars that follow a tension, and bars turned by whole circles.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "findings/words.hpp"
#include "mesh/primitives.hpp"
#include "scene/held_bar.hpp"

namespace elastolab {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr double kLength = 16.0, kModulus = 1e4;
/// Of a column of square section, free at its top.
constexpr double kEuler = std::numbers::pi * std::numbers::pi * kModulus / 12.0 / (4.0 * kLength * kLength);

Selector top() { return {PlaneSelector{{kLength, 0, 0}, {1, 0, 0}, 1e-9}}; }

/// Along x, without a Poisson effect, pressed at its top by so many times Euler's load.
Document column(double times) {
    Document document = held_bar(kModulus, 1);
    document.mesh = Primitive{.name = "box", .resolution = 2, .size = {kLength, 1.0, 1.0}};
    document.material.poisson_ratio = 0.0;
    document.loads = {{.name = "press", .select = top(), .value = ForceLoad{{-times * kEuler, 0, 0}}}};
    return document;
}

/// Of the elliptic integrals of the elastica under so many times Euler's load: K(k) = pi/2 sqrt(times). The top is then
/// (2 E/K - 1) L high and 2 k/K L aside (Timoshenko and Gere, Theory of Elastic Stability, section 2.7).
double modulus_of(double times) {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; ++i) {
        const double k = 0.5 * (low + high);
        (std::comp_ellint_1(k) < 0.5 * std::numbers::pi * std::sqrt(times) ? low : high) = k;
    }
    return low;
}

/// Close above Euler's load a column leaves the straight line slowly; far above it turns by more than a right angle.
TEST(Buckling, ColumnBeyondEulersLoadIsTheElastica) {
    for (const double times : {1.02, 1.14, 3.0})
        for (const double aside : {0.0, 2e-4}) {
            SCOPED_TRACE(testing::Message() << times << " " << aside);
            Document document = column(times);
            document.loads[0].value = ForceLoad{{-times * kEuler, aside * kEuler, 0}};
            const Solution bent = ten_nodes(document, kNonlinearFem);
            const SurfaceMesh surface = make_box(2, {kLength, 1.0, 1.0});
            Eigen::Vector3d moved = Eigen::Vector3d::Zero();
            int n = 0;
            for (int v = 0; v < surface.n_vertices(); ++v)
                if (surface.vertices(0, v) == kLength) moved += bent.displacement.col(v), ++n;
            moved /= n;
            // Elements and shear make the column softer or stiffer by some per mille, which matters close to the load.
            const double k = modulus_of(times), K = std::comp_ellint_1(k), E = std::comp_ellint_2(k);
            const double tolerance = (times < 1.1 ? 0.05 : 0.02) * kLength;
            EXPECT_NEAR(moved.x(), (2.0 * E / K - 2.0) * kLength, tolerance);
            EXPECT_NEAR(moved.tail<2>().norm(), 2.0 * k / K * kLength, tolerance);
            EXPECT_TRUE(bent.facts->stable);
        }
}

TEST(Buckling, LinearTheoryIsSaidToBeWrongBeyondEulersLoad) {
    EXPECT_THAT(words(ten_nodes(column(1.5), kQuadraticFem).findings), Contains(HasSubstr("linear theory")));
    EXPECT_THAT(words(ten_nodes(column(0.5), kQuadraticFem).findings), Not(Contains(HasSubstr("linear theory"))));
}

/// Its tangent is not symmetric, and the symmetric part not positive definite.
TEST(Buckling, BarThatATensionFollowsIsStable) {
    Document document = held_bar(1e4, 2);
    document.loads = {{.name = "suction", .select = end_of_bar(), .value = PressureLoad{-300.0}}};
    const Solution pulled = ten_nodes(document, kNonlinearFem);
    EXPECT_TRUE(pulled.facts->stable);
    ASSERT_TRUE(pulled.error_estimate);
    EXPECT_LT(*pulled.error_estimate, 0.05);
}

/// Nothing is prescribed but the way there.
TEST(Buckling, ABarTurnedByAWholeCircleIsNotSaidToBeExact) {
    Document document = held_bar(1e4, 2);
    AffineMotion motion;
    motion.rotate = {.axis = {1, 0, 0}, .degrees = 360.0, .center = {0, 0.5, 0.5}};
    document.handles = {{.name = "end", .select = end_of_bar(), .motion = motion}};
    const Solution wound = ten_nodes(document, kNonlinearFem);
    EXPECT_GT(wound.displacement.colwise().norm().maxCoeff(), 0.1);
    EXPECT_GT(wound.error_estimate.value_or(1.0), 1e-3);
}

}  // namespace
}  // namespace elastolab
