// What fills the holes of a body that is simulated so, as it is shown.
#include <gmock/gmock.h>

#include "app/stage.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

constexpr double kRounding = 1e-9;

/// A cube without the triangles of its top.
SurfaceMesh open_box() {
    SurfaceMesh mesh = make_box(3);
    std::vector<int> kept;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        if (mesh.vertices(Eigen::all, mesh.triangles.col(t)).row(2).minCoeff() < 0.99) kept.push_back(t);
    mesh.triangles = Triangles(mesh.triangles(Eigen::all, kept));
    return mesh;
}

/// The open box with its whole top, as filling its hole would have it.
Proxy filled_box(const std::shared_ptr<const SurfaceMesh>& shown) {
    SurfaceMesh filled = make_box(3);
    std::vector<int> top;
    for (int t = 0; t < filled.n_triangles(); ++t)
        if (filled.vertices(Eigen::all, filled.triangles.col(t)).row(2).minCoeff() >= 0.99) top.push_back(t);
    Triangles triangles(3, filled.n_triangles());
    triangles << shown->triangles, Triangles(filled.triangles(Eigen::all, top));
    filled.triangles = triangles;
    const int n = filled.n_vertices();
    SurfacePlaces places{
        .nodes = Triangles::Zero(3, n), .weights = Eigen::Matrix3Xd::Zero(3, n), .distance = Eigen::VectorXd::Zero(n)};
    for (int v = 0; v < n; ++v) places.nodes(0, v) = v;
    places.weights.row(0).setOnes();
    // Vertices inside the top belong to no triangle of the open box.
    for (int v = 0; v < n; ++v)
        if ((shown->triangles.array() != v).all()) places.distance[v] = 1.0;
    return {.shown = shown,
            .surface = std::make_shared<const SurfaceMesh>(std::move(filled)),
            .places = std::move(places),
            .kind = ProxySurface::Kind::filled};
}

/// How far the filling is from the body at the rim of the hole, whose vertices both have.
double gap_at_rim(const FillingShape& shape, const Positions& filling, const Positions& rest, const Positions& body) {
    double largest = 0.0;
    int n_rim = 0;
    for (Eigen::Index i = 0; i < shape.rest().cols(); ++i) {
        const Eigen::Vector3d x = shape.rest().col(i);
        if (x.head<2>().minCoeff() > kRounding && x.head<2>().maxCoeff() < 1.0 - kRounding) continue;
        Eigen::Index v = 0;
        EXPECT_LT((rest.colwise() - x).colwise().norm().minCoeff(&v), kRounding);
        largest = std::max(largest, (filling.col(i) - body.col(v)).norm());
        ++n_rim;
    }
    EXPECT_EQ(n_rim, 12) << "around the top";
    return largest;
}

TEST(ShownFilling, ClosesTheHoleAndFollowsTheBody) {
    const test::TemporaryFolder folder;
    save_surface(folder.path() / "open.obj", open_box());
    Document document = test::cube_document(3);
    document.mesh = MeshFile{(folder.path() / "open.obj").string()};
    document.proxy.use = ProxyUse::fill;
    test::Stage stage(2);
    stage.open(document);
    stage.settle();
    const LiveScene& scene = stage.scene();
    std::vector<int> right;
    for (int v = 0; v < scene.mesh().n_vertices(); ++v)
        if (scene.mesh().vertices(0, v) > 0.99) right.push_back(v);
    stage.scene().add_handle(right);
    stage.scene().set_motion(0, AffineMotion{.translate = {0.1, 0, 0.2}});
    stage.state.display.deformation_scale = 1.5;
    stage.settle();

    const ShownBody& body = *stage.state.shown.body(stage.state.method);
    ASSERT_TRUE(body.filling());
    const FillingShape& shape = *body.filling()->shape;
    EXPECT_EQ(shape.triangles().cols() + scene.mesh().n_triangles(), shape.surface()->n_triangles());
    EXPECT_EQ(shape.triangles().maxCoeff() + 1, shape.rest().cols());
    EXPECT_GT(shape.rest().row(2).minCoeff(), 0.99) << "the top alone";
    EXPECT_GT((body.filling()->positions - shape.rest()).colwise().norm().maxCoeff(), 0.2);
    EXPECT_LT(gap_at_rim(shape, body.filling()->positions, scene.mesh().vertices, body.positions()), kRounding);
}

/// As a preview's answer would have it, which knows nothing of the filling.
TEST(ShownFilling, FollowsTheRimWhereNothingElseIsKnown) {
    const auto shown = std::make_shared<const SurfaceMesh>(open_box());
    const Proxy proxy = filled_box(shown);
    const FillingShape shape(proxy);
    EXPECT_LT((shape.following(shown->vertices) - shape.rest()).norm(), kRounding);
    Positions moved = shown->vertices;
    moved.row(2).array() += 0.3 + 0.1 * moved.row(0).array();
    const Positions followed = shape.following(moved);
    EXPECT_LT(gap_at_rim(shape, followed, shown->vertices, moved), 1e-6);
    EXPECT_GT((followed - shape.rest()).row(2).minCoeff(), 0.29);
    EXPECT_LT((followed - shape.rest()).row(2).maxCoeff(), 0.41);
}

TEST(ShownFilling, IsNoneWhereTheBodyIsSimulatedItself) {
    test::Stage stage(2);
    stage.settle();
    EXPECT_FALSE(stage.state.shown.body(stage.state.method)->filling());
}

}  // namespace
}  // namespace elastolab
