#include "scene/constraints.hpp"
#include "scene/scene_mesh.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const Selector kLeftFace{BoxSelector{.min = {0, 0, 0}, .max = {0, 1, 1}}};
const Selector kRightFace{BoxSelector{.min = {1, 0, 0}, .max = {1, 1, 1}}};

/// A cube of 26 vertices, 9 on every face, fixed at the left.
Document cube_document() {
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = 2, .size = {}};
    document.fixed = {{.select = kLeftFace}};
    return document;
}

SceneMesh load(const MeshSource& source, const std::filesystem::path& scene_file) {
    Control control;
    return load_scene_mesh(source, scene_file, control);
}

SurfaceMesh mesh_of(const Document& document) { return load(document.mesh, "s.json").checked.mesh; }

Constraints constraints(const Document& document) { return make_constraints(document, mesh_of(document), "s.json"); }

template <class Call>
std::string finding(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::string refusal(const Document& document) {
    return finding([&] { constraints(document); });
}

TEST(SceneConstraints, AnAffineHandleMovesEveryVertexByItsRestPosition) {
    Document document = cube_document();
    const AffineMotion motion{.matrix = (Eigen::Matrix3d() << 0, 1, 2, 3, 4, 5, 6, 7, 8).finished(),
                              .translate = {0.1, 0.2, 0.3}};
    document.handles.push_back({.name = "right", .select = kRightFace, .motion = motion});
    const SurfaceMesh mesh = mesh_of(document);
    const Constraints result = constraints(document);
    ASSERT_EQ(result.set.handles.size(), 9U);
    ASSERT_EQ(result.values.size(), 27);
    for (int i = 0; i < 9; ++i) {
        const Eigen::Vector3d x = mesh.vertices.col(result.set.handles[static_cast<std::size_t>(i)]);
        EXPECT_EQ(Eigen::Vector3d(result.values.segment<3>(3 * i)), motion.matrix * x + motion.translate);
    }
}

TEST(SceneConstraints, DisplacementsFollowTheOrderOfTheirVertices) {
    Document document = cube_document();
    document.fixed.clear();
    document.handles.push_back(
        {.name = "", .select = {VertexSelector{{20, 3}}}, .motion = VertexMotion{{{1, 2, 3}, {4, 5, 6}}}});
    const Constraints result = constraints(document);
    EXPECT_THAT(result.set.handles, ElementsAre(20, 3));
    EXPECT_THAT(std::vector<double>(result.values.begin(), result.values.end()), ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(SceneConstraints, GroupsAreTheFixedPartAndThenTheHandles) {
    Document document = cube_document();
    document.fixed = {{.select = {VertexSelector{{0, 1, 2}}}}};
    document.handles.push_back({.name = "", .select = {VertexSelector{{25}}}, .motion = AffineMotion{}});
    document.handles.push_back({.name = "b", .select = {VertexSelector{{24, 23}}}, .motion = AffineMotion{}});
    const Constraints result = constraints(document);
    ASSERT_EQ(result.groups.size(), 3U);
    EXPECT_EQ(result.groups[0].name, "fixed");
    EXPECT_EQ(result.groups[0].end, 3);
    EXPECT_EQ(result.groups[1].name, "handle-0");
    EXPECT_EQ(result.groups[2].name, "b");
    EXPECT_EQ(result.groups[2].begin, 4);
    EXPECT_EQ(result.groups[2].end, 6);
    EXPECT_THAT(result.set.handles, ElementsAre(25, 24, 23));
}

TEST(SceneConstraints, FixedSetsAreOneGroupTogether) {
    Document document = cube_document();
    document.fixed = {{.name = "a", .select = {VertexSelector{{4, 1}}}}, {.select = {VertexSelector{{0, 9, 3}}}}};
    document.handles.push_back({.name = "h", .select = {VertexSelector{{25}}}, .motion = AffineMotion{}});
    const Constraints result = constraints(document);
    EXPECT_THAT(result.set.fixed, ElementsAre(4, 1, 0, 9, 3));
    ASSERT_EQ(result.groups.size(), 2U);
    EXPECT_EQ(result.groups[0].name, "fixed");
    EXPECT_EQ(result.groups[0].end, 5);
    EXPECT_EQ(result.groups[1].begin, 5);
    ASSERT_EQ(result.fixed_sets.size(), 2U);
    EXPECT_EQ(result.fixed_sets[0].name, "a");
    EXPECT_EQ(result.fixed_sets[1].name, "fixed-1");
    EXPECT_EQ(result.fixed_sets[1].begin, 2);
    EXPECT_EQ(result.fixed_sets[1].end, 5);
}

TEST(SceneConstraints, FixedSetsAreDisjointAndNamedApart) {
    Document document = cube_document();
    document.fixed.push_back({.select = {VertexSelector{{25, 0}}}});
    EXPECT_THAT(refusal(document), HasSubstr("s.json: /fixed/1/select: vertex 0"));
    EXPECT_THAT(refusal(document), HasSubstr("also belongs to /fixed/0"));
    document.fixed[1] = {.name = "fixed", .select = kRightFace};
    EXPECT_THAT(refusal(document), HasSubstr("/fixed: two of them are called \"fixed\""));
    document.fixed[1].name = "a";
    document.handles.push_back(
        {.name = "a", .select = {BoxSelector{{0.5, 0, 0}, {0.5, 0, 0}}}, .motion = AffineMotion{}});
    EXPECT_THAT(refusal(document), HasSubstr("and a fixed set are called \"a\""));
}

TEST(SceneConstraints, NoVertexIsConstrainedTwice) {
    Document document = cube_document();
    document.handles.push_back({.name = "a", .select = kRightFace, .motion = AffineMotion{}});
    document.handles.push_back({.name = "b", .select = kRightFace, .motion = AffineMotion{}});
    EXPECT_THAT(refusal(document), HasSubstr("s.json: /handles/1/select: vertex"));
    EXPECT_THAT(refusal(document), HasSubstr("also belongs to /handles/0"));
    document.handles = {{.name = "c", .select = kLeftFace, .motion = AffineMotion{}}};
    EXPECT_THAT(refusal(document), HasSubstr("also belongs to /fixed"));
}

TEST(SceneConstraints, EveryVertexNeedsADisplacement) {
    Document document = cube_document();
    document.handles.push_back({.name = "", .select = kRightFace, .motion = VertexMotion{{{1, 2, 3}}}});
    EXPECT_THAT(refusal(document), HasSubstr("/handles/0/displacements: has 1 entries for 9 selected vertices"));
}

TEST(SceneConstraints, DisplacementsMustStayFinite) {
    Document document = cube_document();
    const AffineMotion huge{.matrix = Eigen::Matrix3d::Constant(1e308), .translate = {0, 0, 0}};
    document.handles.push_back({.name = "", .select = kRightFace, .motion = huge});
    EXPECT_THAT(refusal(document), HasSubstr("/handles/0: moves vertex"));
}

TEST(SceneConstraints, AnUnnamedHandleMustNotTakeTheNameOfAnother) {
    Document document = cube_document();
    document.handles.push_back({.name = "handle-1", .select = {VertexSelector{{25}}}, .motion = AffineMotion{}});
    document.handles.push_back({.name = "", .select = {VertexSelector{{24}}}, .motion = AffineMotion{}});
    EXPECT_THAT(refusal(document), HasSubstr("called \"handle-1\""));
}

TEST(SceneConstraints, AMeshFileLiesBesideTheScene) {
    const test::TemporaryFolder folder;
    save_surface(folder.path() / "cube.obj", make_box(2));
    Document document = cube_document();
    document.mesh = MeshFile{"cube.obj"};
    const auto scene_file = folder.path() / "scene.json";
    const SceneMesh mesh = load(document.mesh, scene_file);
    EXPECT_EQ(mesh.checked.mesh.n_vertices(), 26);
    EXPECT_THAT(mesh.name, HasSubstr("cube.obj"));
}

TEST(SceneConstraints, PrimitivesThatCannotBeMadeAreErrorsOfTheScene) {
    const auto refused = [](std::vector<double> size) {
        return finding([&] { load(Primitive{"cylinder", 4, std::move(size)}, "s.json"); });
    };
    EXPECT_THAT(refused({1, 2, 3, 4}), HasSubstr("s.json: /mesh: "));
    EXPECT_THAT(refused({1e-9, 1e9}), HasSubstr("s.json: /mesh: "));
}

TEST(SceneConstraints, OnlyFemRefusesAnIncompressibleMaterial) {
    Document document = cube_document();
    document.material.poisson_ratio = 0.5;
    const auto body = [&](MethodKind kind) {
        return finding([&] { require_material(document.material, kind, "s.json"); });
    };
    EXPECT_THAT(body(kFem), HasSubstr("s.json: /material/poisson_ratio: FEM needs"));
    EXPECT_EQ(body(kLinearBem), "");
    EXPECT_EQ(body(kConstantBem), "");
}

}  // namespace
}  // namespace elastolab
