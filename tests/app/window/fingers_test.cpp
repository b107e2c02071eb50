#include "app/window/fingers.hpp"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace elastolab::test {
namespace {

using Kind = InputEvent::Kind;
using Eigen::Vector2d;

std::vector<InputEvent> of_kind(Kind kind, const std::vector<InputEvent>& events) {
    std::vector<InputEvent> result;
    for (const InputEvent& event : events)
        if (event.kind == kind) result.push_back(event);
    return result;
}

TEST(Fingers, OneThatMovesDragsFromWhereItBegan) {
    Fingers fingers;
    fingers.begin(7, {100, 200}, 0.0);
    EXPECT_TRUE(of_kind(Kind::button, fingers.take()).empty()) << "another may follow";
    fingers.move(7, {103, 200});
    EXPECT_TRUE(fingers.take().empty()) << "no finger rests to the pixel";
    fingers.move(7, {110, 200});
    const std::vector<InputEvent> begun = fingers.take();
    ASSERT_EQ(begun.size(), 2u);
    EXPECT_EQ(begun[0].kind, Kind::button);
    EXPECT_TRUE(begun[0].pressed);
    EXPECT_EQ(begun[0].code, GLFW_MOUSE_BUTTON_LEFT);
    EXPECT_EQ(begun[0].cursor, Vector2d(100, 200));
    EXPECT_EQ(begun[1].cursor, Vector2d(110, 200));
    fingers.begin(8, {500, 500}, 1.0);
    fingers.move(8, {600, 500});
    EXPECT_TRUE(fingers.take().empty()) << "one that comes later changes nothing";
    fingers.end(7, 2.0);
    const std::vector<InputEvent> ended = fingers.take();
    ASSERT_EQ(ended.size(), 1u);
    EXPECT_EQ(ended[0].kind, Kind::button);
    EXPECT_FALSE(ended[0].pressed);
    EXPECT_EQ(ended[0].cursor, Vector2d(110, 200));
    fingers.end(8, 2.1);
    const std::vector<InputEvent> left = fingers.take();
    ASSERT_EQ(left.size(), 1u);
    EXPECT_LT(left[0].cursor.x(), -1e5) << "no finger points at anything";
}

TEST(Fingers, OneThatRestsPressesWhenNoOtherFollows) {
    Fingers fingers;
    EXPECT_LT(fingers.due_in(0.0), 0.0);
    fingers.begin(1, {10, 20}, 5.0);
    const double due = fingers.due_in(5.0);
    EXPECT_GT(due, 0.01);
    EXPECT_LT(due, 0.15) << "a press must answer at once";
    fingers.advance(5.0 + 0.5 * due);
    EXPECT_TRUE(of_kind(Kind::button, fingers.take()).empty());
    fingers.advance(5.0 + due);
    EXPECT_EQ(of_kind(Kind::button, fingers.take()).size(), 1u);
    EXPECT_LT(fingers.due_in(5.0 + due), 0.0);
}

TEST(Fingers, TwoTapsAtNearlyTheSamePlaceAreADoubleClick) {
    Fingers fingers;
    std::vector<Vector2d> presses;
    const auto tap = [&](const Vector2d& at, double now) {
        fingers.begin(1, at, now);
        fingers.end(1, now + 0.02);
        const std::vector<InputEvent> buttons = of_kind(Kind::button, fingers.take());
        EXPECT_EQ(buttons.size(), 2u);
        presses.push_back(buttons.at(0).cursor);
    };
    tap({100, 100}, 0.0);
    tap({112, 95}, 0.2);
    EXPECT_EQ(presses[1], presses[0]);
    tap({112, 95}, 1.0);
    tap({150, 95}, 1.2);
    EXPECT_EQ(presses[2], Vector2d(112, 95)) << "long after it";
    EXPECT_EQ(presses[3], Vector2d(150, 95)) << "far from it";
}

TEST(Fingers, TwoMoveAndZoomAndPressNothing) {
    Fingers fingers;
    fingers.begin(1, {100, 100}, 0.0);
    fingers.begin(2, {200, 100}, 0.05);
    fingers.advance(1.0);
    fingers.move(2, {300, 100});
    fingers.move(1, {100, 300});
    const std::vector<InputEvent> events = fingers.take();
    EXPECT_TRUE(of_kind(Kind::button, events).empty());
    const std::vector<InputEvent> moves = of_kind(Kind::fingers, events);
    ASSERT_EQ(moves.size(), 2u);
    EXPECT_EQ(moves[0].code, 2);
    EXPECT_EQ(moves[0].from, Vector2d(150, 100));
    EXPECT_EQ(moves[0].cursor, Vector2d(200, 100));
    EXPECT_DOUBLE_EQ(moves[0].zoom, 2.0);
    EXPECT_EQ(moves[1].from, Vector2d(200, 100));
    EXPECT_EQ(moves[1].cursor, Vector2d(200, 200));
    EXPECT_DOUBLE_EQ(moves[1].zoom, std::sqrt(2.0));
    fingers.end(1, 2.0);
    fingers.move(2, {500, 500});
    EXPECT_TRUE(fingers.take().empty()) << "the last of two that are lifted drags nothing";
    fingers.end(2, 2.1);
    fingers.begin(3, {10, 10}, 3.0);
    fingers.end(3, 3.05);
    EXPECT_EQ(of_kind(Kind::button, fingers.take()).size(), 2u) << "and then all is as before";
}

TEST(Fingers, AThirdOneDoesNotMakeTheViewJump) {
    Fingers fingers;
    fingers.begin(1, {100, 100}, 0.0);
    fingers.begin(2, {200, 100}, 0.01);
    fingers.begin(3, {300, 400}, 0.02);
    fingers.move(3, {303, 406});
    const std::vector<InputEvent> moves = of_kind(Kind::fingers, fingers.take());
    ASSERT_EQ(moves.size(), 1u);
    EXPECT_EQ(moves[0].code, 3);
    EXPECT_LT((moves[0].cursor - moves[0].from - Vector2d(1, 2)).norm(), 1e-12);
}

TEST(Fingers, ThatAreAtOnePlaceDoNotZoom) {
    Fingers fingers;
    fingers.begin(1, {100, 100}, 0.0);
    fingers.begin(2, {100, 100}, 0.01);
    fingers.move(2, {101, 100});
    fingers.move(2, {160, 100});
    for (const InputEvent& event : of_kind(Kind::fingers, fingers.take())) EXPECT_EQ(event.zoom, 1.0);
}

TEST(Fingers, ThatAreNotKnownMeanNothing) {
    Fingers fingers;
    fingers.move(9, {1, 1});
    fingers.end(9, 0.0);
    EXPECT_TRUE(fingers.take().empty());
}

}  // namespace
}  // namespace elastolab::test
