#include "scene/live/live_scene.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "base/error.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A cube of 2 cells (26 vertices), held at x = 0.
LiveScene cube_scene() {
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = 2, .size = {}};
    document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    return {document, "cube.json"};
}

std::vector<int> right_face(const LiveScene& scene) {
    std::vector<int> vertices;
    for (int v = 0; v < scene.mesh().n_vertices(); ++v)
        if (scene.mesh().vertices(0, v) > 0.99) vertices.push_back(v);
    return vertices;
}

TEST(LiveScene, AHandleOwnsItsVertices) {
    LiveScene scene = cube_scene();
    const std::vector<int> face = right_face(scene);
    ASSERT_EQ(scene.add_handle(face), 0);
    EXPECT_EQ(scene.owner(face[3]), 0);
    EXPECT_EQ(std::vector<int>(scene.vertices(0).begin(), scene.vertices(0).end()), face);
    EXPECT_EQ(scene.vertices(LiveScene::kFixed).size(), 9u);
    EXPECT_EQ(scene.constraints().set.handles, face);
}

TEST(LiveScene, NoVertexIsTakenTwice) {
    LiveScene scene = cube_scene();
    const std::vector<int> face = right_face(scene);
    scene.add_handle(std::vector<int>{face[0], face[1]});
    EXPECT_EQ(scene.add_handle(face), 1);
    EXPECT_EQ(scene.vertices(1).size(), face.size() - 2);
    EXPECT_EQ(scene.add_handle(face), LiveScene::kNobody);
    scene.fix(face);
    EXPECT_EQ(scene.vertices(LiveScene::kFixed).size(), 9u);
}

TEST(LiveScene, HandlesAreRenamedButNotLikeOthers) {
    LiveScene scene = cube_scene();
    const std::vector<int> face = right_face(scene);
    scene.add_handle(std::vector<int>{face[0]});
    scene.add_handle(std::vector<int>{face[1]});
    scene.commit();
    EXPECT_TRUE(scene.rename_handle(0, "ear"));
    EXPECT_EQ(scene.handle_name(0), "ear");
    EXPECT_EQ(scene.constraints().groups[1].name, "ear");
    EXPECT_TRUE(scene.modified());
    for (const char* name : {"", "fixed", "handle-1", "ear"}) EXPECT_FALSE(scene.rename_handle(0, name)) << name;
    EXPECT_EQ(scene.handle_name(0), "ear");
    scene.commit();
    scene.undo();
    EXPECT_EQ(scene.handle_name(0), "handle-0");
}

TEST(LiveScene, AMotionReachesTheValuesOfItsHandleOnly) {
    LiveScene scene = cube_scene();
    const std::vector<int> face = right_face(scene);
    scene.add_handle(std::vector<int>{face[0]});
    scene.add_handle(std::vector<int>{face[1], face[2]});
    scene.set_motion(1, AffineMotion{.translate = {1, 2, 3}});
    Eigen::VectorXd expected(9);
    expected << 0, 0, 0, 1, 2, 3, 1, 2, 3;
    EXPECT_EQ(scene.constraints().values, expected);
}

TEST(LiveScene, UndoAndRedoGoThroughTheSteps) {
    LiveScene scene = cube_scene();
    const std::vector<int> face = right_face(scene);
    scene.add_handle(face);
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    scene.commit();
    scene.commit();  // nothing changed: no step
    scene.set_motion(0, AffineMotion{.translate = {0.2, 0, 0}});
    scene.commit();
    scene.undo();
    EXPECT_EQ(scene.constraints().values(0), 0.1);
    scene.undo();
    EXPECT_EQ(scene.n_handles(), 0);
    EXPECT_FALSE(scene.can_undo());
    EXPECT_FALSE(scene.modified());
    scene.redo();
    scene.redo();
    EXPECT_EQ(scene.constraints().values(0), 0.2);
    EXPECT_FALSE(scene.can_redo());
}

TEST(LiveScene, FixedVerticesCanBeTakenBack) {
    LiveScene scene = cube_scene();
    const std::vector<int> all(scene.vertices(LiveScene::kFixed).begin(), scene.vertices(LiveScene::kFixed).end());
    scene.unfix(std::vector<int>{all[0]});
    EXPECT_EQ(scene.vertices(LiveScene::kFixed).size(), 8u);
    EXPECT_EQ(scene.owner(all[0]), LiveScene::kNobody);
    scene.unfix(all);
    EXPECT_THAT(scene.vertices(LiveScene::kFixed), IsEmpty());
    scene.fix(std::vector<int>{3, 1});
    EXPECT_THAT(scene.vertices(LiveScene::kFixed), ElementsAre(1, 3));
}

std::vector<int> members(std::span<const int> vertices) { return {vertices.begin(), vertices.end()}; }

TEST(LiveScene, FixedSetsKeepTheirVerticesAndTogetherAreTheFixedPart) {
    LiveScene scene = cube_scene();
    const std::vector<int> left = members(scene.fixed_vertices(0)), face = right_face(scene);
    EXPECT_EQ(scene.fixed_name(0), "fixed");
    scene.fix(std::vector<int>{face[0], left[0]}, scene.n_fixed_sets());
    ASSERT_EQ(scene.n_fixed_sets(), 2);
    EXPECT_EQ(scene.fixed_name(1), "fixed-1");
    EXPECT_EQ(members(scene.fixed_vertices(0)), left) << "its vertices are left to it";
    EXPECT_THAT(scene.fixed_vertices(1), ElementsAre(face[0]));
    scene.fix(std::vector<int>{face[1]}, 0);
    scene.fix(std::vector<int>{face[2]});  // to the last
    EXPECT_EQ(scene.fixed_set_of(face[1]), 0);
    EXPECT_EQ(scene.fixed_set_of(face[2]), 1);
    EXPECT_EQ(scene.fixed_set_of(face[3]), LiveScene::kNobody);
    EXPECT_EQ(scene.owner(face[2]), LiveScene::kFixed);
    EXPECT_EQ(scene.vertices(LiveScene::kFixed).size(), left.size() + 3);
    EXPECT_EQ(scene.add_handle(std::vector<int>{face[0], face[1]}), LiveScene::kNobody);
}

