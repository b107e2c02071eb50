#include "app/window/recent_files.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

using Paths = std::vector<std::filesystem::path>;

TEST(RecentFiles, TheNewestIsInFrontAndEachIsThereOnce) {
    EXPECT_EQ(with_recent_file({"/a", "/b", "/c"}, "/b"), (Paths{"/b", "/a", "/c"}));
    EXPECT_EQ(with_recent_file({}, "/a"), Paths{"/a"});
}

TEST(RecentFiles, AreTenAtMost) {
    Paths files;
    for (int i = 0; i < 20; ++i) files = with_recent_file(files, std::filesystem::path("/") / std::to_string(i));
    EXPECT_THAT(files, SizeIs(10));
    EXPECT_EQ(files.front(), "/19");
}

TEST(RecentFiles, ComeBackInTheNextRun) {
    EXPECT_THAT(load_recent_files(), IsEmpty());
    const Paths files = {"/one file.obj", "/\xc3\xa4.json"};
    save_recent_files(files);
    EXPECT_EQ(load_recent_files(), files);
}

TEST(RecentFiles, NeedNoFolderOfTheirOwn) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("file", "");
    setenv("XDG_STATE_HOME", file.c_str(), 1);  // no folder can be made there
    save_recent_files({"/a"});
    EXPECT_THAT(load_recent_files(), IsEmpty());
    unsetenv("XDG_STATE_HOME");
    unsetenv("HOME");
    save_recent_files({"/a"});
    EXPECT_THAT(load_recent_files(), IsEmpty());
}

}  // namespace
}  // namespace elastolab
