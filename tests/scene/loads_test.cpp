// Loads of scenes, and how they are carried to proxies.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "scene/loaded_cube.hpp"
#include "scene/solved_scene.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::named;
using test::refusal_of;
using test::solved;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(SceneLoads, AreReadAndWrittenAsTheyAre) {
    const Document document = loaded_cube();
    EXPECT_EQ(document.loads.size(), 3u);
    EXPECT_EQ(document.gravity, Eigen::Vector3d(0, 0, -9.81));
    EXPECT_EQ(std::get<PressureLoad>(document.loads[0].value).pressure, 3.0);
    const Document again = parse_scene(print_scene(document), "scene.json");
    EXPECT_TRUE(again == document);
    Document other = document;
    other.loads[1].value = ForceLoad{{5, 0, 2}};
    EXPECT_FALSE(other == document);
}

TEST(SceneLoads, StandInTheForcesTableAndBalance) {
    for (const MethodKind kind : {kFem, kGalerkinBem}) {
        const Solution solution = solved(loaded_cube(), kind);
        const GroupReaction& weight = named(solution.loads, "gravity");
        EXPECT_LT((weight.force - Eigen::Vector3d(0, 0, -2.0 * 9.81)).norm(), 1e-9);
        EXPECT_LT((weight.moment - Eigen::Vector3d(0.5, 0.5, 0.5).cross(weight.force)).norm(), 1e-9);
        EXPECT_LT((named(solution.loads, "above").force - Eigen::Vector3d(0, 0, -3)).norm(), 1e-12);
        EXPECT_LT((named(solution.loads, "load-1").force - Eigen::Vector3d(5, 0, 1)).norm(), 1e-12);
        EXPECT_LT((named(solution.loads, "side").force - Eigen::Vector3d(0, 1.5, 0)).norm(), 1e-12);
        EXPECT_LT(solution.imbalance.force, 1e-8) << name(kind);
        EXPECT_LT(solution.imbalance.moment, 1e-8) << name(kind);
        EXPECT_LT(*solution.residual, 1e-7);
        EXPECT_TRUE(solution.error_estimate.has_value());
    }
}

/// A softer cube, so that it matters where the loads act by now.
TEST(SceneLoads, BalanceUnderLargeDeformations) {
    Document document = loaded_cube();
    document.material.young_modulus = 100.0;
    document.loads[0].value = PressureLoad{30.0};
    const Solution solution = solved(document, kNonlinearFem);
    const GroupReaction& weight = named(solution.loads, "gravity");
    EXPECT_LT((weight.force - Eigen::Vector3d(0, 0, -2.0 * 9.81)).norm(), 1e-9);
    EXPECT_GT((weight.moment - Eigen::Vector3d(0.5, 0.5, 0.5).cross(weight.force)).norm(), 0.1) << "it has sunk";
    EXPECT_LT((named(solution.loads, "load-1").force - Eigen::Vector3d(5, 0, 1)).norm(), 1e-9);
    EXPECT_GT((named(solution.loads, "above").force - Eigen::Vector3d(0, 0, -30)).norm(), 1.0) << "it follows";
    EXPECT_LT(solution.imbalance.force, 1e-8);
    EXPECT_LT(solution.imbalance.moment, 1e-8);
    EXPECT_LT(*solution.residual, 1e-7);
    EXPECT_GT(*solution.compliance, 0.0);
    // Without handles half of the work is stored, but for what is not linear.
    document.material.young_modulus = 1e5;
    document.handles.clear();
    const Solution stiff = solved(document, kNonlinearFem, false);
    EXPECT_NEAR(2.0 * stiff.facts->energy, *stiff.compliance, 0.01 * *stiff.compliance);
    EXPECT_NEAR(*solved(document, kQuadraticFem, false).compliance, *stiff.compliance, 0.01 * *stiff.compliance);
}

TEST(SceneLoads, DoTheWorkThatTheBodyStores) {
    // By Clapeyron, loads and supports do twice the energy; doubling every load quadruples it.
    Document document = loaded_cube();
    document.handles.clear();
    const double work = *solved(document).compliance;
    EXPECT_GT(work, 0.0);
    // Converged: 0.843. On this coarse mesh linear FEM has 0.71, quadratic FEM 0.81, Galerkin 0.83.
    EXPECT_NEAR(*solved(document, kQuadraticFem).compliance, work, 0.15 * work);
    EXPECT_NEAR(*solved(document, kGalerkinBem).compliance, *solved(document, kQuadraticFem).compliance, 0.04 * work);
    *document.gravity *= 2.0;
    document.loads[0].value = PressureLoad{6.0};
    document.loads[1].value = ForceLoad{{10, 0, 2}};
    document.loads[2].value = TractionLoad{{0, 4, 0}};
    EXPECT_NEAR(*solved(document).compliance, 4.0 * work, 1e-8 * work);
}

