#include "app/preferences.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "app/window/state_folder.hpp"

namespace elastolab {
namespace {

TEST(Preferences, ComeBackAtTheNextStart) {
    EXPECT_EQ(load_preferences(), Preferences{});
    const Preferences chosen{Navigation::trackpad, false, 1.5f, {"mm", "kN"}};
    save_preferences(chosen);
    EXPECT_EQ(load_preferences(), chosen);
}

TEST(Preferences, ThatCannotBeReadAreAsAtTheFirstStart) {
    save_preferences({Navigation::blender, false, 2.0f});
    for (const char* text : {"", "{", "[]", "{\"navigation\": 3}", "{\"size\": \"large\"}"}) {
        std::ofstream(state_folder() / "preferences.json") << text;
        EXPECT_EQ(load_preferences(), Preferences{}) << text;
    }
    std::ofstream(state_folder() / "preferences.json")
        << R"({"navigation": "other", "size": 1e9, "length_unit": "parsecs of a long name"})";
    EXPECT_EQ(load_preferences().navigation, Navigation::standard);
    EXPECT_LE(load_preferences().ui_scale, 4.0f);
    EXPECT_EQ(load_preferences().units, UnitNames{}) << "longer than there is room for";
}

}  // namespace
}  // namespace elastolab
