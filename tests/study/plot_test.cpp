#include "study/report/plot.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "support/temporary_folder.hpp"

namespace elastolab::test {
namespace {

using testing::HasSubstr;

TEST(Plot, ReadsTheColumnsOfTheTableByName) {
    Plot plot{
        .name = "p", .title = "It's a title", .caption = {}, .x_label = "vertices", .y_label = "s", .log_y = true};
    plot.series.push_back({"fem", {{"method", "fem"}, {"share", "0.1"}}, "vertices", "seconds", method_color("fem")});
    const std::string script = gnuplot_script(plot, "t.csv");
    EXPECT_THAT(script, HasSubstr("'It''s a title'"));
    EXPECT_THAT(script, HasSubstr("strcol('method') eq 'fem' && strcol('share') eq '0.1' ? column('vertices') : NaN"));
    EXPECT_THAT(script, HasSubstr("set logscale y"));
}

TEST(Plot, DashesTheVariantsOfAMethodInItsColour) {
    const Series plain = variant_series("linear-bem", {{"nu", "0.3"}}, "size", "error");
    const Series variant = variant_series("quadratic-fem of something", {}, "size", "error");
    EXPECT_EQ(plain.color, method_color("linear-bem"));
    EXPECT_EQ(plain.where, (Row{{"nu", "0.3"}}));
    EXPECT_FALSE(plain.dashed);
    EXPECT_TRUE(variant.dashed);
    EXPECT_TRUE(element_series("bend, 4 nodes", {}, "cells", 1, true).dashed);
    EXPECT_EQ(element_series("bend, 10 nodes", {}, "cells", 1, false).y, "error");
}

TEST(Plot, SaysWhatGnuplotComplainsAbout) {
    const TemporaryFolder folder;
    folder.write("bad.gp", "plot 'missing.csv'\n");
    Control control;
    EXPECT_NE(draw("bad", folder.path(), control), "");
}

}  // namespace
}  // namespace elastolab::test
