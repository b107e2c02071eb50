#include "scene/file/scene_file.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "methods/registry.hpp"
#include "scene/motion.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Every kind of thing that a scene can hold, with numbers that decimal digits hold badly.
Document everything() {
    Document document;
    document.mesh = Primitive{.name = "box", .resolution = 3, .size = {1.0, 0.1, 1.0 / 3.0}};
    document.material = {.young_modulus = 1.0e5 / 3.0, .poisson_ratio = 0.49999999999999994};
    document.method = kConstantBem;
    const Selector box{BoxSelector{.min = {-1e-300, 0.1, -3}, .max = {0.2, 0.7, 1e300}}};
    const Selector plane{PlaneSelector{.point = {0, 0, 0.3}, .normal = {0, 0, -2}, .tolerance = 1e-9}};
    document.fixed = {{.select = {std::vector<Selector>{box, Selector{std::vector<Selector>{plane}}}}}};
    document.handles.push_back(
        {.name = "ear \"left\", \xC3\xA4",
         .select = {SphereSelector{.center = {0, 1, 0}, .radius = 0.1}},
         .motion = AffineMotion{.matrix = Eigen::Matrix3d::Constant(-1.0 / 7.0), .translate = {0.1, 0, 5e-324}}});
    document.handles.push_back(
        {.name = "turned",
         .select = {VertexSelector{{5}}},
         .motion =
             AffineMotion{.matrix = 0.1 * Eigen::Matrix3d::Identity(),
                          .translate = {0, 1.0 / 3.0, 0},
                          .rotate = {.axis = {0, 0.1, -2.0 / 3.0}, .degrees = -720.1, .center = {1.0 / 7.0, 0, 3}}}});
    document.handles.push_back({.name = "",
                                .select = {VertexSelector{{7, 3, 2000000000}}},
                                .motion = VertexMotion{{{0.1, 0.2, 0.3}, {0, -0.0, 1}, {1, 2, 3}}}});
    return document;
}

TEST(SceneFile, IsReadBackExactly) {
    const Document document = everything();
    EXPECT_TRUE(parse_scene(print_scene(document), "test") == document) << print_scene(document);
}

TEST(SceneFile, KeepsTheCameraExactlyAndApartFromTheProblem) {
    Document document = everything();
    document.camera = ViewPoint{
        .eye = {1.0 / 3.0, -2e-300, 7}, .target = {0.1, 0.2, 0.3}, .up = {0, 1, 1.0 / 7.0}, .vertical = {0, 1, 0}};
    const Document read = parse_scene(print_scene(document), "test");
    EXPECT_EQ(read.camera, document.camera);
    EXPECT_EQ(read, everything()) << "where it is looked at from is no part of the problem";
    EXPECT_FALSE(parse_scene(print_scene(everything()), "test").camera) << "files without one stay without";
}

TEST(SceneFile, KeepsTheFieldAndTheCutExactlyAndApartFromTheProblem) {
    Document document = everything();
    for (const std::string& known : field_names()) {
        document.shown = Shown{.field = *parse_field(known)};
        EXPECT_EQ(parse_scene(print_scene(document), "test").shown, document.shown) << known;
    }
    document.shown->range = {1.0 / 3.0, -2e-300};
    document.shown->cut = Cut{.axis = 2, .turn = 0.1, .tilt = -1.0 / 7.0, .place = 1.0, .flip = true};
    const Document read = parse_scene(print_scene(document), "test");
    EXPECT_EQ(read.shown, document.shown);
    EXPECT_EQ(read, everything()) << "what is shown of it is no part of the problem";
    EXPECT_FALSE(parse_scene(print_scene(everything()), "test").shown) << "files without one stay without";
}

TEST(SceneFile, IsWrittenTheSameAfterReading) {
    const std::string text = print_scene(everything());
    EXPECT_EQ(print_scene(parse_scene(text, "test")), text);
}

TEST(SceneFile, IsSavedInOneStepAndLoaded) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("scene.json", "before");
    save_scene(file, everything());
    EXPECT_TRUE(load_scene(file) == everything());
    EXPECT_THAT(folder.listing(), ElementsAre("scene.json"));
}