TEST(LiveScene, VerticesLeaveOneFixedSetOrAllAndAnEmptySetIsGone) {
    LiveScene scene = cube_scene();
    const std::vector<int> left = members(scene.fixed_vertices(0)), face = right_face(scene);
    scene.fix(face, 1);
    scene.unfix(std::vector<int>{left[0], face[0]}, 1);
    EXPECT_EQ(scene.fixed_set_of(left[0]), 0);
    EXPECT_EQ(scene.owner(face[0]), LiveScene::kNobody);
    scene.unfix(std::vector<int>{left[0], face[1]});
    EXPECT_EQ(scene.fixed_vertices(0).size(), left.size() - 1);
    EXPECT_EQ(scene.fixed_vertices(1).size(), face.size() - 2);
    scene.unfix(left, 0);
    ASSERT_EQ(scene.n_fixed_sets(), 1);
    EXPECT_EQ(scene.fixed_name(0), "fixed-1") << "names stay";
}

TEST(LiveScene, FixedSetsAreMadeRenamedAndRemovedInStepsOfUndo) {
    LiveScene scene = cube_scene();
    const std::vector<int> face = right_face(scene);
    scene.fix(std::vector<int>{face[0]}, 1);
    scene.commit();
    scene.add_handle(std::vector<int>{face[1]});
    scene.commit();
    for (const char* name : {"", "fixed", "fixed-1", "handle-0"}) EXPECT_FALSE(scene.rename_fixed_set(1, name)) << name;
    EXPECT_TRUE(scene.rename_fixed_set(1, "clamp"));
    scene.commit();
    EXPECT_FALSE(scene.rename_handle(0, "clamp"));
    scene.remove_fixed_set(0);
    scene.commit();
    ASSERT_EQ(scene.n_fixed_sets(), 1);
    EXPECT_EQ(scene.fixed_name(0), "clamp");
    EXPECT_EQ(scene.handle_name(0), "handle-0");
    scene.undo();
    EXPECT_EQ(scene.n_fixed_sets(), 2);
    EXPECT_EQ(scene.fixed_vertices(0).size(), 9u);
    scene.undo();
    EXPECT_EQ(scene.fixed_name(1), "fixed-1");
    scene.undo();
    scene.undo();
    EXPECT_EQ(scene.n_fixed_sets(), 1);
    scene.redo();
    EXPECT_THAT(scene.fixed_vertices(1), ElementsAre(face[0]));
}

TEST(LiveScene, NewNamesAvoidThoseThatAreTaken) {
    LiveScene scene = cube_scene();
    const std::vector<int> face = right_face(scene);
    scene.add_handle(std::vector<int>{face[0]});
    scene.add_handle(std::vector<int>{face[1]});
    scene.remove_handle(0);
    scene.add_handle(std::vector<int>{face[2]});
    EXPECT_EQ(scene.handle_name(0), "handle-1");
    EXPECT_EQ(scene.handle_name(1), "handle-0");
}

TEST(LiveScene, AMotionThatIsNotFiniteIsIgnored) {
    LiveScene scene = cube_scene();
    scene.add_handle(right_face(scene));
    const Motion motion = AffineMotion{.translate = {0.1, 0, 0}};
    scene.set_motion(0, motion);
    const Eigen::VectorXd before = scene.constraints().values;
    const double nan = std::numeric_limits<double>::quiet_NaN(), most = std::numeric_limits<double>::max();
    scene.set_motion(0, AffineMotion{.translate = {nan, 0, 0}});
    scene.set_motion(0, AffineMotion{.matrix = Eigen::Matrix3d::Constant(most)});
    EXPECT_EQ(scene.constraints().values, before);
    EXPECT_EQ(scene.document().handles[0].motion, motion);
}

TEST(LiveScene, NoHandleIsCalledAsTheFixedPartIs) {
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = 2, .size = {}};
    document.handles = {{.name = "fixed", .select = {VertexSelector{{0}}}, .motion = AffineMotion{}}};
    try {
        const LiveScene scene(document, "cube.json");
        FAIL() << "was taken";
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("cube.json: /handles/0/name"));
    }
}

TEST(LiveScene, RefusesAMeshOfNoUse) {
    Document document;
    document.mesh = MeshFile{"no-such-file.obj"};
    EXPECT_THROW(LiveScene(document, "scene.json"), MeshError);
}

TEST(Motion, ARotationTurnsWhatIsMovedAlready) {
    const Eigen::Matrix3d turn = (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
    const Eigen::Vector3d x(1, 2, 3), center(0.5, 0, 0);
    const AffineMotion start{.matrix = 0.1 * Eigen::Matrix3d::Ones(), .translate = {1, 0, 0}};
    const Eigen::Vector3d expected = center + turn * (x + start.matrix * x + start.translate - center) - x;

    const auto affine = std::get<AffineMotion>(transformed(start, turn, center, x));
    EXPECT_LT((affine.matrix * x + affine.translate - expected).norm(), 1e-14);
    const VertexMotion single{{start.matrix * x + start.translate}};
    EXPECT_LT((std::get<VertexMotion>(transformed(single, turn, center, x)).displacements[0] - expected).norm(), 1e-14);
}

}  // namespace
}  // namespace elastolab
