#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "mesh/checks/check.hpp"
#include "mesh/input/export.hpp"
#include "mesh/input/import.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::read_text;
using test::TemporaryFolder;

struct BadFile {
    std::string name, text;
};

/// What loading and checking a file for FEM says; "accepted" if nothing.
std::string finding(const std::filesystem::path& file) {
    try {
        require_usable(check_and_repair(load_surface(file)).report, file.string(), true);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "accepted";
}

void expect_clear(const std::string& text, const std::filesystem::path& file) {
    EXPECT_THAT(text, testing::StartsWith(file.string() + ":"));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("\n")));
    EXPECT_THAT(text, testing::EndsWith("."));
    EXPECT_LT(text.size(), 1200u);
}

std::string obj(const SurfaceMesh& mesh) {
    const TemporaryFolder folder;
    save_surface(folder.path() / "a.obj", mesh);
    return read_text(folder.path() / "a.obj");
}

std::string bytes_of(const char* extension, const SurfaceMesh& mesh) {
    const TemporaryFolder folder;
    const auto file = folder.path() / (std::string("a") + extension);
    save_surface(file, mesh);
    return read_text(file);
}

const std::string kTet = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

std::string garbage(int n) {
    std::string text;
    for (unsigned i = 0, x = 12345; i < static_cast<unsigned>(n); ++i)
        text += static_cast<char>((x = x * 1664525 + 1013904223) >> 24);
    return text;
}

std::vector<BadFile> not_meshes() {
    const std::string ply = bytes_of(".ply", make_box(2)), stl = bytes_of(".stl", make_box(2));
    const std::string ply_header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    std::string stl_count = stl;
    stl_count[83] = '\x7f';
    return {
        {"empty.obj", ""},
        {"empty.ply", ""},
        {"empty.stl", ""},
        {"blank.obj", "\n\n   \n"},
        {"text.txt", "Dear reader, this is no mesh."},
        {"text.obj", "Dear reader, this is no mesh.\n"},
        {"noextension", "nothing"},
        {"garbage.obj", garbage(4000)},
        {"garbage.ply", garbage(4000)},
        {"garbage.stl", garbage(4000)},
        {"garbage.off", garbage(4000)},
        {"garbage.glb", garbage(4000)},
        {"garbage.dae", garbage(4000)},
        {"truncated.stl", stl.substr(0, stl.size() / 2)},
        {"count.stl", stl_count},
        {"header_only.stl", stl.substr(0, 84)},
        {"truncated.ply", ply.substr(0, ply.size() / 2)},
        {"header_only.ply", ply_header + "end_header\n"},
        {"cut_header.ply", ply_header},
        {"wrong_format.ply", "ply\nformat cuneiform 1.0\nend_header\n"},
        {"wrong_magic.off", "FFO\n4 4 0\n0 0 0\n"},
        {"truncated.off", "OFF\n400 400 0\n0 0 0\n1 0"},
        {"huge_count.off", "OFF\n353535235358 6 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"missing_face.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"vertices_only.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
        {"points_only.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n"},
        {"lines_only.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n"},
        {"index_out_of_range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n"},
        {"huge_index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999\n"},
        {"negative_index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -9 -2 -1\n"},
        {"zero_index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"},
        {"not_json.gltf", "{\"asset\": "},
        {"no_buffer.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
            "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"missing.bin"}]})"},
    };
}

TEST(BadFiles, ThatAreNoMeshesGiveOneClearLine) {
    const TemporaryFolder folder;
    for (const BadFile& bad : not_meshes()) {
        SCOPED_TRACE(bad.name);
        const auto file = folder.write(bad.name, bad.text);
        expect_clear(finding(file), file);
    }
}

TEST(BadFiles, ThatAreMissingOrFoldersGiveOneClearLine) {
    const TemporaryFolder folder;
    const auto missing = folder.path() / "missing.obj", strange = folder.path() / "two\nlines.obj";
    EXPECT_THAT(finding(missing), testing::HasSubstr("no such file"));
    EXPECT_THAT(finding(folder.path()), testing::HasSubstr("is a folder"));
    EXPECT_THAT(finding("/dev/null"), testing::HasSubstr("not a regular file"));
    EXPECT_THAT(finding(strange), testing::Not(testing::HasSubstr("\n")));
    EXPECT_THAT(finding(""), testing::HasSubstr("no such file"));
}

TEST(BadFiles, WithSurfacesThatBoundNoSolidNameTheDefect) {
    const SurfaceMesh cube = make_box(2);
    const std::vector<std::pair<BadFile, std::string>> cases{
        {{"nan.obj", "v nan 0 0\n" + kTet.substr(8)}, "not (a )?finite"},
        {{"inf.obj", "v inf 0 0\n" + kTet.substr(8)}, "not (a )?finite"},
        {{"overflow.obj", "v 1e300 0 0\n" + kTet.substr(8)}, "not (a )?finite"},
        {{"open.obj", kTet.substr(0, kTet.size() - 8)}, "3 open edges"},
        {{"repeated_corner.obj", kTet + "f 1 1 2\n"}, "two corners at the same place"},
        {{"duplicate.obj", kTet + "f 1 3 2\n"}, "repeats another"},
        {{"third_triangle.obj", kTet + "v 5 5 5\nf 1 2 5\n"}, "more than two triangles"},
        {{"flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"},
         "encloses? no volume"},
        {{"collinear.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"}, "no area"},
        {{"touching.obj", obj(joined(cube, moved(cube, {1, 0, 0})))}, "more than two triangles"},
        {{"touching_edge.obj", obj(joined(cube, moved(cube, {1, 1, 0})))}, "more than two triangles"},
        {{"touching_corner.obj", obj(joined(cube, moved(cube, {1, 1, 1})))}, "by a point only"},
        {{"touching_shifted.obj", obj(joined(cube, moved(cube, {1, 0.25, 0.25})))}, "cross or touch"},
        {{"crossing.obj", obj(joined(cube, moved(cube, {0.3, 0.4, 0.55})))}, "cross or touch"},
        {{"one_sided.obj",  // the projective plane on six vertices
          "v 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0.2 0\nv 0.1 -1 0\nv 0.3 0.2 -1\nf 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 6\nf 1 6 "
          "2\n"
          "f 2 3 5\nf 3 4 6\nf 4 5 2\nf 5 6 3\nf 6 2 4\n"},
         "one-sided"},
    };
    const TemporaryFolder folder;
    for (const auto& [bad, expected] : cases) {
        SCOPED_TRACE(bad.name);
        const auto file = folder.write(bad.name, bad.text);
        const std::string text = finding(file);
        expect_clear(text, file);
        EXPECT_THAT(text, testing::ContainsRegex(expected));
    }
}

}  // namespace
}  // namespace elastolab