TEST(SceneLoads, AreRefusedWithTheirPlaces) {
    Document document = loaded_cube();
    document.loads[1].select = {BoxSelector{.min = {0, 0, 0}, .max = {0, 1, 1}}};
    EXPECT_THAT(refusal_of(document), AllOf(StartsWith("scene.json: /loads/1/select: "), HasSubstr("constrained")));
    document = loaded_cube();
    document.loads[2].select = {VertexSelector{{0, 1}}};
    EXPECT_THAT(refusal_of(document), AllOf(StartsWith("scene.json: /loads/2/select: "), HasSubstr("no triangle")));
    document = loaded_cube();
    document.loads[2].name = "above";
    EXPECT_THAT(refusal_of(document), StartsWith("scene.json: /loads: two of them"));
    document.loads[2].name = "gravity";
    EXPECT_THAT(refusal_of(document), StartsWith("scene.json: /loads/2/name: "));
    document = loaded_cube();
    document.fixed.clear();
    document.handles.clear();
    EXPECT_THAT(refusal_of(document), AllOf(StartsWith("scene.json: /loads: "), HasSubstr("balance")));
    document.loads.clear();
    EXPECT_THAT(refusal_of(document), AllOf(StartsWith("scene.json: /gravity: "), HasSubstr("balance")));
}

TEST(SceneLoads, AreCarriedToAFilledSurface) {
    Document document = loaded_cube();
    document.proxy.use = ProxyUse::fill;
    EXPECT_LT(solved(document).imbalance.force, 1e-8);
}

/// A proxy around the body takes over patches by what is near them: forces stay, areas nearly.
TEST(SceneLoads, AreCarriedToAProxyAroundTheBody) {
    Document document = loaded_cube();
    document.mesh = Primitive{.name = "cube", .resolution = 8, .size = {}};
    document.handles.clear();
    const Solution own = solved(document, kQuadraticFem, false);
    document.proxy = {.use = ProxyUse::always, .n_vertices = 400};
    const Solution proxy = solved(document, kQuadraticFem, false);
    ASSERT_TRUE(proxy.proxy);
    EXPECT_FALSE(proxy.proxy->is_filled());
    EXPECT_LT(proxy.imbalance.force, 1e-8);
    EXPECT_LT((named(proxy.loads, "load-1").force - Eigen::Vector3d(5, 0, 1)).norm(), 1e-9);
    const std::string above = "above";
    for (const char* load : {"gravity", "above", "side"}) {
        const Eigen::Vector3d force = named(own.loads, load).force;
        EXPECT_LT((named(proxy.loads, load).force - force).norm(), (load == above ? 0.15 : 1e-6) * force.norm())
            << load;
    }
    for (const char* load : {"load-1", "side"}) {
        const Eigen::Vector3d moment = named(own.loads, load).moment;
        EXPECT_LT((named(proxy.loads, load).moment - moment).norm(), 1e-9 * moment.norm()) << load;
    }
    EXPECT_LT((proxy.displacement - own.displacement).norm(), 0.15 * own.displacement.norm());
    EXPECT_NEAR(*proxy.compliance, *own.compliance, 0.25 * *own.compliance);
}

/// A file with the triangles of a cube's surface for which all corners satisfy `kept`.
template <class Kept>
std::filesystem::path save_part_of_cube(const std::filesystem::path& file, int cells, const Kept& kept) {
    SurfaceMesh mesh = make_box(cells);
    std::vector<int> triangles;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        if (kept(mesh.vertices(Eigen::all, mesh.triangles.col(t)))) triangles.push_back(t);
    mesh.triangles = Triangles(mesh.triangles(Eigen::all, triangles));
    save_surface(file, mesh);
    return file;
}

Document document_of(const std::filesystem::path& mesh, const LoadValue& load, const Selector& loaded,
                     const Selector& fixed) {
    Document document;
    document.mesh = MeshFile{mesh.string()};
    document.material = {1.0, 0.3};
    document.fixed = {{.select = fixed}};
    document.loads = {{.name = "load", .select = loaded, .value = load}};
    return document;
}

/// What closes a body whose top is open is near to a loaded wall, and carries nothing.
TEST(SceneLoads, OfAWallActOnNothingBesideIt) {
    const TemporaryFolder folder;
    const auto file =
        save_part_of_cube(folder.path() / "open.obj", 6, [](const auto& x) { return x.row(2).minCoeff() < 1.0; });
    const Selector wall = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}},
                   bottom = {PlaneSelector{{0, 0, 0}, {0, 0, 1}, 1e-9}};
    for (const LoadValue& load :
         {LoadValue{ForceLoad{{1e-3, 0, 0}}}, LoadValue{TractionLoad{{1e-3, 0, 0}}}, LoadValue{PressureLoad{1e-3}}}) {
        SCOPED_TRACE(load.index());
        const Solution solution = solved(document_of(file, load, wall, bottom), kQuadraticFem, false);
        ASSERT_TRUE(solution.proxy);
        ASSERT_FALSE(solution.proxy->is_filled());
        const bool is_corrected = !std::holds_alternative<PressureLoad>(load);
        const GroupReaction& told = named(solution.loads, "load");
        EXPECT_LT((told.force - Eigen::Vector3d(1e-3, 0, 0)).norm(), is_corrected ? 1e-12 : 0.06e-3);
        EXPECT_NEAR(told.moment.y(), 0.5e-3, is_corrected ? 1e-12 : 0.05e-3);
    }
}

