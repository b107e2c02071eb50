// The real program in a real window: what must not make it crash, hang or work for nothing.
#include <gmock/gmock.h>

#include <chrono>
#include <iostream>
#include <set>
#include <thread>

#include "app/pixels.hpp"
#include "app/real_window.hpp"
#include "app/stage.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

using testing::IsEmpty;
using testing::UnorderedElementsAre;

using namespace std::chrono_literals;

constexpr double kIdleShare = 0.05;  // of a core; a quiet machine shows below 0.01

class RealProgram : public testing::Test {
protected:
    std::filesystem::path save_cube(int cells) {
        save_scene(folder.path() / "cube.json", cube_document(cells));
        return "cube.json";
    }
    void expect_good_end(RealWindow& window) {
        const ProgramRun run = window.quit();
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_THAT(run.err, IsEmpty());
    }
    const TemporaryFolder folder;
};

/// The methods of a timings file.
std::set<std::string> methods_in(const std::filesystem::path& file) {
    std::set<std::string> methods;
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream fields(line);
        for (int i = 0; i < 3; ++i) std::getline(fields, line, ',');
        methods.insert(line);
    }
    return methods;
}

/// The part of a picture of 160 x 120 pixels that is not as its corner.
double drawn_share(const std::filesystem::path& file) {
    const Pixels pixels(file);
    int drawn = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) drawn += pixels.at({x, y}) != pixels.at({0, 0});
    return drawn / (160.0 * 120.0);
}

TEST_F(RealProgram, MethodsSwitchWhileTheyArePrecomputed) {
    RealWindow window(
        {save_cube(8), "--method", "linear-bem", "--timings", "t.csv", "--scene-out", "out.json", "--size", "640x480"},
        folder.path());
    for (const char* key : {"2", "1", "3", "2", "1"}) {
        window.key(key);
        std::this_thread::sleep_for(50ms);
    }
    window.settle();
    expect_good_end(window);
    EXPECT_THAT(methods_in(folder.path() / "t.csv"), UnorderedElementsAre("fem", "constant-bem", "linear-bem"));
}

TEST_F(RealProgram, ClosesDuringAPrecomputation) {
    for (const char* method : {"linear-bem", "fem"}) {
        RealWindow window({save_cube(29), "--method", method, "--size", "640x480"}, folder.path());
        std::this_thread::sleep_for(500ms);
        expect_good_end(window);
    }
}

TEST_F(RealProgram, ABadFileLeavesTheWindowAndItsSceneAlone) {
    folder.write("bad.obj", "f 1 2 3\n");
    RealWindow window({"bad.obj", "--scene-out", "out.json"}, folder.path());
    std::this_thread::sleep_for(1s);
    EXPECT_FALSE(window.ended());
    window.key("Escape");
    expect_good_end(window);
    EXPECT_EQ(load_scene(folder.path() / "out.json"), default_document());
}

TEST_F(RealProgram, SurvivesEverySizeOfItsWindow) {
    RealWindow window({save_cube(4), "--timings", "t.csv", "--size", "640x480"}, folder.path());
    window.settle();
    for (const auto& [width, height] :
         {std::pair(1, 1), std::pair(50, 1100), std::pair(1900, 20), std::pair(330, 60)}) {
        window.resize(width, height);
        window.settle();
        window.key("c");  // side by side and back
        window.settle();
    }
    window.resize(1000, 700);
    window.settle();
    expect_good_end(window);
}

TEST_F(RealProgram, KeysOpenAndCloseHelpAndDialogs) {
    RealWindow window({save_cube(2), "--size", "640x480"}, folder.path());
    window.settle();
    for (const char* key :
         {"F1", "Escape", "ctrl+o", "Escape", "ctrl+s", "Escape", "question", "F1", "g", "c", "w", "t"}) {
        window.key(key);
        window.settle();
    }
    expect_good_end(window);
}

