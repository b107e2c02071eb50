// The viewer by its options, in a hidden window.
#include "app/viewer.hpp"

#include <gmock/gmock.h>
#include <stb_image.h>

#include <chrono>
#include <memory>
#include <set>
#include <thread>

#include "app/input/interaction_log.hpp"
#include "app/stage.hpp"
#include "base/error.hpp"
#include "cli/program.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::EndsWith;
using testing::Ge;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kHeader =
    "frame,time_s,method,vertices,constrained_vertices,handle_vertices,state,update_ms,upload_ms,draw_ms,gui_ms,frame_"
    "ms";

struct Picture {
    int width = 0, height = 0;
    std::size_t n_colours = 0;
};

Picture read_picture(const std::filesystem::path& file) {
    Picture picture;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load(file.c_str(), &picture.width, &picture.height, &channels, 3), stbi_image_free);
    if (!pixels) return {};
    std::set<int> colours;
    for (int i = 0; i < picture.width * picture.height; ++i)
        colours.insert(pixels.get()[3 * i] << 16 | pixels.get()[3 * i + 1] << 8 | pixels.get()[3 * i + 2]);
    picture.n_colours = colours.size();
    return picture;
}

/// Lines of a file, and the fields of one.
std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
    return parts;
}

class ViewerTest : public testing::Test {
protected:
    ViewerTest() {
        save_scene(folder.path() / "cube.json", cube_document(4));
        options.input = folder.path() / "cube.json";
        options.hidden = true;
        options.size = Eigen::Vector2i(640, 480);
    }
    /// Fields of the rows of the timings.
    std::vector<std::vector<std::string>> timings() const {
        std::vector<std::string> lines = split(read_text(folder.path() / "t.csv"), '\n');
        EXPECT_EQ(lines.at(0), kHeader);
        std::vector<std::vector<std::string>> rows;
        for (std::size_t i = 1; i < lines.size(); ++i) rows.push_back(split(lines[i], ','));
        return rows;
    }
    static constexpr int kMoves = 8;
    /// A drag in the middle of the body, as --record writes it: so many moves of the cursor, in a small window that had
    /// another size at first.
    void record_drag(const Eigen::Vector2i& first_size = {480, 360}) {
        const Eigen::Vector2d from(340, 180);
        options.size = first_size;
        InteractionRecorder recorder(folder.path() / "drag.log", *options.size);
        double seconds = 0.0;
        const auto add = [&](InputEvent event) {
            recorder.add({.seconds = seconds += 0.25, .events = {event}, .window_size = Eigen::Vector2i(480, 360)});
        };
        using Of = InputEvent::Kind;
        add({.kind = Of::cursor, .cursor = from});
        add({.kind = Of::button, .cursor = from, .pressed = true});
        const Eigen::Vector2d step(3, -1.5);
        for (int i = 1; i <= kMoves; ++i) add({.kind = Of::cursor, .cursor = from + i * step});
        add({.kind = Of::button, .cursor = from + kMoves * step});
        recorder.finish();
        options.replay = folder.path() / "drag.log";
    }
    const TemporaryFolder folder;
    ViewerOptions options;
};

TEST_F(ViewerTest, WritesARowForEachOfTheFramesAskedFor) {
    for (const int n : {1, 2, 7}) {
        options.n_frames = n;
        options.timings = folder.path() / "t.csv";
        run_viewer(options);
        const auto rows = timings();
        ASSERT_EQ(std::ssize(rows), n);
        EXPECT_THAT(rows, Each(SizeIs(12)));
        EXPECT_EQ(rows.back()[0], std::to_string(n - 1));
        EXPECT_EQ(rows.back()[3], "98");
        EXPECT_TRUE(n == 1 || rows.back()[6] == "ready");
    }
}

TEST_F(ViewerTest, WakesAndEndsWhenItIsCancelled) {
    options.scene_out = folder.path() / "out.json";
    options.record = folder.path() / "r.log";
    Control control;
    std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(500));  // by then it sleeps: nothing moves
        control.cancel();
        wake_viewer();
    });
    EXPECT_THROW(run_viewer(options, control), Cancelled);
    other.join();
    EXPECT_FALSE(exists(options.scene_out));
    EXPECT_TRUE(exists(options.record));
}

