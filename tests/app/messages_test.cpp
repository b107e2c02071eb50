#include "app/messages.hpp"

#include <gmock/gmock.h>

namespace elastolab {
namespace {

using testing::SizeIs;

TEST(Messages, NotesGoByThemselves) {
    Messages messages;
    messages.note("Saved");
    const double next = messages.expire(100.0);
    EXPECT_GT(next, 0.0);
    EXPECT_THAT(messages.all(), SizeIs(1));
    EXPECT_LT(messages.expire(100.0 + 0.5 * next), next);
    EXPECT_LT(messages.expire(100.0 + next), 0.0);
    EXPECT_THAT(messages.all(), SizeIs(0));
}

TEST(Messages, ErrorsStayUntilTheyAreDismissed) {
    Messages messages;
    messages.error("bad.obj: no triangles.");
    EXPECT_LT(messages.expire(0.0), 0.0);
    EXPECT_LT(messages.expire(1e9), 0.0);
    ASSERT_THAT(messages.all(), SizeIs(1));
    EXPECT_TRUE(messages.all()[0].is_error);
    messages.dismiss(0);
    EXPECT_THAT(messages.all(), SizeIs(0));
}

TEST(Messages, TheSameIsNotSaidTwiceAndTheOldestGiveWay) {
    Messages messages;
    messages.error("a");
    messages.error("a");
    EXPECT_THAT(messages.all(), SizeIs(1));
    for (char c = 'b'; c < 'z'; ++c) messages.note(std::string(1, c));
    EXPECT_LT(messages.all().size(), 10u);
    EXPECT_EQ(messages.all().back().text, "y");
}

}  // namespace
}  // namespace elastolab
