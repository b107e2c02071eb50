// Files of fields, read back by a reader that knows nothing of the writers.
#include "mesh/output/field_files.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <sstream>

#include "mesh/input/import.hpp"
#include "mesh/primitives.hpp"
#include "support/temporary_folder.hpp"
#include "support/vtk_file.hpp"

namespace elastolab {
namespace {

using testing::HasSubstr;

using test::read_vtk;
using test::VtkArray;
using test::VtkFile;

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
    write_vtp(out, mesh, fields, {{"young_modulus", 0.1}, {"method", "fem"}});
    const VtkFile file = read_vtk(out.str());
    EXPECT_EQ(file.kind, "PolyData");
    EXPECT_EQ(file.attributes.at("PointData"), " Scalars=\"size\" Vectors=\"displacement\" Tensors=\"stress\"");
    EXPECT_EQ(file.facts.at("young_modulus"), "0.10000000000000001");
    EXPECT_EQ(file.facts.at("method"), "102 101 109 0");
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
    write_vtu(out, mesh.vertices, mesh.tetrahedra, points, cells);
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

TEST(FieldFiles, MovedPointsHaveNoActiveVector) {
    std::ostringstream out;
    const SurfaceMesh mesh = make_box(1);
    write_vtp(out, mesh, some_fields(mesh.n_vertices()), {}, VtkPoints::moved);
    EXPECT_EQ(read_vtk(out.str()).attributes.at("PointData"), " Scalars=\"size\" Tensors=\"stress\"");
}

TEST(FieldFiles, TenNodeTetrahedraHaveTheOrderOfVtk) {
    std::ostringstream out;
    const Positions vertices = Positions::Random(3, 10);
    write_vtu(out, vertices, Eigen::VectorXi::LinSpaced(10, 0, 9), {}, {});
    const VtkFile file = read_vtk(out.str());
    EXPECT_EQ(file.arrays.at("Cells/types").as<std::uint8_t>(), (std::vector<std::uint8_t>{24}));
    EXPECT_EQ(file.arrays.at("Cells/connectivity").as<std::int64_t>(),
              (std::vector<std::int64_t>{0, 1, 2, 3, 4, 7, 5, 6, 8, 9}));
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
