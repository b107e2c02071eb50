// Open surfaces as solids with all their own vertices.
#include "mesh/wrap/filled_surface.hpp"

#include <gmock/gmock.h>

#include "base/error.hpp"
#include "mesh/checks/check.hpp"
#include "mesh/measures.hpp"
#include "mesh/meshes.hpp"

namespace elastolab {
namespace {

SurfaceMesh loaded(const SurfaceMesh& mesh) { return check_and_repair(mesh).mesh; }

FilledSurface filled(const SurfaceMesh& open) {
    Control control;
    return fill_holes(open, control);
}

/// The vertices of the removed parts are in no triangle, as in many a scan.
void expect_kept(const SurfaceMesh& open, const FilledSurface& filled) {
    ASSERT_EQ(filled.own.size(), static_cast<std::size_t>(open.n_vertices()));
    int n_unused = 0;
    for (int v = 0; v < open.n_vertices(); ++v) {
        const int own = filled.own[static_cast<std::size_t>(v)];
        if (own < 0)
            ++n_unused;
        else
            EXPECT_EQ(filled.surface.vertices.col(own), open.vertices.col(v));
    }
    EXPECT_GT(n_unused, 0);
    for (int t = 0; t < open.n_triangles(); ++t)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(filled.surface.triangles(k, t), filled.own[static_cast<std::size_t>(open.triangles(k, t))]);
    EXPECT_TRUE(check_and_repair(filled.surface).report.usable_for_fem());
}

SurfaceMesh ball_with_holes(int cells) {
    return loaded(with_hole(with_hole(make_sphere(cells), {0, 0, 1}, 0.93), {1, 0.2, 0}, 0.9));
}

TEST(FillHoles, GoesOnSmoothlyAndMovesNothing) {
    const SurfaceMesh open = ball_with_holes(14);
    ASSERT_FALSE(check_and_repair(open).report.usable());
    const FilledSurface result = filled(open);
    EXPECT_EQ(result.n_holes, 2);
    expect_kept(open, result);
    const double whole = enclosed_volume(make_sphere(14));
    EXPECT_NEAR(enclosed_volume(result.surface), whole, 2e-3 * whole);  // flat lids would miss 1 % and 2 %
}

TEST(FillHoles, AtEverySizeAndPlace) {
    const SurfaceMesh open = ball_with_holes(8);
    for (const SurfaceMesh& other : {scaled(open, 1e-9), scaled(open, 1e12), moved(open, {1e5, -1e5, 3e5})}) {
        const FilledSurface result = filled(loaded(other));
        EXPECT_EQ(result.n_holes, 2);
        expect_kept(loaded(other), result);
    }
}

TEST(FillHoles, SaysWhatIsWrongBesideTheHoles) {
    std::vector<int> lid;  // a sheet has a rim, too, and no inside
    const SurfaceMesh box = make_box(4);
    for (int t = 0; t < box.n_triangles(); ++t)
        if (box.vertices(Eigen::all, box.triangles.col(t)).row(2).maxCoeff() < 1e-9) lid.push_back(t);
    const SurfaceMesh sheet = loaded({box.vertices, box.triangles(Eigen::all, lid)});
    const SurfaceMesh crossing = loaded(joined(ball_with_holes(6), moved(make_sphere(4), {0.7, 0.0, 0.1})));
    for (const SurfaceMesh& mesh : {sheet, crossing}) {
        try {
            filled(mesh);
            FAIL() << "was taken for a solid";
        } catch (const MeshError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("Choose a proxy"));
        }
    }
}

}  // namespace
}  // namespace elastolab
