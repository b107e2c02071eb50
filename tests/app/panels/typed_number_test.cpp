#include "app/panels/typed_number.hpp"

#include <gtest/gtest.h>

namespace elastolab {
namespace {

struct Typed {
    const char* text;
    double number;
};

TEST(TypedNumber, HasAPointOrACommaBeforeItsDecimals) {
    for (const auto& [text, number] :
         {Typed{"0.25", 0.25}, Typed{"0,25", 0.25}, Typed{",5", 0.5}, Typed{" -1,5e3 ", -1500.0}, Typed{"+2", 2.0},
          Typed{"1e-29", 1e-29}, Typed{"7\n", 7.0}})
        EXPECT_EQ(typed_number(text, "", 3.0), number) << text;
}

TEST(TypedNumber, MayBeAQuotientOrAProductAlsoOfWhatStoodThere) {
    for (const auto& [text, number] : {Typed{"1/8", 0.125}, Typed{"3*2/4", 1.5}, Typed{"*2", 6.0}, Typed{"/2", 1.5}})
        EXPECT_EQ(typed_number(text, "", 3.0), number) << text;
}

TEST(TypedNumber, MayHaveItsUnit) {
    EXPECT_EQ(typed_number("45\u00b0", "\u00b0", 0.0), 45.0);
    EXPECT_EQ(typed_number("45 \u00b0", "\u00b0", 0.0), 45.0);
    EXPECT_EQ(typed_number("45", "\u00b0", 0.0), 45.0);
}

TEST(TypedNumber, IsNothingElse) {
    for (const char* text : {"", " ", "abc", "nan", "inf", "1.5.2", "1,5,2", "1,234.5", "0.1 0.2", "0x10", "1e400",
                             "1e-320", "1e-31", "-1e31", "1/0", "1/", "*", "2**3", "5m"})
        EXPECT_EQ(typed_number(text, "\u00b0", 3.0), std::nullopt) << text;
}

}  // namespace
}  // namespace elastolab
