#include "bem/galerkin/close_cost.hpp"

#include <gtest/gtest.h>

#include "bem/galerkin/slender_bar.hpp"

namespace elastolab::test {
namespace {

TEST(CostlyPairs, AreThoseOfThinWallsAndFarMoreThoseOfSlivers) {
    EXPECT_EQ(costly_pair_integrals(make_sphere(6)), 0.0);
    const double thin = costly_pair_integrals(bar_of_section(2e-3, 2e-3));  // an altitude of a hundredth of the edges
    EXPECT_GT(thin, 0.0);
    EXPECT_GT(costly_pair_integrals(bar_of_section(2e-4, 2e-4)), 10.0 * thin);
}

}  // namespace
}  // namespace elastolab::test
