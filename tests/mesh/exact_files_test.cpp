#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/input/import.hpp"
#include "mesh/primitives.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

/// A tetrahedron whose coordinates have every bit of a double in use, some far from the origin.
SurfaceMesh random_tetrahedron(unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    SurfaceMesh mesh{Positions(3, 4), Triangles(3, 4)};
    for (double& x : mesh.vertices.reshaped()) x = number(random) * (seed % 2 == 0 ? 1.0 : 1e6);
    mesh.triangles << 0, 0, 1, 0, 1, 3, 3, 2, 2, 1, 2, 3;  // numbered in the order of appearance
    return mesh;
}

template <class T>
std::string raw(T value, bool big_endian = false) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    return {bytes.begin(), bytes.end()};
}

std::string words(const SurfaceMesh& mesh, const std::string& before) {
    std::string text;
    for (const auto& p : mesh.vertices.colwise())
        text += before + exact(p.x()) + " " + exact(p.y()) + " " + exact(p.z()) + "\n";
    return text;
}

std::string faces(const SurfaceMesh& mesh, const std::string& before, int base) {
    std::string text;
    for (const auto& t : mesh.triangles.colwise())
        text += before + std::to_string(t.x() + base) + " " + std::to_string(t.y() + base) + " " +
                std::to_string(t.z() + base) + "\n";
    return text;
}

std::string ply_header(const std::string& format, const std::string& type, const std::string& list = "uchar int") {
    return "ply\nformat " + format + " 1.0\ncomment from a test\nelement vertex 4\nproperty " + type +
           " x\nproperty uchar red\nproperty " + type + " y\nproperty " + type +
           " z\nproperty list uchar short extra\nelement face 4\nproperty list " + list +
           " vertex_indices\nproperty float quality\nelement tail 1\nproperty int i\nend_header\n";
}

template <class Coordinate, class Count, class Index>
std::string binary_ply(const SurfaceMesh& mesh, const std::string& header, bool big) {
    std::string bytes = header;
    for (const auto& p : mesh.vertices.colwise())
        bytes += raw(static_cast<Coordinate>(p.x()), big) + raw(std::uint8_t{7}, big) +
                 raw(static_cast<Coordinate>(p.y()), big) + raw(static_cast<Coordinate>(p.z()), big) +
                 raw(std::uint8_t{1}, big) + raw(std::int16_t{-3}, big);
    for (const auto& t : mesh.triangles.colwise()) {
        bytes += raw(static_cast<Count>(3), big);
        for (const int v : t) bytes += raw(static_cast<Index>(v), big);
        bytes += raw(0.5f, big);
    }
    return bytes + raw(std::int32_t{11}, big);
}

/// The same with its coordinates rounded to floats, as files of floats have them.
SurfaceMesh in_floats(SurfaceMesh mesh) {
    mesh.vertices = mesh.vertices.cast<float>().cast<double>().eval();
    return mesh;
}

std::string binary_stl(const SurfaceMesh& mesh) {
    std::string bytes(80, ' ');
    bytes += raw(static_cast<std::uint32_t>(mesh.n_triangles()));
    for (const auto& t : mesh.triangles.colwise()) {
        bytes += raw(0.0f) + raw(0.0f) + raw(0.0f);
        for (const int v : t)
            for (const double x : mesh.vertices.col(v)) bytes += raw(static_cast<float>(x));
        bytes += std::string(2, '\0');
    }
    return bytes;
}

