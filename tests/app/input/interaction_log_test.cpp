#include "app/input/interaction_log.hpp"

#include <gmock/gmock.h>

#include "base/error.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Kind = InputEvent::Kind;

const LoggedFrame kFirst{
    .seconds = 0.5,
    .events = {{.kind = Kind::cursor, .cursor = {10.25, 1.0 / 3.0}, .seconds = 0.5},
               {.kind = Kind::button, .cursor = {10.25, 1.0 / 3.0}, .pressed = true, .seconds = 0.5},
               {.kind = Kind::scroll, .cursor = {0, -1}, .seconds = 0.5}}};
const LoggedFrame kSecond{
    .seconds = 0.75,
    .events = {{.kind = Kind::key, .code = 88, .pressed = true, .repeated = true, .modifiers = 3, .seconds = 0.75},
               {.kind = Kind::text, .code = 0x20ac, .seconds = 0.75},
               {.kind = Kind::focus, .code = 1, .seconds = 0.75},
               {.kind = Kind::fingers, .cursor = {5, 6}, .from = {4, 7}, .zoom = 1.1, .code = 2, .seconds = 0.75}}};

TEST(InteractionLog, ComesBackAsItWasRecorded) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "drag.log";
    InteractionRecorder recorder(file, {800, 600});
    recorder.add(kFirst);
    recorder.add(kSecond);
    recorder.finish();
    const InteractionLog log = load_interaction(file);
    EXPECT_EQ(log.window_size, Eigen::Vector2i(800, 600));
    ASSERT_EQ(log.frames.size(), 2u);
    EXPECT_EQ(log.frames[0].events, kFirst.events);
    EXPECT_EQ(log.frames[1].events, kSecond.events);
    EXPECT_EQ(log.frames[1].seconds, kSecond.seconds);
}

TEST(InteractionLog, KnowsWhenTheWindowBecameAnotherSize) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "drag.log";
    InteractionRecorder recorder(file, {800, 600});
    for (const Eigen::Vector2i& size :
         {Eigen::Vector2i(800, 600), Eigen::Vector2i(640, 600), Eigen::Vector2i(640, 600)})
        recorder.add({kFirst.seconds, kFirst.events, size});
    recorder.finish();
    const InteractionLog log = load_interaction(file);
    ASSERT_EQ(log.frames.size(), 3u);
    EXPECT_FALSE(log.frames[0].window_size);
    EXPECT_EQ(log.frames[1].window_size, Eigen::Vector2i(640, 600));
    EXPECT_FALSE(log.frames[2].window_size);
}

TEST(InteractionLog, IsThereOnlyWhenItIsComplete) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "drag.log";
    {
        InteractionRecorder recorder(file, {800, 600});
        EXPECT_FALSE(std::filesystem::exists(file));
    }
    EXPECT_TRUE(load_interaction(file).frames.empty());
}

/// What load_interaction says of a file of this text.
std::string complaint(const std::string& text) {
    const TemporaryFolder folder;
    try {
        load_interaction(folder.write("bad.log", text));
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no complaint";
}

const std::string kHeader = R"({"elastolab_interaction":1,"window":[800,600]})";

TEST(InteractionLog, ErrorsNameFileLineFindingAndAWayForwardInOneLine) {
    const std::vector<std::pair<std::string, std::string>> bad = {
        {"", "line 1: "},
        {"rubbish\n", "line 1: "},
        {R"({"elastolab_interaction":2,"window":[800,600]})", "another version"},
        {R"({"elastolab_interaction":1,"window":[0,600]})", "out of its range"},
        {R"({"elastolab_interaction":1,"window":[1e300,600]})", "out of its range"},
        {R"({"elastolab_interaction":1,"window":[800]})", "line 1: "},
        {kHeader + "\n{\"seconds\":1,\"events\":[],\"window\":[0,1]}\n", "out of its range"},
        {kHeader + "\n{\"seconds\":1}\n", "line 2: "},
        {kHeader + "\n{\"seconds\":1,\"events\":[]}\n[1]\n", "line 3: "},
        {kHeader + "\n{\"seconds\":1,\"events\":[[\"jump\",0,0,0,false,false,0]]}\n", "not a known event"},
        {kHeader + "\n{\"seconds\":1,\"events\":[[\"key\",0,0,0,false,false]]}\n", "line 2: "},
        {kHeader + "\n{\"seconds\":1,\"events\":[[\"key\",0,0,0,false,false,0,0]]}\n", "not a known event"},
        {kHeader + "\n{\"seconds\":1,\"events\":[[\"fingers\",0,0,2,false,false,0]]}\n", "not a known event"},
        {kHeader + "\n{\"seconds\":1,\"events\":[[\"fingers\",0,0,2,false,false,0,0,0,0]]}\n", "out of its range"},
        {kHeader + "\n{\"seconds\":1,\"events\":[[\"key\",0,0,\"x\",false,false,0]]}\n", "line 2: "},
    };
    for (const auto& [text, finding] : bad)
        EXPECT_THAT(complaint(text), AllOf(HasSubstr("bad.log: line "), HasSubstr(finding), HasSubstr("--record"),
                                           Not(HasSubstr("\n"))));
    EXPECT_THROW(load_interaction("no-such-file.log"), SceneError);
    EXPECT_LT(complaint("{\"" + std::string(10000, 'x') + "\\u").size(), 500U);  // does not quote all of the line
}

TEST(InteractionLog, RefusesADeviceWithoutAnEndOfLine) { EXPECT_THROW(load_interaction("/dev/zero"), SceneError); }

TEST(InteractionLog, RefusesCodesThatNoWindowReports) {
    for (const char* code : {"-2", "5000000000", "1e300"})
        EXPECT_THAT(complaint(kHeader + "\n{\"seconds\":1,\"events\":[[\"button\",0,0," + code + ",true,false,0]]}\n"),
                    HasSubstr("line 2: "))
            << code;
}

}  // namespace
}  // namespace elastolab
