#include <gmock/gmock.h>

#include <array>
#include <ostream>

#include "cli/program.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr int kBadInput = 1, kBadUsage = 2;

/// A command that must be refused: its arguments, a file that it meets in its working folder, the exit code, and what
/// the one line on standard error names.
struct BadInput {
    const char* name;
    std::vector<std::string> arguments;
    std::string file, content;
    int exit_code;
    std::vector<std::string> findings;
};

void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }

/// A folder with a sound scene, a sound mesh, an output of an earlier run, and the file that the case is about; the
/// latter as a mesh, too, in the scene "mesh.json".
class BadInputTest : public testing::TestWithParam<BadInput> {
protected:
    BadInputTest() {
        folder_.write("good.json", test::cube_scene("linear-bem", 2));
        folder_.write("before.csv", "kept");
        folder_.write("no_folder", "");
        create_directory(folder_.path() / "folder.json");
        save_surface(folder_.path() / "cube.obj", make_box(2));
        folder_.write(GetParam().file, GetParam().content);
        folder_.write("mesh.json", R"({"elastolab": 1, "mesh": {"file": ")" + GetParam().file +
                                       R"("}, "fixed": {"vertices": [0, 1, 2]}})");
    }

    test::TemporaryFolder folder_;
};

TEST_P(BadInputTest, IsRefusedInOneLineAndChangesNoFile) {
    const std::vector<std::string> before = folder_.listing();
    const test::ProgramRun run = test::run_program(GetParam().arguments, folder_.path());
    EXPECT_EQ(run.exit_code, GetParam().exit_code) << run.err;
    EXPECT_THAT(run.err, StartsWith("elastolab: "));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.err.back(), '\n');
    EXPECT_EQ(run.out, "");
    for (const std::string& finding : GetParam().findings) EXPECT_THAT(run.err, HasSubstr(finding));
    EXPECT_EQ(folder_.listing(), before);
    EXPECT_EQ(test::read_text(folder_.path() / "before.csv"), "kept");
}

/// A scene that is read from input.json; results would go to before.csv.
BadInput scene(const char* name, std::string content, std::vector<std::string> findings) {
    return {name,         {"solve", "--displacements", "before.csv", "--forces", "new.csv", "input.json"},
            "input.json", std::move(content),
            kBadInput,    std::move(findings)};
}

/// The cube scene with some of its text replaced.
BadInput changed(const char* name, const std::string& from, const std::string& to, std::vector<std::string> findings,
                 const std::string& method = "linear-bem") {
    std::string content = test::cube_scene(method, 2);
    const std::size_t place = content.find(from);
    if (place == std::string::npos) throw std::logic_error("the cube scene has no " + from);
    return scene(name, content.replace(place, from.size(), to), std::move(findings));
}

/// A mesh that `method` cannot use itself.
BadInput mesh(const char* name, const std::string& file, std::string content, std::vector<std::string> findings,
              const std::string& method = "linear-bem") {
    findings.push_back(file);
    return {name,      {"solve", "--proxy", "never", "--method", method, "--displacements", "before.csv", "mesh.json"},
            file,      std::move(content),
            kBadInput, std::move(findings)};
}

/// A mesh that not even a proxy makes a body of.
BadInput shapeless(const char* name, std::string content) {
    return {name,        {"solve", "--proxy", "always", "--displacements", "before.csv", "mesh.json"},
            "input.obj", std::move(content),
            kBadInput,   {"input.obj"}};
}

BadInput usage(const char* name, std::vector<std::string> arguments, std::vector<std::string> findings) {
    return {name, std::move(arguments), "input.json", "", kBadUsage, std::move(findings)};
}

BadInput place(const char* name, std::vector<std::string> arguments, std::vector<std::string> findings) {
    return {name, std::move(arguments), "input.json", "", kBadInput, std::move(findings)};
}

