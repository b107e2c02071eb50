#include "base/atomic_file.hpp"

#include <gmock/gmock.h>

#include <cstdio>

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
