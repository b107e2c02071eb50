// Which events go into one frame.
#include <gtest/gtest.h>

#include "app/panels/gui.hpp"

namespace elastolab {
namespace {

using Kind = InputEvent::Kind;

InputEvent button(bool pressed, int code = 0) { return {.kind = Kind::button, .code = code, .pressed = pressed}; }
InputEvent key(bool pressed, int code) { return {.kind = Kind::key, .code = code, .pressed = pressed}; }
const InputEvent kMove{.kind = Kind::cursor};

std::size_t n_of(const std::vector<InputEvent>& events) { return Gui::n_for_one_frame(events); }

TEST(EventsOfAFrame, APressAndItsReleaseFallIntoDifferentFrames) {
    EXPECT_EQ(n_of({kMove, kMove, button(true), button(false)}), 3u);
    EXPECT_EQ(n_of({key(true, 65), key(false, 65)}), 1u);
}

TEST(EventsOfAFrame, AButtonCountsWhereTheCursorWas) {
    EXPECT_EQ(n_of({kMove, button(true), kMove, button(false), kMove}), 2u);
    EXPECT_EQ(n_of({button(false), kMove}), 1u);
}

TEST(EventsOfAFrame, FingersCountWhereTheyCameDown) {
    const InputEvent fingers{.kind = Kind::fingers};
    EXPECT_EQ(n_of({kMove, fingers, fingers, kMove}), 3u);
    EXPECT_EQ(n_of({fingers, kMove}), 1u);
}

TEST(EventsOfAFrame, DifferentKeysAndButtonsDoNotDisturbEachOther) {
    EXPECT_EQ(n_of({key(true, 65), button(true), key(true, 66), button(true, 1)}), 4u);
    EXPECT_EQ(n_of({key(true, 0), button(true, 0)}), 2u);
}

TEST(EventsOfAFrame, AllMovementsGoIntoOne) {
    EXPECT_EQ(n_of(std::vector<InputEvent>(1000, kMove)), 1000u);
    EXPECT_EQ(n_of({}), 0u);
}

TEST(EventsOfAFrame, AlwaysTakesOneAtLeast) { EXPECT_GE(n_of({button(false), button(true)}), 1u); }

}  // namespace
}  // namespace elastolab
