#include "app/names.hpp"

#include <gtest/gtest.h>

namespace elastolab {
namespace {

TEST(Names, MethodsAreCalledAsOnTheirButtons) {
    EXPECT_EQ(with_titles("fem: too coarse. Choose galerkin-bem or quadratic-fem, or compare with fem."),
              "FEM: too coarse. Choose Galerkin BEM or Quadratic FEM, or compare with FEM.");
    EXPECT_EQ(with_titles("linear-bem, constant-bem (linear-bem)"), "Linear BEM, Constant BEM (Linear BEM)");
}

TEST(Names, WordsThatOnlyContainAMethodStay) {
    for (const char* text : {"fem.obj", "bodies/fem", "fem/ear.obj", "my-fem", "femur", "fem-2", "a.fem"})
        EXPECT_EQ(with_titles(text), text);
}

}  // namespace
}  // namespace elastolab
