// The meshes in assets/meshes: fit for every method, well shaped, and what make_bodies makes.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <Eigen/Geometry>
#include <filesystem>
#include <numbers>

#include "mesh/checks/check.hpp"
#include "mesh/input/import.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

const std::filesystem::path kMeshes = std::filesystem::path(ELASTOLAB_ASSETS) / "meshes";

std::vector<std::string> mesh_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(kMeshes))
        names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// Degrees.
double smallest_angle(const SurfaceMesh& mesh) {
    double largest_cosine = -1.0;
    for (const auto& t : mesh.triangles.colwise())
        for (int c = 0; c < 3; ++c) {
            const Eigen::Vector3d a = mesh.vertices.col(t[c]), b = mesh.vertices.col(t[(c + 1) % 3]),
                                  d = mesh.vertices.col(t[(c + 2) % 3]);
            largest_cosine = std::max(largest_cosine, (b - a).normalized().dot((d - a).normalized()));
        }
    return std::acos(largest_cosine) * 180.0 / std::numbers::pi;
}

std::string body_name(const testing::TestParamInfo<std::string>& body) {
    std::string name = body.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

class Bodies : public testing::TestWithParam<std::string> {
protected:
    std::filesystem::path file() const { return kMeshes / (GetParam() + ".obj"); }
};

TEST_P(Bodies, HaveNoDefectsAndWellShapedTriangles) {
    const SurfaceMesh mesh = load_surface(file());
    const MeshReport report = check_and_repair(mesh).report;
    for (const Defect& defect : report.defects) ADD_FAILURE() << defect.text;
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(report.n_solids, 1);
    EXPECT_GE(mesh.n_vertices(), 300);
    EXPECT_LE(mesh.n_vertices(), 5000);
    EXPECT_GE(smallest_angle(mesh), 38.0);  // the worst, at a corner of the bracket, has 38.8
    EXPECT_LT(std::filesystem::file_size(file()), 300'000U);
}

/// Bytes, not nearly: make_bodies uses only arithmetic that IEEE 754 rounds one way, and is compiled so (GCC and clang
/// on x86-64 have been compared).
TEST_P(Bodies, AreWhatMakeBodiesMakes) {
    const test::TemporaryFolder folder;
    const std::string command = std::string("\"") + MAKE_BODIES + "\" " + folder.path().string() + " " + GetParam();
    ASSERT_EQ(std::system((command + " > /dev/null").c_str()), 0);
    EXPECT_TRUE(test::read_text(folder.path() / (GetParam() + ".obj")) == test::read_text(file()))
        << "make_bodies makes another " << GetParam() << ". Run `make_bodies assets/meshes` and commit the result.";
}

INSTANTIATE_TEST_SUITE_P(Assets, Bodies, testing::ValuesIn(mesh_names()), body_name);

}  // namespace
}  // namespace elastolab