TEST_F(ViewerTest, TakesAPictureOfTheLastFrame) {
    options.n_frames = 4;
    options.screenshot = folder.path() / "p.png";
    run_viewer(options);
    const Picture picture = read_picture(options.screenshot);
    EXPECT_EQ(picture.width, 640);
    EXPECT_EQ(picture.height, 480);
    EXPECT_GT(picture.n_colours, 100u);
}

TEST_F(ViewerTest, DrawsInWindowsOfEverySize) {
    for (const Eigen::Vector2i& size : {Eigen::Vector2i(1, 1), Eigen::Vector2i(50, 1100), Eigen::Vector2i(1800, 30)}) {
        options.size = size;
        options.n_frames = 4;
        options.screenshot = folder.path() / "p.png";
        run_viewer(options);
        const Picture picture = read_picture(options.screenshot);
        EXPECT_EQ(picture.width, size.x());
        EXPECT_EQ(picture.height, size.y());
    }
}

TEST_F(ViewerTest, AReplayedDragEndsAtTheSameHandleForEveryMethod) {
    record_drag();
    options.timings = folder.path() / "t.csv";
    options.scene_out = folder.path() / "out.json";
    options.mesh_out = folder.path() / "out.obj";
    std::vector<Handle> handles;
    for (const MethodKind kind : all_methods()) {
        options.asked.method = kind;
        run_viewer(options);
        const auto rows = timings();
        EXPECT_GE(std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row[6] == "ready"; }), kMoves);
        for (const auto& row : rows) EXPECT_EQ(row[2], name(kind));
        const Document left = load_scene(options.scene_out);
        EXPECT_EQ(left.method, kind);
        ASSERT_THAT(left.handles, SizeIs(1));
        handles.push_back(left.handles[0]);
        EXPECT_EQ(handles.back(), handles.front());
        EXPECT_TRUE(std::filesystem::exists(options.mesh_out));
    }
    EXPECT_GT(std::get<AffineMotion>(handles[0].motion).translate.norm(), 0.01);
}

/// The view belongs to what is below the fingers when they come down, although a slow frame sees only where they end.
TEST_F(ViewerTest, FingersKeepTheViewWhenTheyLeaveIt) {
    const Eigen::Vector2d from(400, 240), beyond(400, 474);  // on the status bar
    options.scene_out = folder.path() / "out.json";
    std::vector<ViewPoint> views;
    for (const bool at_once : {false, true}) {
        std::vector<InputEvent> events = {{.kind = InputEvent::Kind::cursor, .cursor = from}};
        for (int i = 0; i < 10; ++i)
            events.push_back({.kind = InputEvent::Kind::fingers,
                              .cursor = from + 0.1 * (i + 1) * (beyond - from),
                              .from = from + 0.1 * i * (beyond - from),
                              .code = 3});
        options.replay = folder.path() / "fingers.log";
        InteractionRecorder recorder(options.replay, {640, 480});
        double seconds = 0.0;
        if (at_once) recorder.add({.seconds = 0.25, .events = events});
        for (std::size_t i = 0; !at_once && i < events.size(); ++i)
            recorder.add({.seconds = seconds += 0.25, .events = {events[i]}});
        recorder.finish();
        run_viewer(options);
        const Document left = load_scene(options.scene_out);
        ASSERT_TRUE(left.camera);
        views.push_back(*left.camera);
    }
    EXPECT_GT((views[0].eye - views[0].target).normalized().z(), 0.9) << "seen from above";
    EXPECT_LT((views[0].eye - views[1].eye).norm(), 1e-9);
}

TEST_F(ViewerTest, AReplayIsRecordedAgainAsItWas) {
    record_drag();
    options.record = folder.path() / "again.log";
    options.timings = folder.path() / "t.csv";
    options.screenshot = folder.path() / "p.png";
    run_viewer(options);
    const InteractionLog first = load_interaction(options.replay), again = load_interaction(options.record);
    ASSERT_EQ(again.frames.size(), first.frames.size());
    for (std::size_t i = 0; i < first.frames.size(); ++i)
        EXPECT_EQ(again.frames[i].events.front().cursor, first.frames[i].events.front().cursor);
    EXPECT_GT(read_picture(options.screenshot).n_colours, 100u);
}

