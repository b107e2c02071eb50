// Whatever triangles a file has can be pulled: made files of every kind of defect, from 1 to 1e6 triangles, through the
// real program.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/program.hpp"
#include "mesh/input/export.hpp"
#include "mesh/meshes.hpp"

namespace elastolab {
namespace {

using test::run_program;

struct AnyMesh {
    std::string name;
    std::function<SurfaceMesh()> make;
};
void PrintTo(const AnyMesh& mesh, std::ostream* out) { *out << mesh.name; }

SurfaceMesh stretched(SurfaceMesh mesh, const Eigen::Vector3d& by) {
    mesh.vertices = by.asDiagonal() * mesh.vertices;
    return mesh;
}

std::vector<AnyMesh> shapes() {
    return {{"Ball", [] { return make_sphere(6); }},
            {"LumpyBall", [] { return make_lumpy_ball(7); }},
            {"Box", [] { return make_box(3); }},
            {"Cylinder", [] { return make_cylinder(4); }},
            {"Torus", [] { return make_torus(3); }},
            {"HollowBall", [] { return make_hollow_sphere(4); }},
            {"Beam",
             [] {
                 return make_box(2, {4, 1, 1});
             }},
            {"Plate",
             [] {
                 return make_box(1, {1, 1, 0.1});
             }},
            {"FlatBall", [] {
                 return stretched(make_sphere(6), {1, 1, 0.15});
             }}};
}

/// What careless exporters, scanners and modellers do to them.
std::vector<std::pair<std::string, std::function<SurfaceMesh(const SurfaceMesh&)>>> defects() {
    const Eigen::Vector3d aslant = Eigen::Vector3d(1, 2, 3).normalized();
    return {
        {"Sound", [](const SurfaceMesh& m) { return m; }},
        {"WithAHole",
         [=](const SurfaceMesh& m) {
             return with_hole(m, aslant, 0.8 * (aslant.transpose() * m.vertices).maxCoeff());
         }},
        {"Shell", [=](const SurfaceMesh& m) { return with_hole(m, aslant, (aslant.transpose() * m.vertices).mean()); }},
        {"FlippedAndRepeated", [](const SurfaceMesh& m) { return carelessly_exported(m); }},
        {"Torn", [](const SurfaceMesh& m) { return torn(m, 0.01); }},
        {"CrossingItself",
         [](const SurfaceMesh& m) {
             return joined(m, moved(m, {0.31, 0.17, 0.23}));
         }},
        {"InsideOutAndFar", [](const SurfaceMesh& m) {
             return moved(inside_out(m), {1e4, -2e4, 3e4});
         }}};
}

SurfaceMesh triangles_at_random(int n) {
    SurfaceMesh mesh{Positions(3, 3 * n), Triangles(3, n)};
    std::mt19937 random(7);
    std::normal_distribution<double> place;
    for (int v = 0; v < 3 * n; ++v) {
        for (int axis = 0; axis < 3; ++axis) mesh.vertices(axis, v) = place(random);
        mesh.triangles(v % 3, v / 3) = v;
    }
    return mesh;
}

/// Twelve pages on one spine.
SurfaceMesh book() {
    SurfaceMesh mesh{Positions(3, 26), Triangles(3, 24)};
    mesh.vertices.col(0) = Eigen::Vector3d(0, 0, 0);
    mesh.vertices.col(1) = Eigen::Vector3d(0, 0, 1);
    for (int page = 0; page < 12; ++page) {
        const Eigen::Vector3d out(std::cos(0.4 * page), std::sin(0.4 * page), 0);
        mesh.vertices.col(2 + 2 * page) = out;
        mesh.vertices.col(3 + 2 * page) = out + Eigen::Vector3d::UnitZ();
        mesh.triangles.col(2 * page) = Eigen::Vector3i(0, 2 + 2 * page, 1);
        mesh.triangles.col(2 * page + 1) = Eigen::Vector3i(1, 2 + 2 * page, 3 + 2 * page);
    }
    return mesh;
}

SurfaceMesh moebius_strip(int n) {
    SurfaceMesh mesh{Positions(3, 2 * n), Triangles(3, 2 * n)};
    for (int i = 0; i < n; ++i) {
        const double a = 2.0 * M_PI * i / n;
        const Eigen::Vector3d radial(std::cos(a), std::sin(a), 0);
        const Eigen::Vector3d across = std::cos(a / 2) * radial + std::sin(a / 2) * Eigen::Vector3d::UnitZ();
        for (int side = 0; side < 2; ++side) mesh.vertices.col(2 * i + side) = radial + (side - 0.5) * 0.6 * across;
        const bool last = i == n - 1;
        const int a0 = 2 * i, a1 = 2 * i + 1, b0 = last ? 1 : 2 * i + 2, b1 = last ? 0 : 2 * i + 3;
        mesh.triangles.col(2 * i) = Eigen::Vector3i(a0, b0, a1);
        mesh.triangles.col(2 * i + 1) = Eigen::Vector3i(a1, b0, b1);
    }
    return mesh;
}

SurfaceMesh first_triangles(SurfaceMesh mesh, int n) {
    mesh.triangles = mesh.triangles.leftCols(n).eval();
    return mesh;
}

std::vector<AnyMesh> corpus() {
    std::vector<AnyMesh> all = {{"OneTriangle", [] { return first_triangles(make_box(1), 1); }},
                                {"TwoTriangles", [] { return first_triangles(make_box(1), 2); }},
                                {"TriangleNearlyOnALine",
                                 [] {
                                     return stretched(first_triangles(make_box(1), 1), {1, 1e-3, 1e-3});
                                 }},
                                {"SoupOf60", [] { return triangles_at_random(60); }},
                                {"Book", book},
                                {"MoebiusStrip", [] { return moebius_strip(24); }},
                                {"Tiny", [] { return scaled(torn(make_sphere(4), 0.01), 1e-9); }},
                                {"Huge", [] { return scaled(torn(make_sphere(4), 0.01), 1e12); }},
                                {"LooseVertices",
                                 [] {
                                     return with_vertex(with_hole(make_box(3), {0, 0, 1}, 0.9), {0.5, 0.5, 0.5});
                                 }},
                                {"Of100000Triangles",
                                 [] {
                                     return with_hole(make_sphere(112), {0, 0, 1}, 0.99);
                                 }},
                                {"Of1000000Triangles", [] { return make_sphere(354); }}};
    for (const AnyMesh& shape : shapes())
        for (const auto& [name, spoil] : defects())
            all.push_back({shape.name + name, [=] { return spoil(shape.make()); }});
    return all;
}

/// The scene holds the lowest part of the body along its longest axis and moves the highest by a tenth of its length.
struct Pull {
    Eigen::Vector3d by;
    std::string scene;
};
Pull pull(const SurfaceMesh& mesh, const std::string& file) {
    const Positions used = mesh.vertices(Eigen::all, mesh.triangles.reshaped());
    const Eigen::Vector3d low = used.rowwise().minCoeff(), high = used.rowwise().maxCoeff(), size = high - low;
    Eigen::Index axis = 0;
    const double length = size.maxCoeff(&axis);
    const auto box = [&](double from, double to) {
        Eigen::Vector3d min = low.array() - 0.1 * length, max = high.array() + 0.1 * length;
        min[axis] = low[axis] + from * length;
        max[axis] = low[axis] + to * length;
        const auto list = [](const Eigen::Vector3d& x) { return nlohmann::json::array({x[0], x[1], x[2]}); };
        return nlohmann::json{{"box", {{"min", list(min)}, {"max", list(max)}}}};
    };
    const Eigen::Vector3d by = 0.1 * length * Eigen::Vector3d::Unit((axis + 1) % 3);
    nlohmann::json scene = {{"elastolab", 1}, {"mesh", {{"file", file}}}, {"fixed", box(-0.1, 0.2)}};
    scene["handles"] = {{{"select", box(0.8, 1.1)}, {"translate", {by[0], by[1], by[2]}}}};
    return {by, scene.dump()};
}

class AnyTrianglesOfAFile : public testing::TestWithParam<AnyMesh> {};
INSTANTIATE_TEST_SUITE_P(Corpus, AnyTrianglesOfAFile, testing::ValuesIn(corpus()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(AnyTrianglesOfAFile, CanBePulled) {
    const test::TemporaryFolder folder;
    const SurfaceMesh mesh = GetParam().make();
    const std::size_t seed = std::hash<std::string>{}(GetParam().name);
    const std::string file = seed % 2 == 0 ? "mesh.ply" : "mesh.obj";
    save_surface(folder.path() / file, mesh);
    const Pull pulled = pull(mesh, file);
    folder.write("scene.json", pulled.scene);
    const std::string method = seed % 3 == 0 ? "fem" : "linear-bem";
    const char* proxy = mesh.n_triangles() > 50000 ? "always" : "auto";  // sound, but too large for these methods
    const auto run = run_program({"solve", "scene.json", "--method", method, "--proxy", proxy, "--proxy-vertices",
                                  "200", "--quiet", "--displacements", "u.csv"},
                                 folder.path());
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const test::Table table = test::read_csv(folder.path() / "u.csv");
    ASSERT_FALSE(table.rows.empty());
    const double size = pulled.by.norm();
    int n_held = 0, n_pulled = 0;
    for (const std::vector<double>& row : table.rows) {
        const Eigen::Vector3d u(row[3], row[4], row[5]);
        ASSERT_TRUE(u.allFinite());
        EXPECT_LT(u.norm(), 5.0 * size);
        n_held += u.norm() == 0.0 ? 1 : 0;
        n_pulled += (u - pulled.by).norm() <= 1e-12 * size ? 1 : 0;
    }
    EXPECT_GT(n_held, 0);
    EXPECT_GT(n_pulled, 0);
}

TEST(VerticesThatAreNotFinite, AreLeftOutWithTheirTriangles) {
    const test::TemporaryFolder folder;
    SurfaceMesh ball = make_sphere(6);
    const Pull pulled = pull(ball, "mesh.ply");
    folder.write("scene.json", pulled.scene);
    ball.vertices(1, 7) = std::nan("");
    ball.vertices(0, 40) = HUGE_VAL;
    save_surface(folder.path() / "mesh.ply", ball);
    const std::vector<std::string> solve = {
        "solve", "scene.json", "--quiet", "--displacements", "u.csv", "--report", "r.json", "--proxy-vertices", "300"};
    const auto run = run_program(solve, folder.path());
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json report = nlohmann::json::parse(std::ifstream(folder.path() / "r.json"));
    EXPECT_NE(report["warnings"].dump().find("2 vertices have coordinates that are not finite"), std::string::npos)
        << report["warnings"];
    int n_pulled = 0;
    for (const std::vector<double>& row : test::read_csv(folder.path() / "u.csv").rows) {
        const Eigen::Vector3d x(row[0], row[1], row[2]), u(row[3], row[4], row[5]);
        ASSERT_TRUE(x.allFinite() && u.allFinite());
        EXPECT_LT(u.norm(), 5.0 * pulled.by.norm());
        n_pulled += (u - pulled.by).norm() <= 1e-12 * pulled.by.norm() ? 1 : 0;
    }
    EXPECT_GT(n_pulled, 0);
    std::vector<std::string> exactly = solve;
    exactly.insert(exactly.end(), {"--proxy", "never"});
    EXPECT_NE(run_program(exactly, folder.path()).exit_code, 0);
}

/// The same pull of a ball with two holes that are filled on request, and of the whole one.
TEST(HolesOfAFile, AreFilledOnRequest) {
    const test::TemporaryFolder folder;
    const SurfaceMesh ball = make_sphere(6);
    const auto solved = [&](const SurfaceMesh& mesh, const char* proxy) {
        save_surface(folder.path() / "mesh.ply", mesh);
        folder.write("scene.json", pull(ball, "mesh.ply").scene);
        return run_program({"solve", "scene.json", "--method", "galerkin-bem", "--proxy", proxy, "--quiet", "--report",
                            "r.json", "--displacements", "u.csv"},
                           folder.path());
    };
    const auto displacements = [&] {
        std::vector<Eigen::Vector3d> u;
        for (const std::vector<double>& row : test::read_csv(folder.path() / "u.csv").rows)
            u.emplace_back(row[3], row[4], row[5]);
        return u;
    };
    ASSERT_EQ(solved(ball, "never").exit_code, 0);
    const std::vector<Eigen::Vector3d> expected = displacements();
    // Vertices beside a hole, where it is neither held nor pulled.
    const SurfaceMesh open = with_hole(with_hole(ball, {0, 0, 1}, 0.93), {0, 1, 0.1}, 0.9);
    const auto run = solved(open, "fill");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json report = nlohmann::json::parse(std::ifstream(folder.path() / "r.json"));
    EXPECT_EQ(report["proxy"]["largest_distance"], 0.0);
    EXPECT_NE(report["warnings"].dump().find("2 holes filled"), std::string::npos) << report["warnings"];
    const std::vector<Eigen::Vector3d> u = displacements();
    std::set<int> used;  // the file has no others
    for (const int v : open.triangles.reshaped()) used.insert(v);
    ASSERT_EQ(u.size(), used.size());
    double off = 0.0, size = 0.0;
    for (std::size_t i = 0; const int v : used) {
        const Eigen::Vector3d& whole = expected[static_cast<std::size_t>(v)];
        off += (u[i++] - whole).squaredNorm();
        size += whole.squaredNorm();
    }
    EXPECT_LT(std::sqrt(off / size), 0.01);
    EXPECT_NE(solved(first_triangles(open, 20), "fill").exit_code, 0);  // no solid, whatever is filled
}

}  // namespace
}  // namespace elastolab
