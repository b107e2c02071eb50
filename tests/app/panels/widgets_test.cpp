#include "app/panels/widgets.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace elastolab {
namespace {

TEST(NumberText, HasThreeDigitsAndAnExponentOnlyWhereItIsShorter) {
    EXPECT_EQ(number_text(0.0), "0");
    EXPECT_EQ(number_text(84.1234), "84.1");
    EXPECT_EQ(number_text(999.6), "1000");
    EXPECT_EQ(number_text(1238.0), "1240");
    EXPECT_EQ(number_text(-43560.0), "-43600");
    EXPECT_EQ(number_text(99960.0), "1e+05");
    EXPECT_EQ(number_text(1.234e7), "1.23e+07");
    EXPECT_EQ(number_text(0.000012345), "1.23e-05");
    EXPECT_EQ(number_text(std::numeric_limits<double>::max()), "1.8e+308");
    EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "inf");
}

TEST(VectorText, ShowsRoundingAsZero) {
    EXPECT_EQ(vector_text({0.5, -2.249e-17, 1.0}), "(0.5, 0, 1)");
    EXPECT_EQ(vector_text({0.5, -2.249e-7, 1.0}), "(0.5, -2.25e-07, 1)");
    EXPECT_EQ(vector_text({1e-20, 2e-20, 0.0}), "(1e-20, 2e-20, 0)");
}

}  // namespace
}  // namespace elastolab