std::string text_stl(const SurfaceMesh& mesh) {
    std::string text = "solid two words\n";
    for (const auto& t : mesh.triangles.colwise()) {
        text += "  facet normal 0 0 nan\n    outer loop\n";
        for (const int v : t) text += words({mesh.vertices.col(v), Triangles(3, 0)}, "      vertex ");
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid two words\n";
}

void expect_equal(const SurfaceMesh& read, const SurfaceMesh& mesh) {
    EXPECT_EQ(read.vertices, mesh.vertices);
    EXPECT_EQ(read.triangles, mesh.triangles);
}

TEST(ExactFiles, KeepEveryBitOfTextCoordinates) {
    const TemporaryFolder folder;
    for (unsigned seed = 0; seed < 6; ++seed) {
        SCOPED_TRACE(seed);
        const SurfaceMesh mesh = random_tetrahedron(seed);
        std::string ply = ply_header("ascii", "float");
        for (const auto& p : mesh.vertices.colwise())
            ply += exact(p.x()) + " 7 " + exact(p.y()) + " " + exact(p.z()) + " 2 5 6\n";
        for (const auto& t : mesh.triangles.colwise())
            ply += "3 " + std::to_string(t.x()) + " " + std::to_string(t.y()) + " " + std::to_string(t.z()) + " 0.5\n";
        const std::vector<std::pair<std::string, std::string>> files{
            {"a.obj", words(mesh, "v ") + faces(mesh, "f ", 1)},
            {"a.off", "OFF\n4 4 6\n" + words(mesh, "") + faces(mesh, "3 ", 0)},
            {"a.ply", ply + "11\n"},
            {"a.stl", text_stl(mesh)}};
        for (const auto& [name, text] : files) {
            SCOPED_TRACE(name);
            expect_equal(load_surface(folder.write(name, text)), mesh);
        }
    }
}

TEST(ExactFiles, KeepEveryBitOfBinaryCoordinates) {
    const TemporaryFolder folder;
    for (unsigned seed = 0; seed < 6; ++seed) {
        SCOPED_TRACE(seed);
        const SurfaceMesh mesh = random_tetrahedron(seed), coarse = in_floats(mesh);
        const auto read = [&](const std::string& bytes) { return load_surface(folder.write("a.ply", bytes)); };
        const std::string little = "binary_little_endian", big = "binary_big_endian";
        expect_equal(read(binary_ply<double, std::uint8_t, std::int32_t>(mesh, ply_header(little, "double"), false)),
                     mesh);
        expect_equal(read(binary_ply<double, std::int32_t, std::uint16_t>(
                         mesh, ply_header(big, "float64", "int32 uint16"), true)),
                     mesh);
        expect_equal(read(binary_ply<float, std::uint16_t, std::uint32_t>(
                         mesh, ply_header(big, "float32", "ushort uint"), true)),
                     coarse);
        expect_equal(
            read(binary_ply<float, std::uint8_t, std::int8_t>(mesh, ply_header(little, "float", "uchar char"), false)),
            coarse);
        expect_equal(load_surface(folder.write("a.stl", binary_stl(mesh))), coarse);
        // Its first 80 bytes may be any, those that mark a text among them.
        for (const std::string mark : {"\xef\xbb\xbf", "\xff\xfe", "\xfe\xff"})
            expect_equal(load_surface(folder.write("a.stl", mark + binary_stl(mesh).substr(mark.size()))), coarse);
    }
}

TEST(ExactFiles, KeepDigitsFarFromTheOrigin) {
    const TemporaryFolder folder;
    SurfaceMesh mesh = make_sphere(3, 1.0);
    mesh.vertices.colwise() += Eigen::Vector3d(1e6, -1e6, 1e5);
    Control control;
    const ImportedSurface read =
        import_surface(folder.write("far.obj", words(mesh, "v ") + faces(mesh, "f ", 1)), control);
    expect_equal(read.mesh, mesh);
    EXPECT_EQ(read.warning, "");
}

TEST(ExactFiles, ReadTriangleStripsInFull) {
    const TemporaryFolder folder;
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    const auto read = [&](const std::string& strips) {
        return load_surface(folder.write(
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                vertices + strips));
    };
    Triangles expected(3, 4);
    expected << 0, 2, 1, 3, 2, 3, 3, 2, 1, 1, 0, 0;  // every second one of a strip is turned round
    EXPECT_EQ(read("6 0 2 1 3 0 2\n").triangles, expected);
    // Two strips, the second one with a repeated corner that only leads on.
    const SurfaceMesh two = read("10 0 2 1 3 -1 0 3 3 2 0\n");
    EXPECT_EQ(two.n_triangles(), 3);
    EXPECT_EQ(Eigen::Vector3i(two.triangles.col(2)), Eigen::Vector3i(3, 2, 0));
}

TEST(ExactFiles, ReadOffAsAStreamOfWords) {
    const TemporaryFolder folder;
    Triangles expected(3, 4);
    expected << 3, 0, 0, 0, 2, 1, 2, 3, 1, 3, 1, 2;
    const std::string places = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n", triangles = "3 3 2 1\n3 0 1 3\n3 0 2 1\n3 0 3 2\n";
    const std::vector<std::string> texts{
        "OFF\n4 4 6\n" + places + triangles,
        "OFF4 4 6\n" + places + triangles,
        "OFF 4 4\n" + places + triangles,
        "# a comment\nOFF # another\n4 4 0\n0 0 0 1 0 0 0\n1 0\n0 0 1\n3 3 2\n1\n3 0 1 3 3 0\n2 1 3 0 3 2\n",
        std::string("OFF\n4 4 0\n") + places + "3 3 2 1 255 0 0\n3 0 1 3 0 255 0\n3 0 2\n1 0 0 255\n3 0 3 2\n",
        std::string("COFF\n4 4 0\n0 0 0 9 9 9 255\n1 0 0 9 9 9 255\n0 1 0 9 9 9 255\n0 0 1 9 9 9 255\n") + triangles,
        std::string("COFF\n4 4 0\n0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n0 0 1 9 9 9\n") + triangles,
        std::string("NOFF\n4 4 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n") + triangles,
        std::string("4OFF\n4 4 0\n0 0 0 1\n2 0 0 2\n0 1 0 1\n0 0 0.5 0.5\n") + triangles,
    };
    for (const std::string& text : texts) {
        SCOPED_TRACE(text);
        const SurfaceMesh mesh = load_surface(folder.write("a.off", text));
        ASSERT_EQ(mesh.n_vertices(), 4);
        EXPECT_EQ(Eigen::Vector3d(mesh.vertices.col(1)), Eigen::Vector3d(1, 0, 0));
        EXPECT_EQ(Eigen::Vector3d(mesh.vertices.col(3)), Eigen::Vector3d(0, 0, 1));
        EXPECT_EQ(mesh.triangles, expected);
    }
}

/// A colour that is a number of corners would make the next face's first word a corner.
TEST(ExactFiles, TakeColoursOfOffFilesForColours) {
    const TemporaryFolder folder;
    const SurfaceMesh sphere = make_sphere(4);
    const auto same = [&](const std::string& text, const SurfaceMesh& expected) {
        const SurfaceMesh mesh = load_surface(folder.write("a.off", text));
        EXPECT_EQ(mesh.triangles, expected.triangles);
        EXPECT_EQ(mesh.vertices, expected.vertices);
    };
    const auto header = [](const SurfaceMesh& mesh) {
        return std::to_string(mesh.n_vertices()) + " " + std::to_string(mesh.n_triangles()) + " 0\n";
    };
    for (int colour = 0; colour <= 8; ++colour) {
        SCOPED_TRACE(colour);
        std::string lines;
        for (int t = 0; t < sphere.n_triangles(); ++t) {
            lines += "3";
            for (const int v : sphere.triangles.col(t)) lines += " " + std::to_string(v);
            lines += " " + std::to_string(colour) + "\n";
        }
        same("OFF\n" + header(sphere) + words(sphere, "") + lines, sphere);
    }
    SurfaceMesh tetrahedron{Positions::Zero(3, 4), Triangles(3, 4)};
    tetrahedron.vertices.rightCols(3).setIdentity();
    tetrahedron.triangles << 3, 0, 0, 0, 2, 1, 2, 3, 1, 3, 1, 2;
    for (int red = 0; red <= 8; ++red) {
        SCOPED_TRACE(red);
        const std::string colour = " " + std::to_string(red) + " 3 0\n";
        same("COFF\n4 4 0\n0 0 0" + colour + "1 0 0" + colour + "0 1 0" + colour + "0 0 1" + colour +
                 faces(tetrahedron, "3 ", 0),
             tetrahedron);
    }
}

TEST(ExactFiles, ReadObjAsItIsWritten) {
    const TemporaryFolder folder;
    const std::string path = "mtllib C:\\meshes\\\n";  // no continuation
    const SurfaceMesh mesh = load_surface(folder.write(
        "a.obj",
        "# OBJ\r\n" + path +
            "o a b\r\nv 0 0 0 0.5 0.5 0.5\r\nv 2 0 0 2 0.5 0.5 0.5\r\nv 0 \\\r\n1 0\r\nvt 0 0\nv +0 0. 1e0\n"
            "vn 0 0 1\ng a\\\nb\ns off\nusemtl m\nf -1/1/1 -2/1/1 -3//1\nf 1 2\\\n 4 # the second\nf 1/1 3 2\nl 1 2\n"
            "f 1 4 3"));
    Triangles expected(3, 4);
    expected << 3, 0, 0, 0, 2, 1, 2, 3, 1, 3, 1, 2;
    EXPECT_EQ(mesh.triangles, expected);
    EXPECT_EQ(Eigen::Vector3d(mesh.vertices.col(1)), Eigen::Vector3d(1, 0, 0));
}

TEST(ExactFiles, ThatAreCutShortOrCountWronglyAreRefused) {
    const TemporaryFolder folder;
    const SurfaceMesh mesh = make_sphere(2, 1.0 / 3.0);
    const std::string n = std::to_string(mesh.n_vertices()), m = std::to_string(mesh.n_triangles());
    const std::string ply_text = "ply\nformat ascii 1.0\nelement vertex " + n +
                                 "\nproperty double x\nproperty double y\nproperty double z\nelement face " + m +
                                 "\nproperty list uchar int vertex_indices\nend_header\n" + words(mesh, "") +
                                 faces(mesh, "3 ", 0);
    const std::string off = "OFF\n" + n + " " + m + " 0\n" + words(mesh, "") + faces(mesh, "3 ", 0);
    const std::string ply = binary_ply<double, std::uint8_t, std::int32_t>(
        random_tetrahedron(0), ply_header("binary_little_endian", "double"), false);
    const std::vector<std::pair<std::string, std::string>> whole{
        {"a.ply", ply_text}, {"b.ply", ply}, {"a.off", off}, {"a.stl", text_stl(mesh)}, {"b.stl", binary_stl(mesh)}};
    for (const auto& [name, text] : whole) {
        SCOPED_TRACE(name);
        EXPECT_NO_THROW(load_surface(folder.write(name, text)));
        for (const double part : {0.3, 0.6, 0.9, 0.99}) {
            const auto size = static_cast<std::size_t>(part * static_cast<double>(text.size()));
            EXPECT_THROW(load_surface(folder.write(name, text.substr(0, size))), MeshError) << part;
        }
        EXPECT_THROW(load_surface(folder.write(name, text + "3 0 1 2\n")), MeshError) << "more than is counted";
    }
    const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    };
    for (const std::string count : {"1", "3", "5", "4294967295", "9223372036854775807", "99999999999999999999", "-1"}) {
        SCOPED_TRACE(count);
        const auto refuses = [&](const std::string& name, const std::string& text) {
            EXPECT_THROW(load_surface(folder.write(name, text)), MeshError) << name;
        };
        refuses("c.ply", replaced(ply, "element vertex 4", "element vertex " + count));
        refuses("c.ply", replaced(ply, "element face 4", "element face " + count));
        refuses("d.ply", replaced(ply_text, "element face " + m, "element face " + count));
        refuses("c.off", replaced(off, "OFF\n" + n, "OFF\n" + count));
        refuses("c.off", replaced(off, " " + m + " 0", " " + count + " 0"));
    }
}

}  // namespace
}  // namespace elastolab