TEST_F(RealProgram, SavesTheSceneFromItsDialog) {
    RealWindow window({save_cube(2), "--size", "640x480"}, folder.path());
    window.settle();
    window.key("ctrl+s");
    window.settle();
    const std::string file = (folder.path() / "typed.json").string();
    window.type(file);
    window.settle();
    expect_good_end(window);
    EXPECT_TRUE(std::filesystem::exists(file));
}

TEST_F(RealProgram, UndoesAndRedoesADrag) {
    RealWindow window({save_cube(4), "--size", "640x480", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.drag({430, 240}, {465, 210});  // the middle of the body
    window.settle();
    for (const char* key : {"ctrl+z", "ctrl+y", "ctrl+z"}) {
        window.key(key);
        window.settle();
    }
    expect_good_end(window);
    EXPECT_EQ(load_scene(folder.path() / "out.json"), cube_document(4));
}

TEST_F(RealProgram, FilmsThePullFromRestAndBack) {
    folder.write("pulled.json", R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 3},
        "fixed": {"box": {"min": [0, 0, 0], "max": [0, 1, 1]}},
        "handles": [{"select": {"box": {"min": [1, 0, 0], "max": [1, 1, 1]}}, "translate": [0.3, 0.2, 0]}]})");
    const ProgramRun run =
        run_program({"view", "pulled.json", "--hidden", "--frames", "2", "--picture", "film.png", "--picture-size",
                     "160x120", "--field", "displacement", "--legend", "--pull-film", "4"},
                    folder.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const ProgramRun without =
        run_program({"view", "pulled.json", "--hidden", "--frames", "2", "--picture", "plain.png", "--picture-size",
                     "160x120", "--field", "displacement", "--pull-film", "2"},
                    folder.path());
    EXPECT_EQ(without.exit_code, 0) << without.err;
    const auto bytes_of = [&](const std::string& file) {
        std::ifstream in(folder.path() / file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    };
    std::vector<std::string> frames;
    for (int frame = 1; frame <= 4; ++frame) {
        frames.push_back(bytes_of("film-000" + std::to_string(frame) + ".png"));
        EXPECT_GT(frames.back().size(), 100u) << frame;
    }
    EXPECT_NE(frames[0], bytes_of("plain-0001.png")) << "the legend";
    EXPECT_EQ(frames[1], frames[3]) << "as far on the way back as on the way out";
    EXPECT_NE(frames[0], frames[1]);
    EXPECT_NE(frames[1], frames[2]);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "film-0005.png"));
}

