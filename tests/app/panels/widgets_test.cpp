#include "app/panels/widgets.hpp"

#include <gtest/gtest.h>

#include <imgui.h>
#include <limits>
#include <utility>

#include "app/panels/bare_gui.hpp"

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

TEST(LineBreaks, StandAtSpacesAndNotInNumbers) {
    const auto n_characters = [](const std::string& text) { return static_cast<float>(text.size()); };
    const auto broken = [&](const std::string& text) { return broken_at_spaces(text, 10.0f, n_characters); };
    EXPECT_EQ(broken("takes 0.5 or 12,345.75 of it."), "takes 0.5\nor\n12,345.75\nof it.");
    EXPECT_EQ(broken("short"), "short");
    EXPECT_EQ(broken("a\nb c"), "a\nb c");
    EXPECT_EQ(broken("/a/very/long/name is long"), "/a/very/long/name\nis long") << "is left to Dear ImGui";
    EXPECT_EQ(broken(""), "");
}

TEST(VectorText, ShowsRoundingAsZero) {
    EXPECT_EQ(vector_text({0.5, -2.249e-17, 1.0}), "(0.5, 0, 1)");
    EXPECT_EQ(vector_text({0.5, -2.249e-7, 1.0}), "(0.5, -2.25e-07, 1)");
    EXPECT_EQ(vector_text({1e-20, 2e-20, 0.0}), "(1e-20, 2e-20, 0)");
}

/// A panel with one field, which takes the keys where `asks` says so.
template <class Draw>
auto panel_with(bool& asks, const Draw& draw_field) {
    return [&asks, draw_field] {
        ImGui::Begin("panel");
        if (std::exchange(asks, false)) ImGui::SetKeyboardFocusHere();
        draw_field();
        ImGui::End();
    };
}

TEST(Numbers, KeepTheirHiddenDigitsWhereTypingIsTakenBack) {
    constexpr double kExact = 324.33412345;
    BareGui gui;
    double value = kExact;
    bool asks = true;
    const auto draw = panel_with(asks, [&] { draw_numbers("force", &value, 1, "", 1.0f, 0.0); });
    for (int i = 0; i < 3; ++i) gui.frame(draw);
    gui.type("9", draw);
    EXPECT_EQ(value, 9.0) << "what is typed counts at once";
    gui.press(ImGuiKey_Escape, draw);
    EXPECT_EQ(value, kExact);
    asks = true;
    for (int i = 0; i < 3; ++i) gui.frame(draw);
    gui.type("12.5", draw);
    gui.press(ImGuiKey_Enter, draw);
    EXPECT_EQ(value, 12.5);
}

TEST(Numbers, AreFinite) {
    BareGui gui;
    double force = 1.0;
    bool asks = true;
    const auto type_into = [&](double& value, const char* text, const auto& draw) {
        asks = true;
        for (int i = 0; i < 3; ++i) gui.frame(draw);
        gui.type(text, draw);
        gui.press(ImGuiKey_Enter, draw);
        return value;
    };
    const auto any = panel_with(asks, [&] { draw_numbers("force", &force, 1, "", 1.0f); });
    EXPECT_EQ(type_into(force, "1e999", any), 1.0);
    EXPECT_EQ(type_into(force, "-3", any), -3.0);
}

TEST(NumberField, CountsOnceItIsLeft) {
    BareGui gui;
    NumberField field;
    std::vector<double> counted;
    bool asks = true;
    const auto draw = panel_with(asks, [&] {
        if (const auto typed = field.draw("density", 2.0, 1.0f)) counted.push_back(*typed);
    });
    const auto type = [&](const char* text, ImGuiKey_ last) {
        asks = true;
        for (int i = 0; i < 3; ++i) gui.frame(draw);
        gui.type(text, draw);
        EXPECT_TRUE(counted.empty()) << "0.5 passes through 0";
        gui.press(last, draw);
        gui.frame(draw);
        return std::exchange(counted, {});
    };
    EXPECT_EQ(type("0.5", ImGuiKey_Enter), std::vector{0.5});
    EXPECT_EQ(type("-3", ImGuiKey_Enter), std::vector{-3.0}) << "whoever asks says what is wrong with it";
    EXPECT_EQ(type("7", ImGuiKey_Escape), std::vector<double>{});
}

}  // namespace
}  // namespace elastolab
