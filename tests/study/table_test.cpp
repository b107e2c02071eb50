#include "study/report/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace elastolab::test {
namespace {

TEST(Table, KeepsSixDigitsAndKnowsWhatIsNoNumber) {
    const Row row = Row().set("pi", 3.14159265).set("n", 12).set("none", std::nan("")).set("word", std::string("fem"));
    EXPECT_EQ(row.text("pi"), "3.14159");
    EXPECT_EQ(row.number("n"), 12.0);
    EXPECT_EQ(row.text("none"), "");
    EXPECT_TRUE(std::isnan(row.number("none")));
    EXPECT_TRUE(std::isnan(row.number("word")));
    EXPECT_TRUE(std::isnan(row.number("missing")));
}

TEST(Table, SelectsRowsByTheirCells) {
    Table table{{"method", "x"}, {}};
    for (const char* method : {"fem", "bem", "fem"})
        table.rows.push_back(Row().set("method", std::string(method)).set("x", 1));
    EXPECT_EQ(table.where({{"method", "fem"}}).rows.size(), 2U);
    EXPECT_EQ(table.where({{"method", "fem"}, {"x", "2"}}).rows.size(), 0U);
    EXPECT_EQ(table.values("method"), (std::vector<std::string>{"fem", "bem"}));
    std::ostringstream out;
    write_csv(out, table);
    EXPECT_EQ(out.str(), "method,x\nfem,1\nbem,1\nfem,1\n");
    std::istringstream in(out.str());
    EXPECT_EQ(read_csv(in).rows, table.rows);
}

}  // namespace
}  // namespace elastolab::test
