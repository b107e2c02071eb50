#include "app/names.hpp"

#include <gmock/gmock.h>

#include "bem/collocation/method.hpp"
#include "fem/method.hpp"

namespace elastolab {
namespace {

using testing::HasSubstr;

TEST(Names, MethodsAreCalledAsOnTheirButtons) {
    EXPECT_EQ(with_titles("fem: too coarse. Choose galerkin-bem or quadratic-fem, or compare with fem."),
              "FEM: too coarse. Choose Galerkin BEM or Quadratic FEM, or compare with FEM.");
    EXPECT_EQ(with_titles("linear-bem, constant-bem (linear-bem)"), "Linear BEM, Constant BEM (Linear BEM)");
}

TEST(Names, WordsThatOnlyContainAMethodStay) {
    for (const char* text : {"fem.obj", "bodies/fem", "fem/ear.obj", "my-fem", "femur", "fem-2", "a.fem"})
        EXPECT_EQ(with_titles(text), text);
}

TEST(FieldTitles, NameTheUnitAndTheReference) {
    EXPECT_THAT(field_title(Field::difference, kConstantBem), HasSubstr("Constant BEM"));
    for (const Field field : {Field::displacement, Field::difference, Field::traction, Field::von_mises})
        EXPECT_THAT(field_title(field, kFem), HasSubstr("unit"));
    EXPECT_EQ(field_title(Field::none, kFem), "");
}

TEST(FieldTitle, HasTheUnitsThatAPersonNames) {
    const UnitNames units{"mm", "N"};
    EXPECT_EQ(field_title(Field::displacement, kFem), "displacement [mesh units]");
    EXPECT_EQ(field_title(Field::displacement_y, kFem, units), "displacement y [mm]");
    EXPECT_EQ(field_title(Field::von_mises, kFem, units), "von Mises stress [N/mm\u00b2]");
    EXPECT_EQ(field_title(Field::traction, kFem, {"", "N"}), "traction [N/unit\u00b2]");
    EXPECT_EQ(units.after_moment(), " N mm");
    EXPECT_EQ(after_value(Field::displacement_y, units), " mm");
    EXPECT_EQ(after_value(Field::none, units), " mm");
    EXPECT_EQ(after_value(Field::stress_xx, units), " N/mm\u00b2");
    EXPECT_EQ(after_value(Field::von_mises, {"", "N"}), "");
    EXPECT_EQ(UnitNames{}.after_stress(), "");
}

}  // namespace
}  // namespace elastolab
