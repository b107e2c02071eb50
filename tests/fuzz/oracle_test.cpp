// The oracle against programs that misbehave, and the mutators.
#include "fuzz/oracle.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <set>

#include "fuzz/body_maker.hpp"
#include "fuzz/mutator.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab::fuzz {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// What the oracle says of a shell script.
std::string complaint(const std::string& script) {
    const test::TemporaryFolder folder;
    const Command command{.program = "/bin/sh",
                          .arguments = {"-c", script},
                          .folder = folder.path(),
                          .cpu_seconds = 0.9,
                          .stuck_seconds = 2.0};
    return complaint_about(run(command), command);
}

TEST(Oracle, AcceptsSuccessAndRefusalsInOneLine) {
    EXPECT_THAT(complaint("echo fine"), IsEmpty());
    EXPECT_THAT(complaint("echo 'elastolab: w\303\274rfel.obj: is empty.' >&2; exit 1"), IsEmpty());
    EXPECT_THAT(complaint("echo 'elastolab: --mode: x.' >&2; exit 2"), IsEmpty());
}

TEST(Oracle, ComplainsOfSignalsAndOtherExitCodes) {
    EXPECT_THAT(complaint("kill -SEGV $$"), HasSubstr("signal 11"));
    EXPECT_THAT(complaint("echo 'elastolab: no.' >&2; exit 3"), HasSubstr("exit code 3"));
}

TEST(Oracle, ComplainsOfLoopsAndOfSleepForEver) {
    EXPECT_THAT(complaint("while true; do :; done"), HasSubstr("more than 1 s"));
    EXPECT_THAT(complaint("(while true; do :; done)"), HasSubstr("more than 1 s"));  // in a process below
    EXPECT_THAT(complaint("sleep 1000"), HasSubstr("does nothing"));
}

TEST(Oracle, ComplainsOfMessagesThatAreNotOneCleanLine) {
    for (const char* message :
         {"", "elastolab: two\nlines\n", "elastolab: no end", "segfault\n", "elastolab: \033[31m\n",
          "elastolab: \233\n", "elastolab: \302\233\n", "elastolab: tab\there\n"})
        EXPECT_FALSE(complaint("printf '%s' '" + std::string(message) + "' >&2; exit 1").empty()) << message;
    EXPECT_THAT(complaint("echo half; echo 'elastolab: no.' >&2; exit 1"), HasSubstr("although it failed"));
}

/// What it says of a file.
std::string odd_number_of(const std::string& name, const std::string& text) {
    const test::TemporaryFolder folder;
    return not_finite_in(folder.write(name, text));
}

TEST(Oracle, FindsNumbersThatAreNone) {
    EXPECT_THAT(odd_number_of("a.csv", "name,x,y\ninf,1,2\n\"n,nan\",3,4e-300\n"), IsEmpty());
    EXPECT_THAT(odd_number_of("a.csv", "name,x,y\n\"two\ninf\",1,2\nb,3,4\n"), IsEmpty());
    EXPECT_THAT(odd_number_of("a.csv", "name,x,y\n\"two\nlines\",1,inf\n"), HasSubstr("inf"));
    EXPECT_THAT(odd_number_of("a.csv", "name,x,y\na,1,-nan\n"), HasSubstr("nan"));
    EXPECT_THAT(odd_number_of("a.csv", "name,x,y\na,inf,1\n"), HasSubstr("inf"));
    EXPECT_THAT(odd_number_of("a.obj", "v 1 2 3\nf 1 2 3\n"), IsEmpty());
    EXPECT_THAT(odd_number_of("a.obj", "v 1 2 -inf\n"), HasSubstr("inf"));
    EXPECT_THAT(odd_number_of("a.json", R"({"residual": null})"), HasSubstr("null at /residual"));
    EXPECT_THAT(odd_number_of("a.json", R"({"residual": )"), HasSubstr("not JSON"));
    EXPECT_THAT(odd_number_of("a.csv", ""), HasSubstr("no content"));
    EXPECT_THAT(odd_number_of("a.stl", std::string(84 + 50, '\0')), IsEmpty());
    EXPECT_THAT(odd_number_of("a.stl", std::string(84, '\0') + std::string(50, '\xff')), HasSubstr("not finite"));
    EXPECT_THAT(not_finite_in("no-such-file.csv"), HasSubstr("missing"));
}

TEST(Mutator, InputsAreThoseOfTheirSeedAndDiffer) {
    const std::vector<Seed> seeds = load_seeds(ELASTOLAB_FUZZ_SEEDS);
    std::set<std::string> contents, formats;
    constexpr std::uint64_t kInputs = 1000;
    for (std::uint64_t i = 0; i < kInputs; ++i) {
        const Input input = make_input(seeds, 5, i);
        EXPECT_EQ(input.bytes, make_input(seeds, 5, i).bytes);
        contents.insert(input.name + input.bytes);
        formats.insert(input.name);
    }
    EXPECT_GT(contents.size(), kInputs * 9 / 10);
    EXPECT_EQ(formats.size(), 11u);  // 9 formats of meshes, scenes, replays
    EXPECT_NE(make_input(seeds, 5, 1).bytes, make_input(seeds, 6, 1).bytes);
}

TEST(BodyMaker, BodiesAreThoseOfTheirSeedAndHaveWhatTheirScenesName) {
    std::set<std::string> meshes;
    constexpr std::uint64_t kInputs = 200;
    for (std::uint64_t i = 0; i < kInputs; ++i) {
        const Input input = make_body(5, i);
        const nlohmann::json scene = nlohmann::json::parse(input.bytes);
        ASSERT_EQ(input.beside.size(), 1U);
        EXPECT_EQ(scene.at("mesh").at("file"), input.beside[0].name);
        EXPECT_EQ(make_body(5, i).bytes, input.bytes);
        EXPECT_EQ(make_body(5, i).beside[0].bytes, input.beside[0].bytes);
        meshes.insert(input.beside[0].bytes);
    }
    EXPECT_GT(meshes.size(), kInputs / 2);
}

}  // namespace
}  // namespace elastolab::fuzz
