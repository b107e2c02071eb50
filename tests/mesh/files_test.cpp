#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "mesh/checks/check.hpp"
#include "mesh/input/export.hpp"
#include "mesh/input/import.hpp"
#include "mesh/input/merge.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::read_text;
using test::TemporaryFolder;

TEST(Files, KeepVertexNumbersAndTrianglesThroughObjAndPly) {
    const TemporaryFolder folder;
    for (const std::string& name : primitive_names())
        for (const char* file : {"a.obj", "a.ply"}) {
            const SurfaceMesh mesh = make_primitive(name, 4);
            save_surface(folder.path() / file, mesh);
            const SurfaceMesh read = load_surface(folder.path() / file);
            ASSERT_EQ(read.n_vertices(), mesh.n_vertices()) << name << file;
            EXPECT_EQ(read.vertices, mesh.vertices) << name << file;
            EXPECT_EQ(read.triangles, mesh.triangles) << name << file;
        }
}

TEST(Files, KeepTheSurfaceThroughStl) {
    const TemporaryFolder folder;
    const SurfaceMesh mesh = make_torus(5);
    save_surface(folder.path() / "a.STL", mesh);
    const SurfaceMesh read = load_surface(folder.path() / "a.STL");
    EXPECT_EQ(read.n_vertices(), mesh.n_vertices());
    EXPECT_EQ(read.n_triangles(), mesh.n_triangles());
    EXPECT_NEAR(enclosed_volume(read), enclosed_volume(mesh), 1e-6);
    EXPECT_EQ(Eigen::Vector3i(read.triangles.col(0)), Eigen::Vector3i(0, 1, 2));  // order of corners
}

TEST(Files, ObjAndPlyHoldAllDigits) {
    const TemporaryFolder folder;
    const SurfaceMesh mesh = make_sphere(2, 1.0 / 3.0);
    save_surface(folder.path() / "a.obj", mesh);
    std::ifstream obj(folder.path() / "a.obj");
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        std::string key, x, y, z;
        obj >> key >> x >> y >> z;
        EXPECT_EQ(std::stod(x), mesh.vertices(0, v));
        EXPECT_EQ(std::stod(z), mesh.vertices(2, v));
    }
    save_surface(folder.path() / "a.ply", mesh);
    const std::string ply = read_text(folder.path() / "a.ply");
    EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + 24u * 18u + 13u * 32u);
}

TEST(Import, NumbersObjVerticesInTheOrderOfTheirLinesAndDropsUnusedOnes) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.obj",
                                   "# first in faces is last in the list\nv 9 9 9\nv 0 0 0\nvt 0 0\nvn 0 0 1\nv 1 0 0\n"
                                   "v 0 1 0\nv 0 0 1\nf 5 4 3\nf 2 3 5\nf 2 4 3\nf 2 5 4\n");
    const SurfaceMesh mesh = load_surface(file);
    Positions expected(3, 4);
    expected << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
    EXPECT_EQ(mesh.vertices, expected);
    EXPECT_EQ(Eigen::Vector3i(mesh.triangles.col(0)), Eigen::Vector3i(3, 2, 1));
}

