// What fills the holes of a body that is simulated so, as it is shown.
#include <gmock/gmock.h>

#include <algorithm>
#include <Eigen/Geometry>

#include "app/picture/scene_renderer.hpp"
#include "app/stage.hpp"
#include "mesh/input/export.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

constexpr double kRounding = 1e-9;
constexpr double kVault = 0.1;  ///< the smooth filling's area beyond that of a plane one

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

SurfaceMesh turned_inside_out(SurfaceMesh mesh) {
    mesh.triangles.row(1).swap(mesh.triangles.row(2));
    return mesh;
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

/// An open box, simulated with its hole filled and pulled at its right side.
class FilledBox : public testing::Test {
protected:
    explicit FilledBox(const SurfaceMesh& open = open_box()) {
        save_surface(folder_.path() / "open.obj", open);
        Document document = test::cube_document(3);
        document.mesh = MeshFile{(folder_.path() / "open.obj").string()};
        document.proxy.use = ProxyUse::fill;
        stage.open(document);
        stage.settle();
        std::vector<int> right;
        for (int v = 0; v < stage.scene().mesh().n_vertices(); ++v)
            if (stage.scene().mesh().vertices(0, v) > 0.99) right.push_back(v);
        stage.scene().add_handle(right);
        stage.scene().set_motion(0, AffineMotion{.translate = {0.1, 0, 0.2}});
        stage.settle();
    }
    const ShownBody& body() { return *stage.state.shown.body(stage.state.method); }
    void cut_open() {
        stage.state.display.section = true;
        stage.state.display.cut.axis = 1;
        stage.state.display.cut.place = 0.45;
        stage.settle();
    }

private:
    const test::TemporaryFolder folder_;

protected:
    test::Stage stage{2};
};

TEST_F(FilledBox, ClosesTheHoleAndFollowsTheBody) {
    stage.state.display.deformation_scale = 1.5;
    stage.settle();
    const LiveScene& scene = stage.scene();
    const ShownBody& body = this->body();
    ASSERT_TRUE(body.filling());
    const FillingShape& shape = *body.filling()->shape;
    EXPECT_EQ(shape.triangles().cols() + scene.mesh().n_triangles(), shape.surface()->n_triangles());
    EXPECT_EQ(shape.triangles().maxCoeff() + 1, shape.rest().cols());
    EXPECT_GT(shape.rest().row(2).minCoeff(), 0.99) << "the top alone";
    EXPECT_GT((body.filling()->positions - shape.rest()).colwise().norm().maxCoeff(), 0.2);
    EXPECT_LT(gap_at_rim(shape, body.filling()->positions, scene.mesh().vertices, body.positions()), kRounding);
}

TEST_F(FilledBox, HasTheColoursOfTheFieldThatIsShown) {
    EXPECT_TRUE(body().filling()->values.empty());
    for (const Field field : {Field::displacement, Field::traction, Field::von_mises}) {
        stage.state.display.field = field;
        stage.settle();
        const ShownFilling seen = *body().filling();
        ASSERT_EQ(std::ssize(seen.values), seen.positions.cols());
        // At the rim they are those of the body, and nowhere far from them.
        const float largest = *std::max_element(seen.values.begin(), seen.values.end());
        EXPECT_GT(largest, 0.0f);
        EXPECT_LE(largest, 1.2 * body().largest_magnitude());
        int n_rim = 0;
        for (Eigen::Index v = 0; v < seen.positions.cols(); ++v) {
            Eigen::Index near = 0;
            const double distance =
                (body().positions().colwise() - seen.positions.col(v)).colwise().norm().minCoeff(&near);
            if (distance > kRounding) continue;
            EXPECT_NEAR(seen.values[static_cast<std::size_t>(v)], body().values()[static_cast<std::size_t>(near)],
                        1e-5 * body().largest_magnitude());
            ++n_rim;
        }
        EXPECT_EQ(n_rim, 12) << "around the top";
    }
    stage.state.display.field = Field::displacement;
    stage.settle();
    const ShownFilling& seen = *body().filling();
    const Positions moved = seen.positions - seen.shape->rest();
    for (Eigen::Index v = 0; v < moved.cols(); ++v)
        EXPECT_NEAR(seen.values[static_cast<std::size_t>(v)], moved.col(v).norm(), 1e-6);
}

TEST_F(FilledBox, IsFaintUntilItHasColours) {
    const auto opacity = [&] { return filling_opacity(stage.state, stage.state.method); };
    const float faint = opacity();
    EXPECT_LT(faint, 0.2f);
    stage.state.display.field = Field::traction;
    stage.frame();
    ASSERT_FALSE(body().is_coloured()) << "its first values are the worker's";
    EXPECT_EQ(opacity(), faint);
    stage.settle();
    ASSERT_TRUE(body().is_coloured());
    EXPECT_GT(opacity(), 0.5f);
}

double area(const Positions& vertices, const Triangles& triangles) {
    double sum = 0.0;
    for (const auto& t : triangles.colwise()) {
        const Eigen::Vector3d a = vertices.col(t[0]), b = vertices.col(t[1]), c = vertices.col(t[2]);
        sum += 0.5 * (b - a).cross(c - a).norm();
    }
    return sum;
}

TEST_F(FilledBox, ShowsItsFillingAndItsInsideWhereItIsCutOpen) {
    stage.state.display.field = Field::displacement;
    cut_open();
    ASSERT_TRUE(body().section());
    const ShownSection& section = *body().section();
    const SectionShape& shape = *section.shape;
    ASSERT_EQ(section.positions.cols(), shape.rest().cols());
    EXPECT_EQ(std::ssize(section.values), shape.rest().cols());
    // The first vertices are those of the surface, which can be pointed at.
    EXPECT_EQ(section.positions.leftCols(body().positions().cols()), body().positions());
    // Skin and cap on one side, nothing but the top on the other, which is a little vaulted: 0.45 deep.
    EXPECT_NEAR(area(shape.rest(), shape.triangles()), 1.0 + 1.0 + 3 * 0.45, kVault);
    EXPECT_NEAR(area(shape.rest(), shape.filling()), 0.45, kVault);
    EXPECT_GT(shape.rest()(Eigen::all, shape.filling().reshaped()).row(2).minCoeff(), 0.98);
    const double low = shape.inside().row(2).minCoeff(), high = shape.inside().row(2).maxCoeff();
    EXPECT_GT(high, 0.9) << "the cap reaches the filling; from " << low;
    // And it is left whole when the body is.
    stage.state.display.section = false;
    stage.settle();
    EXPECT_NEAR(area(body().filling()->shape->rest(), body().filling()->shape->triangles()), 1.0, kVault);
}

/// The same from a file whose triangles face inward.
class InsideOutFilledBox : public FilledBox {
protected:
    InsideOutFilledBox() : FilledBox(turned_inside_out(open_box())) {}
};

TEST_F(InsideOutFilledBox, IsClosedAndCutOpenLikeAnyOther) {
    const SurfaceMesh& shown = stage.scene().mesh();
    ASSERT_LT(area_vector(triangle_points(shown, 0)).dot(centroid(shown, 0) - Eigen::Vector3d::Constant(0.5)), 0.0)
        << "as in its file";
    EXPECT_NEAR(enclosed_volume(*body().filling()->shape->closed()), 1.0, kVault);
    cut_open();
    ASSERT_TRUE(body().section());
    const SectionShape& shape = *body().section()->shape;
    EXPECT_NEAR(area(shape.rest(), shape.triangles()), 1.0 + 1.0 + 3 * 0.45, kVault);
    EXPECT_LE(shape.inside().cols(), 1000) << "a grid of 16 edges across";
}

TEST(FillingShape, FacesOutwardAllOverWhereTheOpenSurfaceFacesInward) {
    Proxy proxy = filled_box(std::make_shared<const SurfaceMesh>(open_box()));
    proxy.shown = std::make_shared<const SurfaceMesh>(turned_inside_out(*proxy.shown));
    EXPECT_NEAR(enclosed_volume(*FillingShape(proxy).closed()), 1.0, kRounding);
}

/// As a preview's answer would have it, which knows nothing of the filling.
TEST(FillingShape, FollowsTheRimWhereNothingElseIsKnown) {
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

TEST(FillingShape, IsNoneWhereTheBodyIsSimulatedItself) {
    test::Stage stage(2);
    stage.settle();
    EXPECT_FALSE(stage.state.shown.body(stage.state.method)->filling());
}

}  // namespace
}  // namespace elastolab
