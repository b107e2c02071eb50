#include "study/report/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "study/setups.hpp"

namespace elastolab::test {
namespace {

TEST(Statistics, FitsTheExponentOfAPowerLaw) {
    const std::vector<double> x = {1.0, 2.0, 4.0, 9.0};
    std::vector<double> y;
    for (const double value : x) y.push_back(3.0 * std::pow(value, 1.7));
    EXPECT_NEAR(fitted_exponent(x, y), 1.7, 1e-12);
    EXPECT_TRUE(std::isnan(fitted_exponent(std::vector{1.0}, std::vector{1.0})));
    EXPECT_NEAR(interpolate_log(x, y, 3.0), 3.0 * std::pow(3.0, 1.7), 1e-9);
    EXPECT_TRUE(std::isnan(interpolate_log(x, y, 10.0)));
}

TEST(Statistics, TakesTheMedian) {
    EXPECT_EQ(median({5.0, 1.0, 3.0}), 3.0);
    EXPECT_EQ(median({4.0, 1.0}), 2.5);
    EXPECT_TRUE(std::isnan(median({})));
}

TEST(Statistics, ChoosesTheSameDifferentNumbersForTheSameSeed) {
    const std::vector<int> chosen = choose_numbers(100, 30, 7);
    EXPECT_EQ(chosen.size(), 30U);
    EXPECT_TRUE(std::adjacent_find(chosen.begin(), chosen.end(), std::greater_equal<>()) == chosen.end());
    EXPECT_EQ(chosen, choose_numbers(100, 30, 7));
    EXPECT_NE(chosen, choose_numbers(100, 30, 8));
}

}  // namespace
}  // namespace elastolab::test
