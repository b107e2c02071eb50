#include "study/paper/paper_report.hpp"

#include <gmock/gmock.h>

namespace elastolab {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Precomputations of cubes of 98 and 386 vertices in the paper's way.
Table precomputations(const std::vector<double>& fem, const std::vector<double>& constant,
                      const std::vector<double>& linear) {
    Table table;
    const std::vector<double> vertices = {98.0, 386.0};
    for (const auto& [method, seconds] : {std::pair("fem", fem), {"constant-bem", constant}, {"linear-bem", linear}})
        for (std::size_t i = 0; i < vertices.size(); ++i)
            table.rows.push_back(Row{{"way", "paper"}, {"method", method}, {"part", "precompute"}}
                                     .set("vertices", vertices[i])
                                     .set("nodes", vertices[i])
                                     .set("precompute_s", seconds[i]));
    return table;
}

TEST(PaperReport, TellsWhatHoldsAtAllSizes) {
    const std::string always = conclude_paper(precomputations({2.0, 8.0}, {1.0, 6.0}, {0.1, 0.6})).findings;
    EXPECT_THAT(always, AllOf(HasSubstr("of constant-bem (a quarter or less at all sizes here)"),
                              HasSubstr("FEM is the slower at all sizes here"), Not(HasSubstr("nowhere here"))));
    const std::string later = conclude_paper(precomputations({0.5, 8.0}, {1.0, 6.0}, {0.5, 0.6})).findings;
    EXPECT_THAT(later, AllOf(HasSubstr("of constant-bem (a quarter or less from "),
                             HasSubstr("FEM becomes the slower at "), Not(HasSubstr("at all sizes here)"))));
    const std::string never = conclude_paper(precomputations({0.5, 1.0}, {1.0, 6.0}, {0.5, 5.0})).findings;
    EXPECT_THAT(never, AllOf(HasSubstr("of constant-bem (a quarter or less nowhere here)"), HasSubstr("no crossing")));
}

}  // namespace
}  // namespace elastolab