/// By a full turn the face comes to where it was: what is seen of it is the way there.
TEST_F(RealProgram, FilmsAFullTurnThroughAllItsAngles) {
    Document document = cube_document_with_handle(3);
    document.handles[0].motion = AffineMotion{.rotate = {.axis = {1, 0, 0}, .degrees = 360, .center = {1, 0.5, 0.5}}};
    document.handles.push_back({.name = "pressed",
                                .select = {BoxSelector{{0.3, 0.3, 0.9}, {0.7, 0.7, 1.1}}},
                                .motion = AffineMotion{},
                                .force = GripForce{{0, 0, -1e-3}}});
    save_scene(folder.path() / "turned.json", document);
    const ProgramRun run = run_program({"view", "turned.json", "--hidden", "--frames", "2", "--picture", "film.png",
                                        "--picture-size", "160x120", "--pull-film", "8", "--scene-out", "out.json"},
                                       folder.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto frame = [&](int number) {
        std::ifstream in(folder.path() / ("film-000" + std::to_string(number) + ".png"), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    };
    EXPECT_EQ(frame(1), frame(5)) << "the whole turn";
    EXPECT_NE(frame(1), frame(3)) << "half of it";
    EXPECT_NE(frame(2), frame(3));
    EXPECT_EQ(frame(3), frame(7));
    const Document out = load_scene(folder.path() / "out.json");
    EXPECT_EQ(out.handles[0], document.handles[0]) << "the handle was not put back";
    EXPECT_EQ(out.handles[1].force, document.handles[1].force) << "the force was lost";
}

/// Colours and legend of all frames are of one range, and at the first nothing acts yet.
TEST_F(RealProgram, FilmsLoadsFromRestUnderOneLegend) {
    const auto film = [&](Document document, const std::string& name, const std::vector<std::string>& more) {
        save_scene(folder.path() / (name + ".json"), document);
        std::vector<std::string> words = {"view",      name + ".json", "--hidden",       "--frames", "2",
                                          "--picture", name + ".png",  "--picture-size", "320x240",  "--pull-film",
                                          "4",         "--scene-out",  "out.json"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun run = run_program(words, folder.path());
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return load_scene(folder.path() / "out.json");
    };
    Document document = cube_document_with_handle(3);
    document.handles[0].motion = AffineMotion{.rotate = {.axis = {1, 0, 0}, .degrees = 90, .center = {1, 0.5, 0.5}}};
    document.material.young_modulus = 1.0;
    document.gravity = Eigen::Vector3d(0, 0, -0.1);
    document.loads = {
        {.name = "side", .select = {BoxSelector{{-0.1, -0.1, 0.9}, {0.8, 1.1, 1.1}}}, .value = PressureLoad{0.1}}};
    document.camera = film(document, "loaded", {}).camera;  // else that of the deformed body
    const Document out = film(document, "loaded", {});
    EXPECT_EQ(out.gravity, document.gravity);
    EXPECT_EQ(out.loads, document.loads);
    EXPECT_EQ(out.handles[0], document.handles[0]);
    Document heavier = document;
    *heavier.gravity *= 3.0;
    heavier.loads[0].value = PressureLoad{0.3};
    film(heavier, "heavier", {});
    film(document, "coloured", {"--field", "displacement", "--legend"});
    const auto pixels = [&](const std::string& file) { return Pixels(folder.path() / file); };
    constexpr int kRounded = 40;  // of a pixel at an edge
    const auto differ = [](const Pixels& one, const Pixels& other, int from_x, int from_y) {
        int n = 0;
        for (int x = from_x; x < 320; ++x)
            for (int y = from_y; y < 240; ++y)
                n += (one.at({x, y}) - other.at({x, y})).cwiseAbs().maxCoeff() > kRounded;
        return n;
    };
    EXPECT_EQ(differ(pixels("loaded-0001.png"), pixels("heavier-0001.png"), 0, 0), 0) << "at rest nothing acts";
    EXPECT_GT(differ(pixels("loaded-0003.png"), pixels("heavier-0003.png"), 0, 0), 100);
    constexpr int kLegendX = 270, kLegendY = 100;
    EXPECT_EQ(differ(pixels("coloured-0001.png"), pixels("coloured-0003.png"), kLegendX, kLegendY), 0);
    EXPECT_GT(differ(pixels("coloured-0001.png"), pixels("coloured-0003.png"), 0, 0), 100);
}

TEST_F(RealProgram, CutsTheBodyOpenFromTheStart) {
    const auto drawn_part = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"view",      save_cube(3), "--hidden",       "--frames", "2",
                                          "--picture", "cut.png",    "--picture-size", "160x120",  "--transparent"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun run = run_program(words, folder.path());
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return drawn_share(folder.path() / "cut.png");
    };
    const double whole = drawn_part({});
    for (const char* axis : {"x", "y", "z"}) {
        const double half = drawn_part({"--cut", axis, "--field", "von-mises"});
        EXPECT_LT(half, 0.95 * whole) << axis;
        EXPECT_GT(half, 0.3 * whole) << axis;
    }
}

TEST_F(RealProgram, AnIdleWindowUsesNoProcessor) {
    RealWindow window({save_cube(5)}, folder.path());
    window.settle();
    std::this_thread::sleep_for(1s);  // until the picture of a body at rest is due, with all detail
    window.settle();
    constexpr double kSeconds = 5.0;
    const double before = window.processor_seconds();
    std::this_thread::sleep_for(std::chrono::duration<double>(kSeconds));
    const double share = (window.processor_seconds() - before) / kSeconds;
    std::cout << "idle: " << 100.0 * share << " % of a core\n";
    EXPECT_LT(share, kIdleShare);
}

}  // namespace
}  // namespace elastolab::test
