// Which axis of a bare mesh points up.
#include "app/files/up_axis.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <string>

#include "mesh/input/import.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

using Eigen::Vector3d;

SurfaceMesh turned(SurfaceMesh mesh, double degrees, const Vector3d& axis) {
    const Eigen::AngleAxisd turn(degrees * EIGEN_PI / 180.0, axis);
    mesh.vertices = (turn.toRotationMatrix() * mesh.vertices).eval();
    return mesh;
}

SurfaceMesh asset(const std::string& name) { return load_surface(std::string(ELASTOLAB_ASSETS "/meshes/") + name); }

TEST(UpAxis, IsYWhereABodyStandsEitherWay) {
    EXPECT_EQ(up_axis_of(make_box(3)), Vector3d::UnitY());
    EXPECT_EQ(up_axis_of(asset("ring.obj")), Vector3d::UnitY());
    EXPECT_EQ(up_axis_of(asset("bracket.obj")), Vector3d::UnitY());
}

TEST(UpAxis, IsZWhereABodyStandsOnlySo) {
    for (const std::string name : {"rabbit.obj", "hand.obj"}) {
        const SurfaceMesh body = asset(name);
        EXPECT_EQ(up_axis_of(body), Vector3d::UnitZ()) << name;
        EXPECT_EQ(up_axis_of(turned(body, -90.0, Vector3d::UnitX())), Vector3d::UnitY()) << name;
    }
}

TEST(UpAxis, IsYWhereABodyStandsNeitherWay) {
    const SurfaceMesh leaning = turned(make_box(6, {0.2, 0.2, 3.0}), 35.0, Vector3d(1.0, 0.3, 0.2).normalized());
    EXPECT_EQ(up_axis_of(leaning), Vector3d::UnitY());
}

TEST(UpAxis, LowestVerticesAreThoseOfAPartOfTheHeight) {
    EXPECT_THAT(lowest_vertices(make_box(4), Vector3d::UnitZ(), 0.3), testing::SizeIs(25 + 16));
    EXPECT_THAT(lowest_vertices(make_box(4), Vector3d::UnitZ(), 0.0), testing::SizeIs(25));
}

TEST(UpAxis, ASheetThatLiesDownIsNotHeldAllOver) {
    SurfaceMesh sheet = make_box(4, {2.0, 1.0, 1.0});
    EXPECT_THAT(first_held_vertices(sheet, Vector3d::UnitZ()), testing::SizeIs(9 * 5));
    sheet.vertices.row(2).setZero();
    const std::vector<int> held = first_held_vertices(sheet, Vector3d::UnitZ());
    EXPECT_THAT(held, testing::Not(testing::IsEmpty()));
    for (const int v : held) EXPECT_EQ(sheet.vertices(0, v), 0.0);
}

}  // namespace
}  // namespace elastolab
