#include "base/csv.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>

namespace elastolab {
namespace {

TEST(Csv, WritesTextAndNumbersThatAreReadBackExactly) {
    std::ostringstream out;
    CsvWriter table(out);
    const double third = 1.0 / 3.0;
    table.text("a \"left\", and").number(third).number(7).nothing(2);
    table.end_row();
    table.numbers(std::array{1e-300, -2.5}).number(third, 3);
    table.end_row();
    std::istringstream in(out.str());
    std::string first, second;
    std::getline(in, first);
    std::getline(in, second);
    const std::vector<std::string> cells = csv_fields(first);
    ASSERT_EQ(cells.size(), 5u);
    EXPECT_EQ(cells[0], "a \"left\", and");
    EXPECT_EQ(std::stod(cells[1]), third);
    EXPECT_EQ(cells[2] + cells[3] + cells[4], "7");
    EXPECT_EQ(std::stod(csv_fields(second)[0]), 1e-300);
    EXPECT_EQ(csv_fields(second)[2], "0.333");
}

TEST(Csv, KeepsALineToOneLine) {
    const std::vector<std::string> fields = {"plain", "with, comma", "with \"quotes\"", "", "3.5"};
    EXPECT_EQ(csv_line(fields), "plain,\"with, comma\",\"with \"\"quotes\"\"\",,3.5");
    EXPECT_EQ(csv_fields(csv_line(fields)), fields);
    EXPECT_EQ(csv_line({"two\nlines"}), "two lines");
}

}  // namespace
}  // namespace elastolab
