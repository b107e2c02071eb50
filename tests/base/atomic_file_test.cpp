#include "base/atomic_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <set>

#include "base/error.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string finding(const std::filesystem::path& destination) {
    try {
        AtomicFile::require_writable(destination);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(AtomicFile, IsThereOnlyOnceItIsCommitted) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "out.csv";
    AtomicFile out(file);
    out.stream() << "complete";
    EXPECT_FALSE(exists(file));
    out.commit();
    EXPECT_EQ(test::read_text(file), "complete");
    EXPECT_THAT(folder.listing(), ElementsAre("out.csv"));
}

TEST(AtomicFile, LeavesWhatWasThereWhenItIsNotCommitted) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("out.csv", "before");
    { AtomicFile(file).stream() << "half"; }
    EXPECT_EQ(test::read_text(file), "before");
    EXPECT_THAT(folder.listing(), ElementsAre("out.csv"));
}

TEST(AtomicFile, ReplacesTheFileThatALinkLeadsTo) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("real.csv", "before");
    create_symlink(file, folder.path() / "link.csv");
    AtomicFile out(folder.path() / "link.csv");
    out.stream() << "after";
    out.commit();
    EXPECT_TRUE(is_symlink(folder.path() / "link.csv"));
    EXPECT_EQ(test::read_text(file), "after");
}

TEST(AtomicFile, MakesTheFileThatALinkLeadsTo) {
    const test::TemporaryFolder folder;
    create_directory(folder.path() / "there");
    create_symlink("there/new.csv", folder.path() / "link.csv");
    AtomicFile out(folder.path() / "link.csv");
    out.stream() << "made";
    out.commit();
    EXPECT_TRUE(is_symlink(folder.path() / "link.csv"));
    EXPECT_EQ(test::read_text(folder.path() / "there" / "new.csv"), "made");
}

TEST(AtomicFile, RefusesLinksThatLeadInACircle) {
    const test::TemporaryFolder folder;
    create_symlink("b.csv", folder.path() / "a.csv");
    create_symlink("a.csv", folder.path() / "b.csv");
    EXPECT_THAT(finding(folder.path() / "a.csv"), HasSubstr("back to itself"));
}

TEST(AtomicFile, RefusesALinkOfAnotherUserInAFolderOfEverybody) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can lay a link of another user";
    const test::TemporaryFolder folder;
    const auto file = folder.write("mine.csv", "before"), link = folder.path() / "open" / "out.csv";
    create_directory(link.parent_path());
    chmod(link.parent_path().c_str(), 01777);
    create_symlink(file, link);
    EXPECT_THAT(finding(link), IsEmpty());
    ASSERT_EQ(lchown(link.c_str(), 12345, 12345), 0);
    EXPECT_THAT(finding(link), HasSubstr("another user"));
}

mode_t permissions(const std::filesystem::path& file) {
    struct stat info {};
    stat(file.c_str(), &info);
    return info.st_mode & 07777U;
}

TEST(AtomicFile, KeepsThePermissionsOfTheFileThatItReplaces) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("out.csv", "before");
    for (const mode_t mode : {0600U, 0664U, 0755U}) {
        chmod(file.c_str(), mode);
        AtomicFile(file).commit();
        EXPECT_EQ(permissions(file), mode);
    }
}

TEST(AtomicFile, IsHiddenUntilItReplacesAPrivateFile) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("out.csv", "before");
    chmod(file.c_str(), 0600);
    const AtomicFile out(file);
    for (const std::string& name : folder.listing()) EXPECT_EQ(permissions(folder.path() / name), 0600U) << name;
}

TEST(AtomicFile, GivesANewFileWhatTheUmaskAllows) {
    const test::TemporaryFolder folder;
    const mode_t before = umask(027);
    AtomicFile(folder.path() / "out.csv").commit();
    umask(before);
    EXPECT_EQ(permissions(folder.path() / "out.csv"), 0640U);
}

