#include <gmock/gmock.h>

#include <ostream>

#include "base/error.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A scene file that must be refused, with the place and a part of the finding.
struct BadScene {
    const char* name;
    const char* text;
    const char* place;
    const char* finding;
};

void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.text; }

std::string complaint(const std::string& text) {
    try {
        parse_scene(text, "scene.json");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no complaint";
}

std::string case_name(const testing::TestParamInfo<BadScene>& tested) { return tested.param.name; }

class BadSceneTest : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, IsRefusedWithItsPlaceAndAWayForward) {
    const std::string text = complaint(GetParam().text);
    EXPECT_THAT(text, StartsWith(std::string("scene.json: ") + GetParam().place));
    EXPECT_THAT(text, HasSubstr(GetParam().finding));
    EXPECT_THAT(text, Not(HasSubstr("\n")));
    EXPECT_THAT(text, testing::EndsWith("."));
}

#define ROOT(rest) R"({"elastolab": 1, "mesh": {"file": "a.obj"}, )" rest "}"
#define MESH(mesh) R"({"elastolab": 1, "mesh": )" mesh "}"
#define FIXED(selector) ROOT(R"("fixed": )" selector)
#define HANDLE(handle) ROOT(R"("handles": [)" handle "]")
#define LOAD(load) ROOT(R"("loads": [)" load "]")
#define SELECT R"("select": {"vertices": [1]})"

