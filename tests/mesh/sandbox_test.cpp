#include "mesh/input/sandbox.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/error.hpp"
#include "mesh/input/import.hpp"
#include "support/sanitized.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

/// What this does in a process of its own that has entered the sandbox.
bool in_sandbox(const std::vector<std::filesystem::path>& folders, const std::function<bool()>& action) {
    const pid_t child = ::fork();
    if (child == 0) {
        enter_sandbox(folders);
        std::_Exit(action() ? 1 : 2);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

bool opens(const std::filesystem::path& file, int flags) { return ::open(file.c_str(), flags, 0600) >= 0; }

TEST(Sandbox, LeavesReadingAFolderAndNothingElse) {
#ifdef ELASTOLAB_TEST_SANITIZED
    GTEST_SKIP() << "sanitizers need more";
#endif
    if (::prctl(PR_GET_SECCOMP) < 0) GTEST_SKIP() << "the kernel has no seccomp";
    const TemporaryFolder folder, other;
    const auto inside = folder.write("a.txt", "a"), outside = other.write("b.txt", "b");
    const auto trying = [&](const std::function<bool()>& action) { return in_sandbox({folder.path()}, action); };
    EXPECT_TRUE(trying([&] { return opens(inside, O_RDONLY); }));
    EXPECT_FALSE(trying([&] { return opens(inside, O_RDWR); }));
    EXPECT_FALSE(trying([&] { return opens(folder.path() / "new", O_WRONLY | O_CREAT); }));
    EXPECT_FALSE(trying([&] { return ::unlink(inside.c_str()) == 0; }));
    EXPECT_FALSE(trying([] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; }));
    EXPECT_FALSE(trying([] { return ::fork() >= 0; }));
    EXPECT_FALSE(trying([] { return ::kill(::getppid(), 0) == 0; }));
    EXPECT_TRUE(trying([] { return std::string(1 << 20, 'x').size() > 0; }));  // memory it may have
    if (::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) < 1)
        GTEST_SKIP() << "the kernel has no Landlock";
    EXPECT_FALSE(trying([&] { return opens(outside, O_RDONLY); }));
}

std::string gltf_with(const std::string& buffer) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
           buffer + "\"}]}";
}

std::string verdict(const std::filesystem::path& file) {
    try {
        load_surface(file);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(ImportHelper, ReadsWhatAFileNamesInItsFolderOnly) {
    const TemporaryFolder folder, other;
    const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::string bytes(reinterpret_cast<const char*>(points), sizeof(points));
    folder.write("own.bin", bytes);
    other.write("secret.bin", bytes);
    EXPECT_EQ(verdict(folder.write("own.gltf", gltf_with("own.bin"))), "accepted");
    const std::string elsewhere = "../" + other.path().filename().string() + "/secret.bin";
    EXPECT_THAT(verdict(folder.write("other.gltf", gltf_with(elsewhere))), HasSubstr("cannot be read"));
    std::filesystem::create_symlink(other.path() / "secret.bin", folder.path() / "link.bin");
    EXPECT_THAT(verdict(folder.write("link.gltf", gltf_with("link.bin"))), HasSubstr("cannot be read"));
}

TEST(ImportHelper, DoesNotWaitForPipes) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder.path() / "pipe.bin").c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo((folder.path() / "pipe.mtl").c_str(), 0600), 0);
    // Waiting for a writer, it would be ended after its time only, and say so.
    EXPECT_THAT(verdict(folder.write("a.gltf", gltf_with("pipe.bin"))), HasSubstr("cannot be read as a mesh"));
    EXPECT_EQ(verdict(folder.write("a.obj", "mtllib pipe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n")),
              "accepted");
}

TEST(ImportHelper, QuotesLittleAndNoControlCodes) {
    const TemporaryFolder folder;
    std::string bell(5000, 'x');
    bell.insert(0, "\x1b]0;title\x07\x1b[31m\xc2\x9b");
    for (const std::string name : {"a.obj", "a.off", "a.ply", "a.stl", "a.gltf", "a.dae", "a.x"}) {
        const std::string text = verdict(folder.write(name, bell + "\nply " + bell + "\nv " + bell + " 1 1\n"));
        EXPECT_LT(text.size(), 600u) << name;
        for (const char* code : {"\x1b", "\x07", "\xc2\x9b", "\n"}) EXPECT_THAT(text, Not(HasSubstr(code))) << name;
    }
}

/// As in "elastolab info ../bodies/own.gltf".
TEST(ImportHelper, ReadsAFileWhoseNameLeadsUpAndDown) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "sub");
    const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    folder.write("own.bin", std::string(reinterpret_cast<const char*>(points), sizeof(points)));
    folder.write("own.gltf", gltf_with("own.bin"));
    Control control;
    EXPECT_EQ(import_surface(folder.path() / "sub" / ".." / "own.gltf", control).mesh.n_triangles(), 1);
    const std::filesystem::path relative = std::filesystem::relative(folder.path() / "own.gltf");
    ASSERT_TRUE(relative.string().starts_with("..")) << relative;
    EXPECT_EQ(import_surface(relative, control).mesh.n_triangles(), 1);
}

TEST(ImportHelper, ReadsFormatsOfItsListOnly) {
    const TemporaryFolder folder;
    EXPECT_THAT(verdict(folder.write("a.bvh", "HIERARCHY")), HasSubstr("has an unsupported format"));
    EXPECT_THAT(verdict(folder.write("mesh", "OFF")), HasSubstr("has no extension"));
}

TEST(ImportHelper, WarnsOfCoordinatesThatAreCoarseForTheBody) {
    const TemporaryFolder folder;
    float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const auto warning = [&] {
        folder.write("own.bin", std::string(reinterpret_cast<const char*>(points), sizeof(points)));
        Control control;
        return import_surface(folder.write("own.gltf", gltf_with("own.bin")), control).warning;
    };
    EXPECT_EQ(warning(), "");
    for (float& x : points) x += 1000.0f;
    EXPECT_THAT(warning(), HasSubstr("rounded by 4e-05 of its size"));
}

}  // namespace
}  // namespace elastolab