TEST(AtomicFile, KeepsTheOwnerOfTheFileThatItReplaces) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can write for another user";
    const test::TemporaryFolder folder;
    const auto file = folder.write("out.csv", "before");
    ASSERT_EQ(chown(file.c_str(), 12345, 23456), 0);
    AtomicFile(file).commit();
    struct stat info {};
    stat(file.c_str(), &info);
    EXPECT_EQ(info.st_uid, 12345U);
    EXPECT_EQ(info.st_gid, 23456U);
}

/// Names that an AtomicFile works under, one run after the other.
TEST(AtomicFile, WorksUnderNamesThatDoNotRepeat) {
    constexpr int kRuns = 50;
    const test::TemporaryFolder folder;
    std::set<std::string> names;
    for (int i = 0; i < kRuns; ++i) {
        const AtomicFile out(folder.path() / "out.csv");
        ASSERT_EQ(folder.listing().size(), 1U);
        const std::string name = folder.listing().front();
        EXPECT_THAT(name, testing::Not(HasSubstr(std::to_string(getpid()))));
        names.insert(name.substr(0, 20));  // no counter behind a fixed beginning
    }
    EXPECT_EQ(names.size(), static_cast<std::size_t>(kRuns));
}

/// Leaves a temporary in `folder`, as a killed program does.
void be_killed_while_writing(const std::filesystem::path& folder) {
    const pid_t child = fork();
    if (child == 0) {
        AtomicFile out(folder / "out.csv");
        out.stream() << "half" << std::flush;
        kill(getpid(), SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
}

TEST(AtomicFile, RemovesWhatAKilledProgramHasLeft) {
    const test::TemporaryFolder folder;
    be_killed_while_writing(folder.path());
    ASSERT_EQ(folder.listing().size(), 1U);
    AtomicFile(folder.path() / "other.csv").commit();
    EXPECT_THAT(folder.listing(), ElementsAre("other.csv"));
}

TEST(AtomicFile, LeavesWhatOthersAreWriting) {
    const test::TemporaryFolder folder;
    folder.write(".elastolab-notes.tmp", "of a person");
    AtomicFile one(folder.path() / "one.csv"), two(folder.path() / "two.csv");
    one.stream() << "1";
    two.commit();
    one.commit();
    EXPECT_THAT(folder.listing(), ElementsAre(".elastolab-notes.tmp", "one.csv", "two.csv"));
    EXPECT_EQ(test::read_text(folder.path() / "one.csv"), "1");
}

TEST(AtomicFile, WritesDevicesDirectly) {
    AtomicFile out("/dev/null");
    out.stream() << "gone";
    out.commit();
    EXPECT_TRUE(is_character_file(std::filesystem::path("/dev/null")));
}

TEST(AtomicFile, WritesOnAnOpenStreamWithoutReplacingItsFile) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("log", "before ");
    FILE* stream = std::fopen(file.c_str(), "a");
    ASSERT_NE(stream, nullptr);
    const std::string descriptor = std::to_string(fileno(stream));
    create_symlink("/dev/fd/" + descriptor, folder.path() / "link");
    for (const auto& path : {std::filesystem::path("/dev/fd/" + descriptor), folder.path() / "link"}) {
        AtomicFile out(path);
        out.stream() << "written ";
        out.commit();
    }
    std::fputs("after", stream);
    std::fclose(stream);
    EXPECT_EQ(test::read_text(file), "before written written after");
    EXPECT_THAT(folder.listing(), ElementsAre("link", "log"));
}

TEST(AtomicFile, NoticesAFullDisk) {
    AtomicFile out("/dev/full");
    out.stream() << "does not fit";
    EXPECT_THROW(out.commit(), Error);
}

TEST(AtomicFile, SaysWhyAPlaceCannotBeWritten) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("file", "");
    EXPECT_THAT(finding(folder.path() / "missing" / "out.csv"), HasSubstr("folder does not exist"));
    EXPECT_THAT(finding(file / "out.csv"), HasSubstr("is a file"));
    EXPECT_THAT(finding(folder.path()), HasSubstr("is a folder"));
    EXPECT_THAT(finding("/proc/out.csv"), HasSubstr("cannot be written there"));
    EXPECT_THAT(finding(folder.path() / "out.csv"), IsEmpty());
    EXPECT_THAT(folder.listing(), ElementsAre("file"));
}

}  // namespace
}  // namespace elastolab