/// Its places are in a window of the size that it had then.
TEST_F(ViewerTest, AReplayHasTheSizesThatTheWindowHad) {
    options.scene_out = folder.path() / "out.json";
    std::vector<double> moved;
    for (const Eigen::Vector2i& first : {Eigen::Vector2i(480, 360), Eigen::Vector2i(1000, 700)}) {
        record_drag(first);
        options.size.reset();
        run_viewer(options);
        const Document left = load_scene(options.scene_out);
        ASSERT_EQ(left.handles.size(), 1u);
        moved.push_back(std::get<AffineMotion>(left.handles[0].motion).translate.norm());
    }
    EXPECT_GT(moved[0], 0.0);
    EXPECT_NEAR(moved[1], moved[0], 0.3 * moved[0]) << "the camera has another distance";
}

TEST_F(ViewerTest, AReplayedDragBecomesASeriesForParaView) {
    record_drag();
    options.series = folder.path() / "drag.pvd";
    options.mesh_out = folder.path() / "out.vtp";
    run_viewer(options);
    const std::vector<std::string> lines = split(read_text(options.series), '\n');
    std::vector<std::string> steps;
    for (const std::string& line : lines)
        if (line.find("<DataSet") != std::string::npos) steps.push_back(line);
    ASSERT_GE(steps.size(), 6u) << "after each move of the cursor";
    EXPECT_THAT(steps[0], HasSubstr("timestep=\"0\" part=\"0\" file=\"drag-0000.vtp\""));
    std::string last = std::to_string(steps.size() - 1);
    last = "drag-" + std::string(4 - last.size(), '0') + last + ".vtp";
    EXPECT_THAT(steps.back(), HasSubstr("file=\"" + last + "\""));
    EXPECT_EQ(read_text(folder.path() / last), read_text(options.mesh_out));
    EXPECT_NE(read_text(folder.path() / "drag-0001.vtp"), read_text(options.mesh_out));
}

TEST_F(ViewerTest, ABadFileIsAnErrorWhereNobodyWatches) {
    options.n_frames = 2;
    options.input = folder.write("bad.obj", "f 1 2 3\n");
    EXPECT_THROW(run_viewer(options), MeshError);
    options.input = folder.write("bad.json", "{}");
    EXPECT_THROW(run_viewer(options), SceneError);
    options.input.clear();
    options.replay = folder.write("bad.log", "");
    EXPECT_THROW(run_viewer(options), SceneError);
    options.replay.clear();
    for (std::filesystem::path ViewerOptions::*output :
         {&ViewerOptions::screenshot, &ViewerOptions::timings, &ViewerOptions::record, &ViewerOptions::scene_out,
          &ViewerOptions::mesh_out}) {
        ViewerOptions bad = options;
        bad.*output = folder.path() / "none" / "out.obj";
        EXPECT_THROW(run_viewer(bad), Error);
    }
}

TEST_F(ViewerTest, TheProgramEndsWithOneLineAndItsCode) {
    folder.write("bad.obj", "f 1 2 3\n");
    const ProgramRun bad = run_program({"view", "bad.obj", "--hidden", "--frames", "2"}, folder.path());
    EXPECT_EQ(bad.exit_code, 1);
    EXPECT_THAT(split(bad.err, '\n'), SizeIs(1));
    EXPECT_THAT(bad.err, AllOf(HasSubstr("bad.obj"), EndsWith("\n")));
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--hidden"},
                                                  {"--frames", "0"},
                                                  {"--size", "12"},
                                                  {"--size", "0x5"},
                                                  {"--method", "x"},
                                                  {"--mesh-out", "a.txt", "--frames", "1"}}) {
        std::vector<std::string> arguments = {"view"};
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run_program(arguments, folder.path()).exit_code, 2) << wrong.back();
    }
    EXPECT_EQ(folder.listing(), (std::vector<std::string>{"bad.obj", "cube.json"}));
}

}  // namespace
}  // namespace elastolab::test