TEST(SceneFile, HasDefaultsForAllButVersionAndMesh) {
    const Document document = parse_scene(R"({"elastolab": 1, "mesh": {"file": "bunny.obj"}})", "test");
    EXPECT_EQ(std::get<MeshFile>(document.mesh).file, "bunny.obj");
    EXPECT_EQ(document.method, kLinearBem);
    EXPECT_EQ(document.material.poisson_ratio, 0.3);
    EXPECT_TRUE(document.fixed.empty());
    EXPECT_TRUE(document.handles.empty());
}

TEST(SceneFile, ReadsTheExampleOfTheReadme) {
    const Document document = parse_scene(R"({
      "elastolab": 1,
      "mesh": { "file": "bunny.obj" },
      "material": { "young_modulus": 1.0e5, "poisson_ratio": 0.3 },
      "method": "linear-bem",
      "fixed": { "box": { "min": [-1, -1, -1], "max": [0.001, 2, 2] } },
      "handles": [
        { "name": "ear", "select": { "sphere": { "center": [0, 1, 0], "radius": 0.1 } }, "translate": [0.1, 0, 0] },
        { "select": { "vertices": [12, 13] }, "matrix": [[0,0,0],[0,0,-0.2],[0,0.2,0]], "translate": [0, 0, 0] },
        { "select": { "vertices": [40, 41] }, "displacements": [[0.1, 0, 0], [0.2, 0, 0]] }
      ]
    })",
                                          "test");
    ASSERT_EQ(document.handles.size(), 3U);
    EXPECT_EQ(document.handles[0].name, "ear");
    EXPECT_EQ(std::get<AffineMotion>(document.handles[1].motion).matrix(1, 2), -0.2);
    EXPECT_EQ(std::get<VertexMotion>(document.handles[2].motion).displacements[1].x(), 0.2);
}

TEST(SceneFile, ReadsATurnAndWritesNoneWhereThereIsNone) {
    const auto parsed = [](const std::string& rotate) {
        return parse_scene(R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 2}, "handles": [
            {"select": {"vertices": [0]}, "rotate": )" +
                               rotate + "}]}",
                           "test");
    };
    const auto motion =
        std::get<AffineMotion>(parsed(R"({"axis": [0, 0, 2], "degrees": 810, "center": [1, 0, 0]})").handles[0].motion);
    EXPECT_EQ(motion.rotate, (Rotation{.axis = {0, 0, 2}, .degrees = 810, .center = {1, 0, 0}}));
    EXPECT_LT((map_of(motion).displacement({2, 0, 0}) - Eigen::Vector3d(-1, 1, 0)).norm(), 1e-12);
    const Document about_origin = parsed(R"({"axis": [1, 0, 0], "degrees": 5})");
    EXPECT_TRUE(std::get<AffineMotion>(about_origin.handles[0].motion).rotate.center.isZero(0.0));
    Document none = about_origin;
    none.handles[0].motion = AffineMotion{};
    EXPECT_THAT(print_scene(none), Not(HasSubstr("rotate")));
}

TEST(SceneFile, NamesThePathOfATurnThatCannotBe) {
    const auto finding = [](const std::string& motion) -> std::string {
        try {
            parse_scene(R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 2}, "handles": [
                {"select": {"vertices": [0]}, )" +
                            motion + "}]}",
                        "test");
        } catch (const SceneError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(finding(R"("rotate": {"axis": [0, 0, 0], "degrees": 5})"),
                HasSubstr("/handles/0/rotate/axis: is zero"));
    EXPECT_THAT(finding(R"("rotate": {"degrees": 5})"), HasSubstr("/handles/0/rotate/axis: is missing"));
    EXPECT_THAT(finding(R"("rotate": {"axis": [0, 0, 1]})"), HasSubstr("/handles/0/rotate/degrees: is missing"));
    EXPECT_THAT(finding(R"("rotate": {"axis": [0, 0, 1], "degrees": 1e999})"), HasSubstr("test: "));
    EXPECT_THAT(finding(R"("rotate": {"axis": [0, 0, 1], "degrees": "90"})"), HasSubstr("/handles/0/rotate/degrees"));
    EXPECT_THAT(finding(R"("rotate": {"axis": [0, 0, 1], "degrees": 9, "angle": 1})"),
                HasSubstr("/handles/0/rotate/angle: is not a key"));
    EXPECT_THAT(finding(R"("rotate": {"axis": [0, 0, 1], "degrees": 9}, "displacements": [[0, 0, 0]])"),
                HasSubstr("/handles/0: has both displacements"));
}

std::string scene_with_fixed(const std::string& fixed) {
    return R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 2}, "fixed": )" + fixed + "}";
}