/// It is simulated as a wall: one of its sides is loaded, that which the sheet's triangles face.
TEST(SceneLoads, OfASheetActOnce) {
    const TemporaryFolder folder;
    const auto file =
        save_part_of_cube(folder.path() / "sheet.obj", 6, [](const auto& x) { return x.row(2).maxCoeff() == 0.0; });
    const Selector half = {BoxSelector{{0.499, 0, 0}, {1, 1, 0}}}, edge = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}};
    const Eigen::Vector3d expected(0, 0, 5e-7);
    for (const LoadValue& load : {LoadValue{ForceLoad{expected}}, LoadValue{TractionLoad{2.0 * expected}},
                                  LoadValue{PressureLoad{1e-6}}}) {  // the cube's bottom faces down
        SCOPED_TRACE(load.index());
        const Solution solution = solved(document_of(file, load, half, edge), kFem, false);
        ASSERT_TRUE(solution.proxy);
        const bool is_corrected = !std::holds_alternative<PressureLoad>(load);
        EXPECT_LT((named(solution.loads, "load").force - expected).norm(),
                  (is_corrected ? 1e-9 : 0.06) * expected.norm());
    }
}

TEST(SceneLoads, BeyondDoublePrecisionAreRefused) {
    Document document = loaded_cube();
    document.gravity = Eigen::Vector3d(0, 0, -1e300);
    document.density = 1e10;
    EXPECT_THAT(refusal_of(document), AllOf(StartsWith("scene.json: /gravity: "), HasSubstr("Make it smaller")));
    document.gravity = Eigen::Vector3d(0, 0, -1.0);
    document.density = 1.0;
    document.material.young_modulus = 1e-10;
    document.loads[1].value = ForceLoad{{1e300, 0, 0}};
    EXPECT_THAT(refusal_of(document), AllOf(StartsWith("scene.json: /loads/1: "), HasSubstr("Make it smaller")));
}

TEST(SceneLoads, OnTrianglesWithoutAreaAreRefused) {
    const TemporaryFolder folder;
    SurfaceMesh mesh = make_box(2);
    const int n = mesh.n_vertices(), n_triangles = mesh.n_triangles();
    mesh.vertices.conservativeResize(3, n + 3);
    mesh.vertices.rightCols<3>() << 2, 3, 4, 0, 0, 0, 0, 0, 0;
    mesh.triangles.conservativeResize(3, n_triangles + 1);
    mesh.triangles.col(n_triangles) << n, n + 1, n + 2;
    save_surface(folder.path() / "needle.obj", mesh);
    const Selector needle = {BoxSelector{{1.5, -1, -1}, {5, 1, 1}}}, side = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}};
    for (const LoadValue& load :
         {LoadValue{ForceLoad{{1, 0, 0}}}, LoadValue{TractionLoad{{1, 0, 0}}}, LoadValue{PressureLoad{1.0}}})
        EXPECT_THAT(refusal_of(document_of(folder.path() / "needle.obj", load, needle, side)),
                    AllOf(StartsWith("scene.json: /loads/0/select: "), HasSubstr("without area")));
}

/// Its neighbours have all vertices of the coarse proxy.
TEST(SceneLoads, OfAHandleThatTheProxyHasNoVertexForAreRefused) {
    const SurfaceMesh sphere = make_sphere(14);
    int top = 0;
    for (int v = 0; v < sphere.n_vertices(); ++v)
        if (sphere.vertices(2, v) > sphere.vertices(2, top)) top = v;
    std::vector<int> around;
    for (int v = 0; v < sphere.n_vertices(); ++v)
        if (v != top && (sphere.vertices.col(v) - sphere.vertices.col(top)).norm() < 0.8) around.push_back(v);
    Document document;
    document.mesh = Primitive{.name = "sphere", .resolution = 14, .size = {}};
    document.material = {1e3, 0.3};
    document.fixed = {{.select = {BoxSelector{{-2, -2, -2}, {2, 2, -0.7}}}}};
    document.handles = {{.name = "around", .select = {VertexSelector{around}}, .motion = AffineMotion{}},
                        {.name = "top", .select = {VertexSelector{{top}}}, .motion = AffineMotion{}}};
    document.proxy = {.use = ProxyUse::always, .n_vertices = 60};
    EXPECT_EQ(refusal_of(document), "no complaint");
    EXPECT_THAT(solved(document, kFem, false).warnings(),
                testing::Contains(AllOf(StartsWith("handle top: "), HasSubstr("Ask for more proxy vertices"))));
    document.handles[1].force = GripForce{{0, 0, 5}, {0, 0, 0}};
    EXPECT_THAT(refusal_of(document),
                AllOf(StartsWith("scene.json: /handles/1: "), HasSubstr("Ask for more proxy vertices")));
}

}  // namespace
}  // namespace elastolab
