#include "app/window/file_dialog.hpp"

#include <gtest/gtest.h>

namespace elastolab {
namespace {

TEST(FileDialog, ANameWithoutAKnownExtensionGetsTheSuggestedOne) {
    const FileDialog::Purpose scene{"", {".json"}, "cube.json", {}};
    EXPECT_EQ(with_extension("/a/beam", scene), "/a/beam.json");
    EXPECT_EQ(with_extension("beam.v2", scene), "beam.v2.json");
    EXPECT_EQ(with_extension("beam.JSON", scene), "beam.JSON");
    const FileDialog::Purpose mesh{"", {".obj", ".ply"}, "cube-deformed.obj", {}};
    EXPECT_EQ(with_extension("beam.ply", mesh), "beam.ply");
    EXPECT_EQ(with_extension("beam", mesh), "beam.obj");
}

}  // namespace
}  // namespace elastolab