INSTANTIATE_TEST_SUITE_P(
    ShownOfIt, BadSceneTest,
    testing::Values(
        BadScene{"NotAnObject", ROOT(R"("shown": "von-mises")"), "/shown", "must be an object"},
        BadScene{"UnknownKey", ROOT(R"("shown": {"colour": "von-mises"})"), "/shown", "colour"},
        BadScene{"UnknownField", ROOT(R"("shown": {"field": "heat"})"), "/shown/field", "is not a known field"},
        BadScene{"HalfARange", ROOT(R"("shown": {"field": "traction", "range": [1]})"), "/shown/range", "2"},
        BadScene{"NoAxis", ROOT(R"("shown": {"cut": {"place": 0.5}})"), "/shown/cut/axis", "is missing"},
        BadScene{"TwoAxes", ROOT(R"("shown": {"cut": {"axis": "xy"}})"), "/shown/cut/axis", "none of x, y, z"},
        BadScene{"EmptyAxis", ROOT(R"("shown": {"cut": {"axis": ""}})"), "/shown/cut/axis", "none of x, y, z"},
        BadScene{"CutOutside", ROOT(R"("shown": {"cut": {"axis": "x", "place": 1.5}})"), "/shown/cut/place",
                 "between 0 and 1"},
        BadScene{"FlipIsANumber", ROOT(R"("shown": {"cut": {"axis": "x", "flip": 1}})"), "/shown/cut/flip",
                 "true or false"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Syntax, BadSceneTest,
    testing::Values(
        BadScene{"Truncated", "{\"elastolab\": 1,\n \"mesh\": {", "line 2, column 10", "unexpected end of input"},
        BadScene{"NotJson", "v 0 0 0\n", "line 1, column 1", "invalid literal"},
        BadScene{"TrailingText", R"({"elastolab": 1, "mesh": {"file": "a.obj"}} x)", "line 1", "invalid literal"},
        BadScene{"Comment", "{ // comment\n}", "line 1", "invalid literal"},
        BadScene{"NaN", ROOT(R"("material": {"young_modulus": NaN})"), "line 1", "invalid literal"},
        BadScene{"Overflow", ROOT("\n\"material\": {\"young_modulus\": 1e999}"), "line 2", "number overflow"},
        BadScene{"BadUtf8", "{\"\xff\": 1}", "line 1", "ill-formed UTF-8"},
        BadScene{"DuplicateKey", R"({"elastolab": 1, "elastolab": 1})", "/elastolab", "appears twice"},
        BadScene{"NestedDuplicateKey", HANDLE(R"({"select": {"box": {"min": 1, "min": 2}}})"),
                 "/handles/0/select/box/min", "appears twice"},
        BadScene{"Array", "[1]", "must be an object", "is [1]"}, BadScene{"Null", "null", "must be an object", "null"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Loads, BadSceneTest,
    testing::Values(
        BadScene{"Gravity", ROOT(R"("gravity": 9.81)"), "/gravity", "must be"},
        BadScene{"NoDensity", ROOT(R"("density": 0)"), "/density", "is 0"},
        BadScene{"NotAList", ROOT(R"("loads": {})"), "/loads", "must be"},
        BadScene{"UnknownKey", LOAD("{" SELECT R"(, "presure": 1})"), "/loads/0", "presure"},
        BadScene{"NoSelection", LOAD(R"({"pressure": 1})"), "/loads/0/select", "is missing"},
        BadScene{"NoKind", LOAD("{" SELECT "}"), "/loads/0", "has 0"},
        BadScene{"TwoKinds", LOAD("{" SELECT R"(, "pressure": 1, "force": [0, 0, 1]})"), "/loads/0", "has 2"},
        BadScene{"WrongType", LOAD("{" SELECT R"(, "pressure": [1]})"), "/loads/0/pressure", "must be"},
        BadScene{"SameName",
                 LOAD(R"({"name": "a", "pressure": 1, )" SELECT R"(}, {"name": "a", "pressure": 1, )" SELECT "}"),
                 "/loads/1/name", "already"},
        BadScene{"ForceAndMotion", HANDLE("{" SELECT R"(, "force": [0, 0, 1], "translate": [0, 0, 1]})"), "/handles/0",
                 "Keep one"},
        BadScene{"Moment", HANDLE("{" SELECT R"(, "moment": 1})"), "/handles/0/moment", "must be"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Root, BadSceneTest,
    testing::Values(BadScene{"NoVersion", R"({"mesh": {"file": "a.obj"}})", "/elastolab", "is missing"},
                    BadScene{"VersionText", R"({"elastolab": "1", "mesh": {}})", "/elastolab", "whole number"},
                    BadScene{"VersionZero", R"({"elastolab": 0, "mesh": {}})", "/elastolab", "must lie between"},
                    BadScene{"NewerVersion", R"({"elastolab": 2, "mesh": {}})", "/elastolab", "version 2"},
                    BadScene{"NoMesh", R"({"elastolab": 1})", "/mesh", "is missing"},
                    BadScene{"UnknownKey", ROOT(R"("handels": [])"), "/handels", "Known ones"},
                    BadScene{"KeyWithSlash", ROOT(R"("a/b~c": [])"), "/a~1b~0c", "Known ones"},
                    BadScene{"KeyWithLineBreak", ROOT(R"("a\nb": [])"), "/a b", "Known ones"},
                    BadScene{"UnknownMethod", ROOT(R"("method": "bem")"), "/method", "Known ones: fem"},
                    BadScene{"MethodNumber", ROOT(R"("method": 1)"), "/method", "must be a string"},
                    BadScene{"NoEye", ROOT(R"("camera": {"target": [0, 0, 0]})"), "/camera/eye", "is missing"},
                    BadScene{"EyeAtTarget", ROOT(R"("camera": {"eye": [1, 2, 3], "target": [1, 2, 3]})"), "/camera",
                             "the same point"},
                    BadScene{"UpAlongTheView", ROOT(R"("camera": {"eye": [0, 0, 3], "target": [0, 0, 1]})"), "/camera",
                             "along the viewing direction"},
                    BadScene{"NoVertical",
                             ROOT(R"("camera": {"eye": [0, 3, 0], "target": [0, 0, 0], "vertical": [0, 0, 0]})"),
                             "/camera/vertical", "no direction"},
                    BadScene{"HandlesObject", ROOT(R"("handles": {})"), "/handles", "must be an array"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Mesh, BadSceneTest,
    testing::Values(
        BadScene{"Text", MESH(R"("a.obj")"), "/mesh", "must be an object"},
        BadScene{"Empty", MESH("{}"), "/mesh", "neither"},
        BadScene{"Both", MESH(R"({"file": "a", "primitive": "cube", "resolution": 1})"), "/mesh", "both"},
        BadScene{"EmptyFile", MESH(R"({"file": ""})"), "/mesh/file", "is empty"},
        BadScene{"NullCharacter", MESH(R"({"file": "a\u0000b"})"), "/mesh/file", "null character"},
        BadScene{"FileNumber", MESH(R"({"file": 3})"), "/mesh/file", "must be a string"},
        BadScene{"FileWithResolution", MESH(R"({"file": "a", "resolution": 1})"), "/mesh/resolution", "Known ones"},
        BadScene{"UnknownPrimitive", MESH(R"({"primitive": "cone", "resolution": 1})"), "/mesh/primitive", "cube"},
        BadScene{"NoResolution", MESH(R"({"primitive": "cube"})"), "/mesh/resolution", "is missing"},
        BadScene{"ZeroResolution", MESH(R"({"primitive": "cube", "resolution": 0})"), "/mesh/resolution", "between 1"},
        BadScene{"HalfResolution", MESH(R"({"primitive": "cube", "resolution": 1.5})"), "/mesh/resolution", "whole"},
        BadScene{"AbsurdResolution", MESH(R"({"primitive": "cube", "resolution": 18446744073709551615})"),
                 "/mesh/resolution", "must lie between"},
        BadScene{"SizeNumber", MESH(R"({"primitive": "cube", "resolution": 1, "size": 1})"), "/mesh/size", "array"},
        BadScene{"NegativeSize", MESH(R"({"primitive": "cube", "resolution": 1, "size": [-1]})"), "/mesh/size/0",
                 "positive"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Material, BadSceneTest,
    testing::Values(BadScene{"Empty", ROOT(R"("material": {})"), "/material/young_modulus", "is missing"},
                    BadScene{"NoPoisson", ROOT(R"("material": {"young_modulus": 1})"), "/material/poisson_ratio",
                             "is missing"},
                    BadScene{"UnknownKey", ROOT(R"("material": {"nu": 0.3})"), "/material/nu", "Known ones"},
                    BadScene{"ZeroYoung", ROOT(R"("material": {"young_modulus": 0, "poisson_ratio": 0})"),
                             "/material/young_modulus", "must be positive, is 0"},
                    BadScene{"YoungText", ROOT(R"("material": {"young_modulus": "1", "poisson_ratio": 0})"),
                             "/material/young_modulus", "must be a number"},
                    BadScene{"PoissonTooLow", ROOT(R"("material": {"young_modulus": 1, "poisson_ratio": -1})"),
                             "/material/poisson_ratio", "above -1"},
                    BadScene{"PoissonTooHigh", ROOT(R"("material": {"young_modulus": 1, "poisson_ratio": 0.5000001})"),
                             "/material/poisson_ratio", "not above 0.5"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Selector, BadSceneTest,
    testing::Values(
        BadScene{"FixedSetWithoutSelector", FIXED(R"([{"name": "a"}])"), "/fixed/0/select", "is missing"},
        BadScene{"FixedSetAmongSelectors", FIXED(R"([{"vertices": [1]}, {"select": {"vertices": [2]}}])"),
                 "/fixed/1/select", "Known ones"},
        BadScene{"SelectorAmongFixedSets", FIXED(R"([{"select": {"vertices": [2]}}, {"vertices": [1]}])"),
                 "/fixed/1/vertices", "Known ones"},
        BadScene{"FixedSetNamedTwice", FIXED(R"([{"name": "a", )" SELECT R"(}, {"name": "a", )" SELECT "}]"),
                 "/fixed/1/name", "is the name of fixed set 0"},
        BadScene{"FixedSetWithEmptyName", FIXED(R"([{"name": "", )" SELECT "}]"), "/fixed/0/name", "is empty"},
        BadScene{"Number", FIXED("1"), "/fixed", "must be an object"}, BadScene{"None", FIXED("{}"), "/fixed", "has 0"},
        BadScene{"Two", FIXED(R"({"vertices": [1], "box": {}})"), "/fixed", "has 2"},
        BadScene{"EmptyList", FIXED("[]"), "/fixed", "selects nothing"},
        BadScene{"NoVertices", FIXED(R"({"vertices": []})"), "/fixed/vertices", "selects nothing"},
        BadScene{"NegativeVertex", FIXED(R"({"vertices": [0, -1]})"), "/fixed/vertices/1", "must lie between"},
        BadScene{"HalfVertex", FIXED(R"({"vertices": [0.5]})"), "/fixed/vertices/0", "whole number"},
        BadScene{"NoMin", FIXED(R"({"box": {"max": [0, 0, 0]}})"), "/fixed/box/min", "is missing"},
        BadScene{"TwoCoordinates", FIXED(R"({"box": {"min": [0, 0], "max": [1, 1, 1]}})"), "/fixed/box/min",
                 "must have 3 entries, has 2"},
        BadScene{"MinAboveMax", FIXED(R"({"box": {"min": [0, 2, 0], "max": [1, 1, 1]}})"), "/fixed/box", "along y"},
        BadScene{"NegativeRadius", FIXED(R"({"sphere": {"center": [0, 0, 0], "radius": -1}})"), "/fixed/sphere/radius",
                 "must be positive, is -1"},
        BadScene{"ZeroNormal", FIXED(R"({"plane": {"point": [0, 0, 0], "normal": [0, 0, 0], "tolerance": 0}})"),
                 "/fixed/plane/normal", "is zero"},
        BadScene{"NegativeTolerance",
                 FIXED(R"({"plane": {"point": [0, 0, 0], "normal": [0, 0, 1], "tolerance": -0.1}})"),
                 "/fixed/plane/tolerance", "negative"},
        BadScene{"InAList", FIXED(R"([{"vertices": [1]}, {"sphere": {"center": [0, 0, 0], "radius": 0}}])"),
                 "/fixed/1/sphere/radius", "must be positive"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Handle, BadSceneTest,
    testing::Values(
        BadScene{"NoSelect", HANDLE(R"({"translate": [0, 0, 0]})"), "/handles/0/select", "is missing"},
        BadScene{"EmptyName", HANDLE(R"({"name": "", )" SELECT "}"), "/handles/0/name", "is empty"},
        BadScene{"ReservedName", HANDLE(R"({"name": "fixed", )" SELECT "}"), "/handles/0/name", "another name"},
        BadScene{"SameName", HANDLE(R"({"name": "a", )" SELECT R"(}, {"name": "a", )" SELECT "}"), "/handles/1/name",
                 "handle 0"},
        BadScene{"TextTranslation", HANDLE("{" SELECT R"(, "translate": ["a", 0, 0]})"), "/handles/0/translate/0",
                 "must be a number"},
        BadScene{"BadMatrix", HANDLE("{" SELECT R"(, "matrix": [[0, 0, 0], [0, 0], [0, 0, 0]]})"),
                 "/handles/0/matrix/1", "must have 3 entries"},
        BadScene{"BothMotions", HANDLE("{" SELECT R"(, "translate": [0, 0, 0], "displacements": [[0, 0, 0]]})"),
                 "/handles/0", "both displacements and"},
        BadScene{"BadDisplacement", HANDLE("{" SELECT R"(, "displacements": [[0, 0]]})"), "/handles/0/displacements/0",
                 "must have 3 entries"}),
    case_name);

TEST(BadScene, IsRefusedWhenItIsNestedWithoutEnd) {
    std::string deep = R"({"elastolab": 1, "fixed": )";
    deep.append(100000, '[');
    EXPECT_THAT(complaint(deep), HasSubstr("nested deeper"));
}

TEST(BadScene, QuotesNoMoreThanALineHolds) {
    std::string text = R"({"elastolab": ")";
    text.append(100000, 'x').append("\"}");
    EXPECT_LT(complaint(text).size(), 200U);
    std::string key = R"({"elastolab": 1, ")";
    key.append(1000000, 'k').append("\": 1}");
    EXPECT_LT(complaint(key).size(), 500U);
}

TEST(BadScene, WithAHundredThousandKeysIsRefusedLikeAnyOther) {
    std::string text = R"({"elastolab": 1)";
    for (int i = 0; i < 300000; ++i) text += ", \"key" + std::to_string(i) + "\": 0";
    EXPECT_THAT(complaint(text + "}"), HasSubstr("/key0: is not a key that belongs here"));
    EXPECT_THAT(complaint(text + R"(, "key7": 0})"), HasSubstr("/key7: appears twice"));
}

}  // namespace
}  // namespace elastolab
