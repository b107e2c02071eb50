#include "app/window/start_timeline.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "base/error.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab::test {
namespace {

TEST(StartTimeline, WritesEveryEventOnceWhenItHappens) {
    const TemporaryFolder folder;
    StartTimeline timeline(folder.path() / "start.csv");
    for (const StartTimeline::Event event : {StartTimeline::window, StartTimeline::answer, StartTimeline::window})
        timeline.mark(event);
    std::ifstream file(folder.path() / "start.csv");
    std::string heading, first, second, more;
    std::getline(file, heading);
    std::getline(file, first);
    std::getline(file, second);
    EXPECT_EQ(heading, "event,seconds");
    EXPECT_EQ(first.substr(0, 7), "window,");
    EXPECT_EQ(second.substr(0, 7), "answer,");
    EXPECT_FALSE(std::getline(file, more)) << more;
    EXPECT_LE(std::stod(first.substr(7)), std::stod(second.substr(7)));
    EXPECT_GT(std::stod(first.substr(7)), 0.0);
}

TEST(StartTimeline, RefusesAFileThatCannotBeWritten) { EXPECT_THROW(StartTimeline("/no/such/folder/x.csv"), Error); }

}  // namespace
}  // namespace elastolab::test