TEST(Import, MergesEqualPlacesAndTriangulatesPolygons) {
    const TemporaryFolder folder;
    // A unit cube of six separate quads, with a minus zero.
    std::ostringstream text;
    const char* corner[8] = {"0 0 -0.0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "-0.0 1 1"};
    const int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (const auto& face : faces)
        for (const int c : face) text << "v " << corner[c] << "\n";
    for (int f = 0; f < 24; f += 4) text << "f " << f + 1 << ' ' << f + 2 << ' ' << f + 3 << ' ' << f + 4 << "\n";
    const SurfaceMesh mesh = load_surface(folder.write("cube.obj", text.str()));
    EXPECT_EQ(mesh.n_vertices(), 8);
    EXPECT_EQ(mesh.n_triangles(), 12);
    EXPECT_NEAR(enclosed_volume(mesh), 1.0, 1e-15);
    EXPECT_EQ(Eigen::Vector3d(mesh.vertices.col(1)), Eigen::Vector3d(0, 1, 0));
}

TEST(Import, ReadsOffInItsOrder) {
    const TemporaryFolder folder;
    const auto file =
        folder.write("a.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 3 2 1\n3 0 1 3\n3 0 2 1\n3 0 3 2\n");
    const SurfaceMesh mesh = load_surface(file);
    ASSERT_EQ(mesh.n_vertices(), 4);
    EXPECT_EQ(Eigen::Vector3d(mesh.vertices.col(3)), Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(Eigen::Vector3i(mesh.triangles.col(0)), Eigen::Vector3i(3, 2, 1));
}

/// A tetrahedron, twice: in place, and by a node that moves it by (10, 0, 0), scales it by 2 and mirrors it in x.
std::string gltf(bool with_buffer) {
    std::string text = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
        "nodes":[{"mesh":0},{"mesh":0,"translation":[10,0,0],"scale":[-2,2,2]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
                     {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
        "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
        "buffers":[{"byteLength":72,"uri":")";
    return text + (with_buffer ? "tet.bin" : "missing.bin") + "\"}]}";
}

TEST(Import, AppliesTheTransformsOfGltfNodes) {
    const TemporaryFolder folder;
    const float points[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::uint16_t indices[12] = {3, 2, 1, 0, 1, 3, 0, 2, 1, 0, 3, 2};
    std::string bytes(72, '\0');
    std::memcpy(bytes.data(), points, 48);
    std::memcpy(bytes.data() + 48, indices, 24);
    folder.write("tet.bin", bytes);
    // (3,2,1) faces inward here: the whole is turned by the check.
    const CheckedMesh checked = check_and_repair(load_surface(folder.write("a.gltf", gltf(true))));
    EXPECT_EQ(checked.mesh.n_vertices(), 8);
    EXPECT_EQ(checked.report.n_solids, 2);
    EXPECT_NEAR(checked.report.volume, (1.0 + 8.0) / 6.0, 1e-12);
    EXPECT_EQ(checked.report.max_corner, Eigen::Vector3d(10, 2, 2));
}

TEST(Merge, TakesEqualPlacesForOneAndKeepsNumbersThatAreNotFinite) {
    SurfaceMesh mesh{Positions(3, 4), Triangles(3, 1)};
    mesh.vertices << 0.0, -0.0, NAN, NAN, 1, 1, 0, 0, 2, 2, 0, 0;
    mesh.triangles << 1, 2, 3;
    const SurfaceMesh one = merged(mesh);
    EXPECT_EQ(one.n_vertices(), 2);
    EXPECT_EQ(Eigen::Vector3i(one.triangles.col(0)), Eigen::Vector3i(0, 1, 1));
}

TEST(Export, RefusesOtherFormatsAndLeavesNothingBehind) {
    const TemporaryFolder folder;
    const SurfaceMesh mesh = make_box(1);
    for (const char* name : {"a.xyz", "a", "missing/a.obj", "a.obj/b.obj", ""})
        EXPECT_THROW(save_surface(folder.path() / name, mesh), Error) << name;
    EXPECT_TRUE(folder.listing().empty());
    folder.write("old.obj", "old");
    save_surface(folder.path() / "old.obj", mesh);
    EXPECT_THAT(folder.listing(), testing::ElementsAre("old.obj"));
    EXPECT_THAT(read_text(folder.path() / "old.obj"), testing::StartsWith("v 0 0 0"));
}

/// Blanks and line ends may stand anywhere, and normals may be none.
TEST(Files, TextStlIsReadHoweverItIsBroken) {
    const TemporaryFolder folder;
    const std::string corners = "vertex 0 0 0 vertex 1 0 0\nvertex 0 1 0";
    for (const char* normal : {"normal 0 0 1", "normal\n0 0\n1", "", "normal -1.#IND nan nan", "normal 0 0 1 and more"})
        for (const char* between : {"\n", " "}) {
            const auto file = folder.write("a.stl", std::string("solid a\nfacet ") + normal + between + "outer loop\n" +
                                                        corners + "\nendloop endfacet\nendsolid a\n");
            EXPECT_EQ(load_surface(file).n_triangles(), 1) << normal << between;
        }
    const auto damaged = folder.write("b.stl", "solid a\nfacet normal 0 0 1\nloop\n" + corners + "\nendloop\n");
    try {
        load_surface(damaged);
        ADD_FAILURE() << "was read";
    } catch (const MeshError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("line 3: 'loop' stands where 'outer' should"));
    }
}

TEST(Files, StlRefusesWhatSinglePrecisionCannotHold) {
    const test::TemporaryFolder folder;
    SurfaceMesh mesh = make_box(1);
    mesh.vertices *= 1e39;
    EXPECT_THROW(save_surface(folder.path() / "large.stl", mesh), MeshError);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "large.stl"));
    save_surface(folder.path() / "large.ply", mesh);
    EXPECT_EQ(load_surface(folder.path() / "large.ply").vertices, mesh.vertices);
}

}  // namespace
}  // namespace elastolab
