// Files of fields, read back by a reader that knows nothing of the writers.
#include "mesh/output/field_files.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "mesh/input/import.hpp"
#include "mesh/primitives.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using testing::HasSubstr;

std::string decoded(const std::string& text) {
    static const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (text.size() % 4 != 0) throw std::runtime_error("base64 comes in groups of four");
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); i += 4) {
        std::uint32_t bits = 0;
        int n = 0;
        for (std::size_t j = i; j < i + 4; ++j) {
            const std::size_t value = letters.find(text[j]);
            bits = bits << 6 | (value == std::string::npos ? 0u : static_cast<std::uint32_t>(value));
            n += text[j] != '=' ? 1 : 0;
        }
        for (int j = 0; j < n - 1; ++j) bytes += static_cast<char>(bits >> (16 - 8 * j) & 0xffu);
    }
    return bytes;
}

/// A DataArray of a VTK XML file, as its specification has it: a 64 bit count of bytes, then these.
struct VtkArray {
    std::string type, section;
    int n_components = 0;
    std::string bytes;

    template <class T>
    std::vector<T> as() const {
        std::vector<T> values(bytes.size() / sizeof(T));
        std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
};

struct VtkFile {
    std::string kind;
    std::map<std::string, int> counts;
    std::map<std::string, VtkArray> arrays;  ///< by "section/name"
};

/// Every tag in turn; an end tag that does not belong to the last open one is an error.
VtkFile read_vtk(const std::string& text) {
    VtkFile file;
    std::vector<std::string> open;
    const std::regex tag(R"(<(/?)([A-Za-z]+)((?:\s+[A-Za-z_]+="[^"]*")*)\s*(/?)>)"),
        pair(R"rx(([A-Za-z_]+)="([^"]*)")rx");
    auto at = std::sregex_iterator(text.begin(), text.end(), tag);
    for (; at != std::sregex_iterator(); ++at) {
        const std::string name = (*at)[2], attributes = (*at)[3];
        if ((*at)[1].length() > 0) {
            if (open.empty() || open.back() != name) throw std::runtime_error("</" + name + "> closes nothing");
            open.pop_back();
            continue;
        }
        std::map<std::string, std::string> values;
        for (auto p = std::sregex_iterator(attributes.begin(), attributes.end(), pair); p != std::sregex_iterator();
             ++p)
            values[(*p)[1]] = (*p)[2];
        if (name == "VTKFile") {
            file.kind = values.at("type");
            if (values.at("byte_order") != "LittleEndian" || values.at("header_type") != "UInt64")
                throw std::runtime_error("unknown layout");
        }
        if (name == "Piece")
            for (const auto& [key, value] : values) file.counts[key] = std::stoi(value);
        if (name == "DataArray") {
            if (values.at("format") != "binary") throw std::runtime_error("unknown format");
            const auto begin = static_cast<std::size_t>(at->position() + at->length());
            const std::string bytes = decoded(text.substr(begin, text.find('<', begin) - begin));
            std::uint64_t n = 0;
            std::memcpy(&n, bytes.data(), sizeof n);
            if (n + sizeof n != bytes.size()) throw std::runtime_error(values.at("Name") + ": wrong count of bytes");
            file.arrays[open.back() + "/" + values.at("Name")] = {
                values.at("type"), open.back(), std::stoi(values.at("NumberOfComponents")), bytes.substr(sizeof n)};
        }
        open.push_back(name);
    }
    if (!open.empty()) throw std::runtime_error("<" + open.back() + "> is not closed");
    return file;
}

std::vector<double> numbers(const Eigen::MatrixXd& matrix) {
    return {matrix.reshaped().begin(), matrix.reshaped().end()};
}

/// Random fields of 1, 3 and 6 components.
std::vector<MeshField> some_fields(Eigen::Index n) {
    return {{"size", Eigen::MatrixXd::Random(1, n)},
            {"displacement", Eigen::MatrixXd::Random(3, n)},
            {"stress", 1e9 * Eigen::MatrixXd::Random(6, n)}};
}

TEST(FieldFiles, AVtpHasTheSurfaceAndItsFieldsExactly) {
    SurfaceMesh mesh = make_box(3);
    mesh.vertices *= 1.0 / 3.0;
    const auto fields = some_fields(mesh.n_vertices());
    std::ostringstream out;
    write_vtp(out, mesh, fields);
    const VtkFile file = read_vtk(out.str());
    EXPECT_EQ(file.kind, "PolyData");
    EXPECT_EQ(file.counts.at("NumberOfPoints"), mesh.n_vertices());
    EXPECT_EQ(file.counts.at("NumberOfPolys"), mesh.n_triangles());
    EXPECT_EQ(file.arrays.at("Points/Points").as<double>(), numbers(mesh.vertices));
    for (const MeshField& field : fields) {
        const VtkArray& array = file.arrays.at("PointData/" + field.name);
        EXPECT_EQ(array.type, "Float64");
        EXPECT_EQ(array.n_components, field.values.rows());
        EXPECT_EQ(array.as<double>(), numbers(field.values));
    }
    const auto corners = file.arrays.at("Polys/connectivity").as<std::int64_t>();
    const auto ends = file.arrays.at("Polys/offsets").as<std::int64_t>();
    ASSERT_EQ(ends.size(), static_cast<std::size_t>(mesh.n_triangles()));
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        EXPECT_EQ(ends[static_cast<std::size_t>(t)], 3 * (t + 1));
        for (int i = 0; i < 3; ++i) EXPECT_EQ(corners[static_cast<std::size_t>(3 * t + i)], mesh.triangles(i, t));
    }
}

TEST(FieldFiles, AVtuHasTetrahedraWithFieldsAtPointsAndInCells) {
    TetMesh mesh;
    mesh.vertices = Eigen::Matrix3Xd::Random(3, 5);
    mesh.tetrahedra.resize(4, 2);
    mesh.tetrahedra << 0, 1, 1, 2, 2, 3, 3, 4;
    const auto points = some_fields(5), cells = some_fields(2);
    std::ostringstream out;
    write_vtu(out, mesh, points, cells);
    const VtkFile file = read_vtk(out.str());
    EXPECT_EQ(file.kind, "UnstructuredGrid");
    EXPECT_EQ(file.counts.at("NumberOfCells"), 2);
    EXPECT_EQ(file.arrays.at("Points/Points").as<double>(), numbers(mesh.vertices));
    EXPECT_EQ(file.arrays.at("PointData/stress").as<double>(), numbers(points[2].values));
    EXPECT_EQ(file.arrays.at("CellData/stress").as<double>(), numbers(cells[2].values));
    EXPECT_EQ(file.arrays.at("Cells/types").type, "UInt8");
    EXPECT_EQ(file.arrays.at("Cells/types").as<std::uint8_t>(), (std::vector<std::uint8_t>{10, 10}));
    EXPECT_EQ(file.arrays.at("Cells/offsets").as<std::int64_t>(), (std::vector<std::int64_t>{4, 8}));
    EXPECT_EQ(file.arrays.at("Cells/connectivity").as<std::int64_t>(),
              (std::vector<std::int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
}

TEST(FieldFiles, APlyIsReadByTheProgramItselfAndNamesItsProperties) {
    const test::TemporaryFolder folder;
    const SurfaceMesh mesh = make_box(2);
    std::ostringstream out;
    write_ply(out, mesh, some_fields(mesh.n_vertices()));
    for (const char* name : {"double size", "double displacement_x", "double stress_xx", "double stress_xz"})
        EXPECT_THAT(out.str(), HasSubstr(name));
    const SurfaceMesh read = load_surface(folder.write("fields.ply", out.str()));
    ASSERT_EQ(read.n_triangles(), mesh.n_triangles());
    double worst = 0.0;  // it may number the vertices anew
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (int i = 0; i < 3; ++i)
            worst = std::max(worst, (read.vertices.col(read.triangles(i, t)) - mesh.vertices.col(mesh.triangles(i, t)))
                                        .cwiseAbs()
                                        .maxCoeff());
    EXPECT_EQ(worst, 0.0);
}

TEST(FieldFiles, ATableHasARowForEachVertexWithAllDigits) {
    const Positions vertices = Positions::Random(3, 4) / 3.0;
    const auto fields = some_fields(4);
    std::ostringstream out;
    write_field_csv(out, vertices, fields);
    std::istringstream in(out.str());
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line,
              "vertex,x,y,z,size,displacement_x,displacement_y,displacement_z,stress_xx,stress_yy,stress_zz,stress_xy,"
              "stress_yz,stress_xz");
    for (int v = 0; v < 4; ++v) {
        ASSERT_TRUE(std::getline(in, line));
        std::vector<double> row = {static_cast<double>(v)}, read;
        for (const double x : vertices.col(v)) row.push_back(x);
        for (const MeshField& field : fields)
            for (const double x : field.values.col(v)) row.push_back(x);
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) read.push_back(std::stod(cell));
        EXPECT_EQ(read, row);
    }
    EXPECT_FALSE(std::getline(in, line));
}

}  // namespace
}  // namespace elastolab