TEST(SceneFile, KeepsNamedFixedSetsInTheirOrder) {
    Document document = everything();
    document.fixed = {{.name = "left", .select = {VertexSelector{{0, 4}}}},
                      {.select = {VertexSelector{{7}}}},
                      {.name = "\xC3\xA4", .select = {SphereSelector{.center = {0, 0, 0}, .radius = 0.5}}}};
    EXPECT_TRUE(parse_scene(print_scene(document), "test") == document) << print_scene(document);
    document.fixed.resize(1);
    EXPECT_TRUE(parse_scene(print_scene(document), "test") == document) << "one alone has a name, too";
}

TEST(SceneFile, ReadsASelectorOrAListOfSelectorsAsOneFixedSetWithoutAName) {
    const Selector corner{VertexSelector{{0}}}, other{VertexSelector{{1, 2}}};
    const auto fixed = [](const std::string& text) { return parse_scene(scene_with_fixed(text), "test").fixed; };
    EXPECT_EQ(fixed(R"({"vertices": [0]})"), std::vector<FixedSet>{{.select = corner}});
    EXPECT_EQ(fixed(R"([{"vertices": [0]}, {"vertices": [1, 2]}])"),
              (std::vector<FixedSet>{{.select = {std::vector<Selector>{corner, other}}}}));
    EXPECT_EQ(fixed(R"([{"select": {"vertices": [0]}}, {"name": "b", "select": {"vertices": [1, 2]}}])"),
              (std::vector<FixedSet>{{.select = corner}, {.name = "b", .select = other}}));
}

TEST(SceneFile, WritesASingleFixedSetWithoutANameOfItsOwnAsBefore) {
    Document document = parse_scene(scene_with_fixed(R"({"vertices": [5]})"), "test");
    const std::string text = print_scene(document);
    EXPECT_THAT(text, Not(HasSubstr("select")));
    document.fixed.front().name = "fixed";  // as the viewer calls it
    EXPECT_EQ(print_scene(document), text);
}

TEST(SceneFile, CannotHoldNamesThatAreNotUtf8) {
    Document document = everything();
    document.mesh = MeshFile{"caf\xE9.obj"};
    const test::TemporaryFolder folder;
    const auto file = folder.write("scene.json", "before");
    EXPECT_THROW(save_scene(file, document), SceneError);
    EXPECT_EQ(test::read_text(file), "before");
}

TEST(SceneFile, SaysWhatIsWrongWithTheFileItself) {
    const test::TemporaryFolder folder;
    const auto finding = [](const std::filesystem::path& file) -> std::string {
        try {
            load_scene(file);
        } catch (const SceneError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(finding(folder.path() / "none.json"), HasSubstr("none.json: there is no such file"));
    EXPECT_THAT(finding(folder.path()), HasSubstr("is a folder"));
    EXPECT_THAT(finding(folder.write("empty.json", "")), HasSubstr("is empty"));
    EXPECT_THAT(finding("/dev/null"), HasSubstr("is no file"));
}

TEST(SceneFile, IsKnownByItsExtensionInAnyCase) {
    EXPECT_TRUE(is_scene_file("/a/beam.json"));
    EXPECT_TRUE(is_scene_file("beam.JSON"));
    EXPECT_FALSE(is_scene_file("beam.obj"));
    EXPECT_FALSE(is_scene_file("json"));
}

}  // namespace
}  // namespace elastolab
