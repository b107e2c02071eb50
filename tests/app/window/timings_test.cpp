#include "app/window/timings.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "base/error.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kHeader =
    "frame,time_s,method,vertices,constrained_vertices,handle_vertices,state,update_ms,upload_ms,draw_ms,gui_ms,frame_"
    "ms";

TEST(FrameHistory, HasNoPercentilesBeforeTheFirstFrame) {
    EXPECT_EQ(FrameHistory().percentile(&FrameTimes::frame_ms, 0.5), 0.0);
    EXPECT_THAT(FrameHistory().series(&FrameTimes::frame_ms), IsEmpty());
}

TEST(FrameHistory, GivesPercentilesOfWhatItKeeps) {
    FrameHistory history;
    for (int i = 101; i-- > 0;) history.add({.update_ms = static_cast<double>(i)});
    EXPECT_EQ(history.percentile(&FrameTimes::update_ms, 0.0), 0.0);
    EXPECT_EQ(history.percentile(&FrameTimes::update_ms, 0.5), 50.0);
    EXPECT_EQ(history.percentile(&FrameTimes::update_ms, 0.95), 95.0);
    EXPECT_EQ(history.percentile(&FrameTimes::update_ms, 1.0), 100.0);
    EXPECT_EQ(history.percentile(&FrameTimes::draw_ms, 1.0), 0.0);
}

TEST(FrameHistory, ForgetsTheOldestFirst) {
    FrameHistory history;
    const auto n = static_cast<int>(FrameHistory::kLength);
    for (int i = 0; i < n + 10; ++i) history.add({.gui_ms = static_cast<double>(i)});
    EXPECT_EQ(history.size(), FrameHistory::kLength);
    const std::vector<float> series = history.series(&FrameTimes::gui_ms);
    EXPECT_EQ(series.front(), 10.0f);
    EXPECT_EQ(series.back(), static_cast<float>(n + 9));
}

TEST(TimingsRecorder, WritesTheHeaderAndARowForEveryFrame) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "t.csv";
    TimingsRecorder recorder(file);
    recorder.add({.frame = 7,
                  .time_s = 1.25,
                  .method = "linear-bem",
                  .vertices = 98,
                  .constrained_vertices = 25,
                  .handle_vertices = 1,
                  .state = "ready",
                  .times = {.update_ms = 0.5, .upload_ms = 0.25, .draw_ms = 2.0, .gui_ms = 1.0, .frame_ms = 4.0}});
    EXPECT_EQ(recorder.n_rows(), 1);
    EXPECT_EQ(recorder.file(), file);
    recorder.finish();
    EXPECT_EQ(test::read_text(file), std::string(kHeader).append("\n7,1.25,linear-bem,98,25,1,ready,0.5,0.25,2,1,4\n"));
}

TEST(TimingsRecorder, TheFileAppearsWhenItIsComplete) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("t.csv", "old");
    {
        TimingsRecorder recorder(file);
        recorder.add({});
        EXPECT_EQ(test::read_text(file), "old");
    }
    EXPECT_NE(test::read_text(file), "old");
    EXPECT_THAT(folder.listing(), ElementsAre("t.csv"));
}

TEST(TimingsRecorder, RefusesAFileThatCannotBeWritten) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(TimingsRecorder(folder.path() / "none" / "t.csv"), Error);
}

}  // namespace
}  // namespace elastolab
