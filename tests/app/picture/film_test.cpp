#include "app/picture/film.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "base/error.hpp"
#include "base/program.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

/// $PATH with this folder in front, or nothing else, until the end of a test.
class SearchPath {
public:
    explicit SearchPath(const std::string& path) : before_(std::getenv("PATH")) { setenv("PATH", path.c_str(), 1); }
    ~SearchPath() { setenv("PATH", before_.c_str(), 1); }
    SearchPath(const SearchPath&) = delete;
    SearchPath& operator=(const SearchPath&) = delete;

private:
    std::string before_;
};

/// A script in the place of ffmpeg.
void make_ffmpeg(const TemporaryFolder& folder, const std::string& script) {
    const auto file = folder.write("ffmpeg", "#!/bin/sh\n" + script);
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

TEST(Film, NumbersItsFramesFromOne) {
    EXPECT_EQ(frame_file("a/b.turn.png", 1), "a/b.turn-0001.png");
    EXPECT_EQ(frame_file("x.png", 120), "x-0120.png");
}

TEST(Film, TurnsOnceAboutTheUpAxisAndKeepsWhatItLooksAt) {
    Camera camera;
    camera.set_up_axis(Eigen::Vector3d::UnitY());
    camera.set_view(ViewDirection::isometric);
    const CameraPose pose = camera.pose();
    EXPECT_LT(turned(camera, pose, 1.0).orientation.angularDistance(pose.orientation), 1e-7);
    Camera half = camera;
    half.set_pose(turned(camera, pose, 0.5));
    const Eigen::Vector3d before = camera.eye() - pose.target, after = half.eye() - pose.target;
    EXPECT_LT((after - Eigen::Vector3d(-before.x(), before.y(), -before.z())).norm(), 1e-12);
}

TEST(Film, OfAPullGoesThereAndBack) {
    EXPECT_EQ(pulled_part(1, 60), 0.0);
    EXPECT_EQ(pulled_part(31, 60), 1.0);
    for (int frame = 2; frame <= 60; ++frame) {
        EXPECT_NEAR(pulled_part(frame, 60), pulled_part(62 - frame, 60), 1e-12);
        EXPECT_LT(std::abs(pulled_part(frame, 60) - pulled_part(frame - 1, 60)), 0.06);  // no jump, also at its end
    }
}

TEST(Film, AVideoIsMadeOfItsFramesAndTakesItsPlaceWhole) {
    const TemporaryFolder folder;
    make_ffmpeg(folder, "echo \"$@\" > " + (folder.path() / "said").string() + "; for last; do :; done\n" +
                            "echo video > \"${last#file:}\"\n");
    const SearchPath path(folder.path().string() + ":/usr/bin:/bin");
    EXPECT_EQ(video_obstacle(), "");
    Control control;
    EXPECT_EQ(make_video(folder.path() / "50%.png", control), folder.path() / "50%.mp4");
    std::ifstream said(folder.path() / "said");
    std::stringstream words;
    words << said.rdbuf();
    EXPECT_THAT(words.str(), HasSubstr((folder.path() / "50%%-%04d.png").string()));
    EXPECT_THAT(folder.listing(), ElementsAre("50%.mp4", "ffmpeg", "said"));
}

TEST(Film, AFailedVideoTellsWhyAndLeavesNothing) {
    const TemporaryFolder folder;
    make_ffmpeg(folder, "echo begun; echo 'Unknown encoder' >&2; exit 3\n");
    const SearchPath path(folder.path().string() + ":/usr/bin:/bin");
    Control control;
    try {
        make_video(folder.path() / "turn.png", control);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("turn.mp4: ffmpeg could not make it (Unknown encoder)"));
    }
    EXPECT_THAT(folder.listing(), ElementsAre("ffmpeg"));
}

TEST(Film, WithoutFfmpegSaysSo) {
    const TemporaryFolder folder;
    const SearchPath path(folder.path().string());
    EXPECT_THAT(video_obstacle(), HasSubstr("is not installed"));
    Control control;
    EXPECT_THROW(make_video(folder.path() / "turn.png", control), Error);
}

TEST(Film, ACancelEndsAVideoThatHangs) {
    const TemporaryFolder folder;
    make_ffmpeg(folder, "exec sleep 600\n");
    const SearchPath path(folder.path().string() + ":/usr/bin:/bin");
    Control control;
    control.cancel();
    EXPECT_THROW(make_video(folder.path() / "turn.png", control), Cancelled);
}

}  // namespace
}  // namespace elastolab