/// A closed tetrahedron, moved by `shift` along x, its vertex numbers beginning after `first`, in the OBJ format.
std::string tetrahedron(double shift, int first) {
    std::string text;
    for (const char* v : {" 0 0\n", " 1 0\n", " 0 1\n"}) text += "v " + std::to_string(shift) + v;
    text += "v " + std::to_string(shift + 1.0) + " 0 0\n";
    for (const auto& f : {std::array{1, 4, 3}, std::array{1, 2, 4}, std::array{1, 3, 2}, std::array{2, 3, 4}})
        text += "f " + std::to_string(f[0] + first) + " " + std::to_string(f[1] + first) + " " +
                std::to_string(f[2] + first) + "\n";
    return text;
}

std::string case_name(const testing::TestParamInfo<BadInput>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Scene, BadInputTest,
    testing::Values(
        scene("Empty", "", {"input.json", "is empty"}),
        scene("Truncated", "{\"elastolab\": 1,", {"input.json: line 1"}),
        scene("NotJson", "solid cube\n", {"input.json: line 1, column 1"}),
        scene("Binary", std::string("\x00\x01\xff\xfe", 4), {"input.json: line 1"}),
        scene("Deep", std::string(200000, '['), {"nested deeper"}), scene("AnotherValue", "42", {"must be an object"}),
        changed("NoVersion", R"("elastolab": 1, )", "", {"/elastolab", "is missing"}),
        changed("NewerVersion", R"("elastolab": 1)", R"("elastolab": 7)", {"/elastolab", "version 7"}),
        changed("UnknownKey", R"("method")", R"("methode")", {"/methode"}),
        changed("DuplicateKey", R"("elastolab": 1)", R"("elastolab": 1, "elastolab": 1)", {"appears twice"}),
        changed("AThousandTurns", R"("translate": [0.1, 0, 0.05])",
                R"("rotate": {"axis": [1, 0, 0], "degrees": 360000})", {"/handles/0/rotate/degrees", "hundred turns"}),
        changed("Overflow", "1000", "1e400", {"line 1", "overflow"}),
        changed("DenormalYoung", "1000", "5e-324", {"/material/young_modulus", "keep all their digits"}),
        changed("NegativeYoung", "1000", "-1", {"/material/young_modulus", "must be positive"}),
        changed("PoissonOne", "0.3}", "1}", {"/material/poisson_ratio"}),
        changed("PoissonText", "0.3}", "\"0.3\"}", {"/material/poisson_ratio", "must be a number"}),
        changed("IncompressibleFem", "0.3}", "0.5}", {"/material/poisson_ratio", "FEM"}, "fem"),
        changed("UnknownMethod", "linear-bem", "quadratic-bem", {"/method", "quadratic-bem"}),
        changed("UnknownPrimitive", "\"cube\"", "\"teapot\"", {"/mesh/primitive", "teapot"}),
        changed("UnknownProxyUse", "\"method\"", R"("proxy": {"use": "perhaps"}, "method")", {"/proxy/use", "perhaps"}),
        changed("FewProxyVertices", "\"method\"", R"("proxy": {"vertices": 3}, "method")", {"/proxy/vertices"}),
        changed("ProxyWithAnotherKey", "\"method\"", R"("proxy": {"size": 30}, "method")", {"/proxy/size"}),
        changed("NoCells", "\"resolution\": 2", "\"resolution\": 0", {"/mesh/resolution"}),
        changed("TooManyCells", "\"resolution\": 2", "\"resolution\": 100000", {"/mesh/resolution"}),
        changed("TooThin", "\"resolution\": 2", R"("resolution": 100, "size": [1, 1, 1e9])", {"/mesh"}),
        changed("TooManySizes", "\"resolution\": 2", R"("resolution": 2, "size": [1, 1, 1, 1])", {"/mesh"}),
        changed("EmptyBox", R"("max": [0, 1, 1])", R"("max": [-1, 1, 1])", {"/fixed/box", "along x"}),
        changed("NothingFixed", R"("min": [0, 0, 0], "max": [0, 1, 1])", R"("min": [5, 5, 5], "max": [6, 6, 6])",
                {"/fixed/box", "selects nothing"}),
        changed("ZeroNormal", R"("normal": [1, 0, 0])", R"("normal": [0, 0, 0])", {"/handles/0/select/plane/normal"}),
        changed("VertexOutOfRange", R"({"box": {"min": [0, 0, 0], "max": [0, 1, 1]}})", R"({"vertices": [26]})",
                {"/fixed/vertices/0", "0 to 25"}),
        changed("TwiceConstrained", R"("max": [0, 1, 1])", R"("max": [1, 1, 1])", {"/handles/0/select", "/fixed"}),
        changed("WrongNumberOfDisplacements", R"("translate": [0.1, 0, 0.05])", R"("displacements": [[0, 0, 0]])",
                {"/handles/0/displacements", "9 selected"}),
        changed("TwoCoordinates", "[0.1, 0, 0.05]", "[0.1, 0.05]", {"/handles/0/translate"}),
        changed("InfiniteMotion", R"("translate": [0.1, 0, 0.05])",
                R"("matrix": [[1e308, 1e308, 1e308], [0, 0, 0], [0, 0, 0]], "translate": [1e308, 0, 0])",
                {"/handles/0", "beyond double precision"}),
        changed("FileAndPrimitive", R"("primitive")", R"("file": "cube.obj", "primitive")", {"/mesh", "both"}),
        changed("MissingMesh", R"("primitive": "cube", "resolution": 2)", R"("file": "none.obj")",
                {"none.obj", "no such file"}),
        changed("MeshIsAFolder", R"("primitive": "cube", "resolution": 2)", R"("file": "folder.json")",
                {"folder.json", "is a folder"})),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Mesh, BadInputTest,
    testing::Values(
        mesh("Empty", "input.obj", "", {"empty"}), mesh("Text", "input.obj", "this is not a mesh\n", {}),
        mesh("UnknownFormat", "input.xyzzy", "v 0 0 0\n", {}), mesh("NoExtension", "input", "v 0 0 0\n", {}),
        mesh("NoFaces", "input.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", {}),
        mesh("TruncatedPly", "input.ply",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0",
             {}),
        mesh("HugePly", "input.ply",
             "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n",
             {}),
        mesh("TruncatedStl", "input.stl", std::string(80, ' ') + std::string("\xff\xff\xff\x00", 4) + "abc", {}),
        mesh("BrokenGltf", "input.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"meshes\": [", {}),
        mesh("BrokenOff", "input.off", "OFF\n4 4 6\n0 0 0\n", {}),
        mesh("IndexOutOfRange", "input.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", {}),
        mesh("NaN", "input.obj", "v nan 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 0\nf 1 4 3\nf 1 2 4\nf 1 3 2\nf 2 3 4\n", {}),
        mesh("Overflow", "input.obj", "v 1e999 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 0\nf 1 4 3\nf 1 2 4\nf 1 3 2\nf 2 3 4\n",
             {}),
        mesh("OneTriangle", "input.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {"3 open edges"}),
        mesh("Hole", "input.obj", "v 0 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 0\nf 1 4 3\nf 1 2 4\nf 1 3 2\n", {"3 open edges"}),
        mesh("Fin", "input.obj", tetrahedron(0, 0) + "v -1 -1 -1\nf 1 2 5\n", {"edge"}),
        mesh("OnlyDegenerate", "input.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 3 2 1\n", {}),
        mesh("FlatBody", "input.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n", {}),
        mesh("MoebiusBand", "input.obj",
             "v 2 0 -.3\nv 2 0 .3\nv -1 1.7 -.3\nv -1 1.7 .3\nv -1 -1.7 -.3\nv -1 -1.7 .3\nf 1 3 4 2\nf 3 5 6 4\n"
             "f 5 2 1 6\n",
             {}),
        shapeless("NaNInEveryTriangle", "v nan 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 0\nf 1 4 3\nf 1 2 4\nf 1 3 2\n"),
        shapeless("OnALine", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 3 2 1\n"),
        shapeless("OnePoint", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"),
        mesh("CrossingParts", "input.obj", tetrahedron(0, 0) + tetrahedron(0.25, 4), {"cross"}, "fem")),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Usage, BadInputTest,
    testing::Values(
        usage("UnknownCommand", {"sovle", "good.json"}, {"sovle"}), usage("UnknownOption", {"--fast"}, {"--fast"}),
        usage("NoScene", {"solve"}, {"scene"}), usage("TwoScenes", {"solve", "good.json", "good.json"}, {"good.json"}),
        usage("NoMesh", {"info"}, {"file"}), usage("UnknownSolveOption", {"solve", "good.json", "--fast"}, {"--fast"}),
        usage("UnknownMethod", {"solve", "good.json", "--method", "fdm"}, {"--method", "fdm"}),
        usage("UnknownMode", {"solve", "good.json", "--mode", "half"}, {"--mode", "half"}),
        usage("UnknownTractions", {"solve", "good.json", "--tractions", "none"}, {"--tractions", "none"}),
        usage("TooFineRims", {"solve", "good.json", "--rims", "4"}, {"--rims"}),
        usage("UnknownUpdate", {"solve", "good.json", "--update", "eqn8"}, {"--update", "eqn8"}),
        usage("NoThreads", {"solve", "good.json", "--threads", "0"}, {"--threads"}),
        usage("HalfAThread", {"solve", "good.json", "--threads", "1.5"}, {"--threads"}),
        usage("MissingValue", {"solve", "good.json", "--report"}, {"--report"}),
        usage("EmptyName", {"solve", "good.json", "--report", ""}, {"--report"}),
        usage("FullVolumeOfBem", {"solve", "good.json", "--mode", "full-volume"}, {"full-volume", "FEM"}),
        usage("Eqn9OnDemand", {"solve", "good.json", "--update", "eqn9"}, {"eqn9", "mode full"}),
        usage("NoMatricesOnDemand", {"solve", "good.json", "--matrices", "m"}, {"--matrices", "--mode full"}),
        usage("UnknownMeshFormat", {"solve", "good.json", "--mesh-out", "m.dae"}, {"m.dae", ".obj"}),
        usage("UnknownProxyUse", {"solve", "good.json", "--proxy", "perhaps"}, {"--proxy", "perhaps"}),
        usage("ProxyOfTwo", {"solve", "good.json", "--proxy-vertices", "2"}, {"--proxy-vertices"}),
        usage("SameOutputTwice", {"solve", "good.json", "--forces", "a.csv", "--displacements", "./a.csv"}, {"a.csv"}),
        usage("OverwritesItsScene", {"solve", "good.json", "--report", "good.json"}, {"good.json", "input"})),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Place, BadInputTest,
    testing::Values(
        place("MissingScene", {"solve", "none.json"}, {"none.json", "no such file"}),
        place("SceneIsAFolder", {"solve", "folder.json"}, {"folder.json", "is a folder"}),
        place("SceneIsADevice", {"solve", "/dev/null"}, {"/dev/null"}),
        place("SceneIsAMesh", {"solve", "cube.obj"}, {"cube.obj: line 1"}),
        place("MissingInfo", {"info", "none.obj"}, {"none.obj"}),
        place("MissingInfoScene", {"info", "none.json"}, {"none.json"}),
        place("InfoOfAFolder", {"info", "folder.json"}, {"folder.json", "folder"}),
        place("MissingFolder", {"solve", "good.json", "--displacements", "none/u.csv"}, {"none/u.csv", "folder"}),
        place("FileAsFolder", {"solve", "good.json", "--report", "no_folder/r.json"}, {"no_folder/r.json"}),
        place("OutputIsAFolder", {"solve", "good.json", "--forces", "folder.json"}, {"folder.json", "is a folder"}),
        place("UnwritableFolder", {"solve", "good.json", "--mesh-out", "/proc/m.obj"}, {"/proc/m.obj"}),
        place("FullDisk", {"solve", "good.json", "--quiet", "--report", "/dev/full"}, {"/dev/full", "full"}),
        place("MatricesInAFile", {"solve", "good.json", "--mode", "full", "--matrices", "no_folder"}, {"no_folder"}),
        place("MatricesNowhere", {"solve", "good.json", "--mode", "full", "--matrices", "none/m"}, {"none/m"})),
    case_name);

}  // namespace
}  // namespace elastolab
