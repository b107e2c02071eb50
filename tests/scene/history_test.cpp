#include "scene/live/history.hpp"

#include <gtest/gtest.h>

namespace elastolab {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20;

/// So many vertices held, and a step that differs from all others.
Document document(int n_held, int step) {
    Document result;
    result.fixed = {{.select = {VertexSelector{std::vector<int>(static_cast<std::size_t>(n_held), step)}}}};
    return result;
}

TEST(History, ManyLargeStepsStayWithinTheirBytesAndTheNewestAreKept) {
    History history(document(50000, 0), kMegabyte);  // 200 kB each
    for (int step = 1; step <= 100; ++step) history.commit(document(50000, step));
    EXPECT_LE(history.bytes(), kMegabyte);
    for (int step = 99; step >= 96; --step) {
        ASSERT_TRUE(history.can_undo());
        EXPECT_EQ(history.undo(), document(50000, step));
    }
    EXPECT_EQ(history.redo(), document(50000, 97));
}

TEST(History, OneStepCanBeTakenBackHoweverLarge) {
    History history(document(10, 0), 1);
    for (int step = 1; step <= 3; ++step) history.commit(document(50000, step));
    ASSERT_TRUE(history.can_undo());
    EXPECT_EQ(history.undo(), document(50000, 2));
    EXPECT_FALSE(history.can_undo());
}

TEST(History, SmallStepsAreForgottenAfterAThousand) {
    History history(document(1, 0));
    for (int step = 1; step <= 3000; ++step) history.commit(document(1, step));
    int n = 0;
    while (history.can_undo()) {
        history.undo();
        ++n;
    }
    EXPECT_EQ(n, 999);
}

TEST(History, DisplacementsOfVerticesCount) {
    Document moved = document(10, 0);
    moved.handles.push_back({.name = "a",
                             .select = {VertexSelector{std::vector<int>(1000, 1)}},
                             .motion = VertexMotion{std::vector<Eigen::Vector3d>(1000)}});
    EXPECT_GE(bytes_of(moved), bytes_of(document(10, 0)) + 1000 * (4 + 24));
}

}  // namespace
}  // namespace elastolab
