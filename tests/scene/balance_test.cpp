// Whether loads and reactions balance, and what is said where they do not.
#include <gmock/gmock.h>

#include <sstream>
#include <string>
#include <vector>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "elasticity/rotation.hpp"
#include "fem/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/primitives.hpp"
#include "scene/loaded_cube.hpp"
#include "scene/solved_scene.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::refusal_of;
using test::solved;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Its reactions are rounding, of which nothing is to be said.
TEST(SceneLoads, ReactionsOfABodyThatOnlyMovesAreNoImbalance) {
    Document document = loaded_cube();
    document.gravity.reset();
    document.loads.clear();
    document.fixed.clear();
    document.handles[0].motion = AffineMotion{.matrix = cross_matrix({0.1, -0.2, 0.3}), .translate = {0.2, 0, 0.1}};
    document.handles[0].select = {PlaneSelector{{1, 0, 0}, {1, 0, 0}, 1e-9}};
    for (const MethodKind kind : {kFem, kQuadraticFem, kGalerkinBem, kLinearBem}) {
        const Solution moved = solved(document, kind);
        EXPECT_EQ(moved.imbalance.force, 0.0) << name(kind);
        EXPECT_THAT(moved.warnings(), Each(Not(HasSubstr("do not balance")))) << name(kind);
    }
    Document stretched = document;
    std::get<AffineMotion>(stretched.handles[0].motion).matrix(1, 1) = 1e-6;
    EXPECT_GT(solved(stretched, kLinearBem).imbalance.force, 0.0);
}

/// A unit cube and the same at x = 3, of four vertices an edge.
Document two_cubes(const test::TemporaryFolder& folder) {
    const SurfaceMesh one = make_box(3);
    std::ostringstream text;
    for (const double x : {0.0, 3.0})
        for (const auto& v : one.vertices.colwise()) text << "v " << v.x() + x << ' ' << v.y() << ' ' << v.z() << "\n";
    for (const int first : {1, 1 + one.n_vertices()})
        for (const auto& t : one.triangles.colwise())
            text << "f " << t[0] + first << ' ' << t[1] + first << ' ' << t[2] + first << "\n";
    Document document;
    document.mesh = MeshFile{.file = folder.write("two.obj", text.str()).string()};
    document.material = {1000.0, 0.3};
    document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    return document;
}

TEST(SceneLoads, SolidsThatOnlyMoveEachByItselfHaveNoImbalance) {
    const test::TemporaryFolder folder;
    Document document = two_cubes(folder);
    document.handles = {{.name = "moved",
                         .select = {PlaneSelector{{3, 0, 0}, {1, 0, 0}, 1e-9}},
                         .motion = AffineMotion{.translate = {0.1, 0, 0.2}}}};
    for (const MethodKind kind : {kFem, kGalerkinBem}) {
        const Solution moved = solved(document, kind);
        EXPECT_EQ(moved.imbalance.force, 0.0) << name(kind);
        EXPECT_THAT(moved.warnings(), Each(Not(HasSubstr("do not balance")))) << name(kind);
    }
}

/// Whichever solid its first vertex is on.
TEST(SceneLoads, AHandleUnderAForceHoldsSolidsTogether) {
    const test::TemporaryFolder folder;
    for (const bool free_one_first : {true, false}) {
        Document document = two_cubes(folder);
        const SurfaceMesh one = make_box(3);
        std::vector<int> right_of_one, left_of_other;
        for (int v = 0; v < one.n_vertices(); ++v) {
            if (one.vertices(0, v) > 0.9) right_of_one.push_back(v);
            if (one.vertices(0, v) < 0.1) left_of_other.push_back(v + one.n_vertices());
        }
        std::vector<int> both = free_one_first ? left_of_other : right_of_one;
        const std::vector<int>& more = free_one_first ? right_of_one : left_of_other;
        both.insert(both.end(), more.begin(), more.end());
        document.handles = {{.name = "bond",
                             .select = {VertexSelector{both}},
                             .motion = AffineMotion{},
                             .force = GripForce{{1, 2, 3}}}};
        EXPECT_GT(solved(document).displacement.norm(), 0.0);
        document.fixed.clear();
        EXPECT_THAT(refusal_of(document), HasSubstr("nothing holds the body"));
    }
}

/// Of which rounding leaves something, and no force that it could be compared with.
TEST(SceneLoads, MomentsThatBalanceEachOtherAreTaken) {
    Document document = loaded_cube();
    document.gravity.reset();
    document.loads.clear();
    document.fixed.clear();
    document.handles.clear();
    const double moments[] = {0.1, 0.2, -0.3};
    for (int i = 0; i < 3; ++i)
        document.handles.push_back({.name = std::to_string(i),
                                    .select = {BoxSelector{{0.5 * i - 0.1, -0.1, 0.7}, {0.5 * i + 0.1, 0.3, 1.1}}},
                                    .motion = AffineMotion{},
                                    .force = GripForce{{0, 0, 0}, {0, moments[i], 0}}});
    ASSERT_NE(moments[0] + moments[1] + moments[2], 0.0);
    EXPECT_GT(solved(document).displacement.norm(), 0.0);
    document.handles[2].force->moment *= 1.001;
    EXPECT_THAT(refusal_of(document), HasSubstr("the moment"));
}

/// What is held may leave a body to turn: the moment about that line or point is what has to vanish.
TEST(SceneLoads, OfABodyThatCanTurnAreRefusedWithTheirMomentAboutWhatHoldsIt) {
    Document document = loaded_cube();
    document.loads.clear();
    document.handles.clear();
    document.fixed = {{.select = {BoxSelector{{-1, -1, -1}, {2, 0.1, 0.1}}}}};
    EXPECT_THAT(refusal_of(document),
                AllOf(StartsWith("scene.json: /gravity: do not balance: "),
                      HasSubstr("about the line through (0, 0, 0) along (1, 0, 0)"), HasSubstr("moment -9.81.")));
    document.fixed = {{.select = {VertexSelector{{0}}}}};
    EXPECT_THAT(refusal_of(document), AllOf(HasSubstr("turn about (0, 0, 0), "), HasSubstr("moment (-9.81, 9.81, 0)")));
}

}  // namespace
}  // namespace elastolab
