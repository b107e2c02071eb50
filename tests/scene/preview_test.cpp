// What a person sees before the method that was asked for can answer, and on surfaces that it cannot take.
#include <gmock/gmock.h>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "mesh/input/export.hpp"
#include "mesh/measures.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "scene/simulation_bench.hpp"
#include "support/temporary_folder.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

using namespace testing_simulation;

/// A preview and a method that are both being computed, as in the viewer.
struct PreviewBench : Bench {
    using Bench::Bench;
    void begin(const LiveScene& scene) {
        choices.preview = true;
        choices.complete_up_to = 0;  // which comes after all that is seen here
        update(scene);
    }
    /// Frames until the preview answers for what is pulled now.
    void wait_for_preview(const LiveScene& scene) {
        update_until(scene, [&] { return simulation.previewing(shown.front()) || !simulation.busy(); });
    }
};

void expect_handles_where_they_are_put(const LiveScene& scene, const Eigen::VectorXd& u) {
    ASSERT_EQ(u.size(), 3 * scene.mesh().n_vertices());
    const Constraints& constraints = scene.constraints();
    for (std::size_t i = 0; i < constraints.set.handles.size(); ++i)
        EXPECT_LT((u.segment<3>(3 * constraints.set.handles[i]) -
                   constraints.values.segment<3>(3 * static_cast<Eigen::Index>(i)))
                      .norm(),
                  1e-12);
    for (const int v : constraints.set.fixed) EXPECT_LT((u.segment<3>(3 * v)).norm(), 1e-12);
}

TEST(Preview, AnswersBeforeTheMethodDoesAndGivesWay) {
    const LiveScene scene = pulled_cube(10);
    PreviewBench bench({kLinearBem});
    bench.begin(scene);
    bench.wait_for_preview(scene);
    ASSERT_TRUE(bench.simulation.previewing(kLinearBem));
    EXPECT_FALSE(bench.simulation.embedded(kLinearBem).has_answer());
    const Eigen::VectorXd coarse = bench.simulation.answer(kLinearBem).displacement();
    expect_handles_where_they_are_put(scene, coarse);
    EXPECT_FALSE(bench.simulation.preview_error(kLinearBem));

    bench.settle(scene);
    EXPECT_FALSE(bench.simulation.previewing(kLinearBem));
    const Eigen::VectorXd& exact = bench.simulation.answer(kLinearBem).displacement();
    const double off = (coarse - exact).norm() / exact.norm();
    EXPECT_LT(off, 0.1);
    ASSERT_TRUE(bench.simulation.preview_error(kLinearBem));
    EXPECT_NEAR(*bench.simulation.preview_error(kLinearBem), off, 1e-6);
}

TEST(Preview, MovesANewHandleWhileTheMethodPreparesIt) {
    LiveScene scene = cube(9);
    PreviewBench bench({kConstantBem});
    bench.begin(scene);
    bench.settle(scene);
    scene.add_handle(where(scene, 0.9, 0.6));
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    bench.update(scene);
    bench.wait_for_preview(scene);
    if (bench.simulation.previewing(kConstantBem)) {  // else the method was as fast
        expect_handles_where_they_are_put(scene, bench.simulation.answer(kConstantBem).displacement());
        scene.set_motion(0, AffineMotion{.translate = {0.2, 0.1, 0}});
        bench.update(scene);
        expect_handles_where_they_are_put(scene, bench.simulation.answer(kConstantBem).displacement());
    }
    bench.settle(scene);
    expect_handles_where_they_are_put(scene, bench.simulation.preview(kConstantBem).displacement());
    expect_near(bench.simulation.answer(kConstantBem).displacement(), bench.runner(kConstantBem).displacement());
}

TEST(Preview, OfAThousandVerticesIsTheSurfaceItself) {
    LiveScene scene = pulled_cube(13);
    PreviewBench bench({kConstantBem});
    bench.begin(scene);
    bench.wait_for_preview(scene);
    EXPECT_EQ(bench.simulation.preview(kConstantBem).surface(), scene.surface().get());
    EXPECT_EQ(bench.simulation.preview(kConstantBem).proxy(), nullptr);
    EXPECT_EQ(bench.simulation.proxies().preview(), nullptr) << "nothing is made that nobody looks at";
    scene.set_material({.young_modulus = 1.0, .poisson_ratio = 0.49});
    bench.update_until(scene, [&] { return bench.simulation.proxies().preview() != nullptr; });
}

TEST(Preview, IsNotMadeBesideTheMethodThatItWouldBeMadeBy) {
    const LiveScene scene = pulled_cube(9);
    PreviewBench bench({quick_method()});
    bench.begin(scene);
    bench.settle(scene);
    EXPECT_EQ(bench.simulation.preview(kConstantBem).surface(), nullptr);
}

/// The preview of the method before stays where the new one is the one that it is made by.
TEST(Preview, StaysUntilTheMethodThatItIsMadeByAnswers) {
    const LiveScene scene = pulled_cube(13);
    PreviewBench bench({kLinearBem});
    bench.begin(scene);
    bench.wait_for_preview(scene);
    ASSERT_TRUE(bench.simulation.previewing(kLinearBem));
    bench.shown = {quick_method()};
    do {
        bench.update(scene);
        expect_handles_where_they_are_put(scene, bench.simulation.answer(quick_method()).displacement());
    } while (!bench.runner(quick_method()).answers());
    bench.settle(scene);
    EXPECT_FALSE(bench.simulation.previewing(quick_method()));
    EXPECT_EQ(bench.simulation.preview(kLinearBem).surface(), nullptr) << "it is not needed any more";
}

TEST(ChangeOfMethod, ShowsWhatWasLookedAtUntilTheNewOneAnswers) {
    LiveScene scene = pulled_cube(5);
    Bench bench({kFem});
    bench.choices.complete_up_to = 0;
    bench.settle(scene);
    bench.shown = {kNonlinearFem};
    bench.update(scene);
    ASSERT_EQ(bench.simulation.stand_in(kNonlinearFem), kFem);
    EXPECT_TRUE(bench.simulation.previewing(kNonlinearFem));
    scene.set_motion(0, AffineMotion{.translate = {0.2, 0, 0}});
    bench.update(scene);
    if (bench.simulation.stand_in(kNonlinearFem))  // else it was there in no time
        expect_near(bench.simulation.answer(kNonlinearFem).displacement(), truth(scene, bench.choices.of(kFem)));

    bench.settle(scene);
    EXPECT_EQ(bench.simulation.stand_in(kNonlinearFem), nullptr);
    EXPECT_EQ(&bench.simulation.answer(kNonlinearFem), &bench.simulation.embedded(kNonlinearFem));
}

/// Of handles that are gone, or of others.
TEST(ChangeOfMethod, ShowsNoAnswerToASceneBefore) {
    LiveScene scene = pulled_cube(5);
    Bench bench({kNonlinearFem});
    bench.choices.complete_up_to = 0;
    bench.settle(scene);
    bench.shown = {kFem};
    bench.settle(scene);
    scene.clear_handles();
    scene.set_motion(scene.add_handle(std::vector<int>{scene.mesh().n_vertices() - 1}),
                     AffineMotion{.translate = {0, 0, 0.1}});
    bench.settle(scene);
    bench.shown = {kNonlinearFem};
    bench.update(scene);
    if (!bench.runner(kNonlinearFem).answers()) {  // else it was there in no time
        EXPECT_EQ(bench.simulation.stand_in(kNonlinearFem), kFem);
        expect_near(bench.simulation.answer(kNonlinearFem).displacement(), truth(scene, bench.choices.of(kFem)));
    }
    bench.settle(scene);
    EXPECT_EQ(bench.simulation.stand_in(kNonlinearFem), nullptr);
    EXPECT_LT(
        (bench.simulation.answer(kNonlinearFem).displacement() - truth(scene, bench.choices.of(kNonlinearFem))).norm(),
        1e-6);
    bench.shown = {kFem};
    bench.update(scene);
    EXPECT_EQ(bench.simulation.stand_in(kFem), nullptr) << "its answer is one to this scene";
}

/// In a comparison, too: a body at rest would pass for its answer.
TEST(ChangeOfMethod, ShowsWhatIsThereOfOthersBesideIt) {
    const LiveScene scene = pulled_cube(6);
    Bench bench({kFem});
    bench.choices.complete_up_to = 0;
    bench.settle(scene);
    bench.shown = {kFem, kGalerkinBem, kConstantBem};
    bench.update(scene);
    for (const MethodKind kind : {kGalerkinBem, kConstantBem}) {
        ASSERT_EQ(bench.simulation.stand_in(kind), kFem) << name(kind);
        EXPECT_TRUE(bench.simulation.previewing(kind));
        expect_near(bench.simulation.answer(kind).displacement(), truth(scene, bench.choices.of(kFem)));
    }
    EXPECT_EQ(bench.simulation.stand_in(kFem), nullptr);
    bench.settle(scene);
    for (const MethodKind kind : {kGalerkinBem, kConstantBem})
        expect_near(bench.simulation.answer(kind).displacement(), truth(scene, bench.choices.of(kind)));
}

TEST(ChangeOfMethod, ShowsNothingInPlaceOfOneThatCannotTakeTheBody) {
    LiveScene scene = pulled_cube(3);
    scene.set_material({.young_modulus = 1.0, .poisson_ratio = 0.5});
    Bench bench({kLinearBem});
    bench.settle(scene);
    ASSERT_TRUE(bench.simulation.answer(kLinearBem).has_answer());
    bench.shown = {kFem};
    bench.settle(scene);
    EXPECT_NE(bench.simulation.problem(kFem), "");
    EXPECT_EQ(bench.simulation.stand_in(kFem), nullptr);
    EXPECT_FALSE(bench.simulation.answer(kFem).has_answer());
}

TEST(HiddenMethods, AreLetGoWhereTheyTakeTooMuchMemoryThoseOfLongAgoFirst) {
    const LiveScene scene = pulled_cube(4);
    Bench bench({kLinearBem});
    bench.choices.complete_up_to = 0;
    bench.settle(scene);
    bench.simulation.set_hidden_memory(std::uint64_t{1} << 40);
    bench.shown = {kFem};
    bench.settle(scene);
    EXPECT_NE(bench.runner(kLinearBem).model(), nullptr) << "there is room";
    const MethodRunner& fem = bench.runner(kFem);
    bench.simulation.set_hidden_memory(fem.model()->facts().memory_bytes + fem.set_memory());
    bench.shown = {kConstantBem};
    bench.update(scene);
    EXPECT_EQ(bench.runner(kLinearBem).model(), nullptr);
    EXPECT_NE(fem.model(), nullptr);
    EXPECT_THAT(bench.simulation.take_dropped(), testing::ElementsAre(kLinearBem));
    bench.shown = {kLinearBem};
    bench.settle(scene);
    expect_near(bench.runner(kLinearBem).displacement(), truth(scene, bench.choices.of(kLinearBem)));
}

TEST(Preview, IsNotMadeForABodyThatIsReadyAtOnce) {
    const LiveScene scene = pulled_cube(3);
    PreviewBench bench;
    bench.begin(scene);
    bench.settle(scene);
    EXPECT_EQ(bench.simulation.preview(kConstantBem).surface(), nullptr);
}

/// The cube without the lid at z = 1, in a file.
LiveScene open_box(const std::filesystem::path& folder, int cells, ProxyUse use, int n_vertices = 1500) {
    SurfaceMesh box = make_primitive("cube", cells, {});
    std::vector<int> kept;
    for (int t = 0; t < box.n_triangles(); ++t)
        if (centroid(box, t).z() < 0.999 || (centroid(box, t) - Eigen::Vector3d(0.5, 0.5, 1)).norm() > 0.2)
            kept.push_back(t);
    box.triangles = box.triangles(Eigen::all, kept).eval();
    save_surface(folder / "box.obj", box);
    Document document;
    document.mesh = MeshFile{"box.obj"};
    document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    document.proxy = {.use = use, .n_vertices = n_vertices};
    return {document, folder / "scene.json"};
}

TEST(Proxy, AnOpenSurfaceIsPulledByEveryMethod) {
    const test::TemporaryFolder folder;
    LiveScene scene = open_box(folder.path(), 6, ProxyUse::automatic);
    scene.add_handle(where(scene, 0.9, 0.6));
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    LiveScene closed = cube(6);
    closed.add_handle(where(closed, 0.9, 0.6));
    closed.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    for (const MethodKind kind : all_methods()) {
        SCOPED_TRACE(kind->name);
        PreviewBench bench({kind});
        bench.begin(scene);
        bench.settle(scene);
        EXPECT_EQ(bench.simulation.problem(kind), "");
        ASSERT_TRUE(bench.simulation.embedded(kind).proxy());
        EXPECT_TRUE(bench.simulation.embedded(kind).shows(scene.mesh()));
        const Eigen::VectorXd& u = bench.simulation.answer(kind).displacement();
        expect_handles_where_they_are_put(scene, u);
        // The hole is closed: what comes out is close to the closed cube's answer.
        const Eigen::VectorXd exact = truth(closed, {.kind = kind});
        double off = 0.0, size = 0.0;
        for (int v = 0; v < scene.mesh().n_vertices(); ++v)
            for (int w = 0; w < closed.mesh().n_vertices(); ++w)
                if ((scene.mesh().vertices.col(v) - closed.mesh().vertices.col(w)).norm() < 1e-6) {
                    off += (u.segment<3>(3 * v) - exact.segment<3>(3 * w)).squaredNorm();
                    size += exact.segment<3>(3 * w).squaredNorm();
                }
        EXPECT_LT(std::sqrt(off / size), 0.12);
    }
}

/// A bowl: around its triangles alone there is a shell, that bends far more than the filled half of a ball.
TEST(Preview, OfASurfaceWhoseHolesAreFilledIsSolid) {
    const test::TemporaryFolder folder;
    save_surface(folder.path() / "bowl.ply", with_hole(make_sphere(12), {0, 0, 1}, 0.3));
    Document document;
    document.mesh = MeshFile{"bowl.ply"};
    document.fixed = {{.select = {PlaneSelector{{-1, 0, 0}, {1, 0, 0}, 0.4}}}};
    document.proxy.use = ProxyUse::fill;
    LiveScene scene(document, folder.path() / "scene.json");
    scene.add_handle(where(scene, 0.6, -1.0));
    scene.set_motion(0, AffineMotion{.translate = {0, 0, 0.2}});
    PreviewBench bench({kConstantBem});
    bench.begin(scene);
    bench.wait_for_preview(scene);
    bench.settle(scene);
    EXPECT_EQ(bench.simulation.problem(kConstantBem), "");
    ASSERT_TRUE(bench.simulation.preview_error(kConstantBem));
    EXPECT_LT(*bench.simulation.preview_error(kConstantBem), 0.15);
}

TEST(Proxy, WhereItIsForbiddenTheSurfaceIsRefused) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(open_box(folder.path(), 3, ProxyUse::never), MeshError);
}

TEST(Proxy, CanBeStoppedAndTriedAgain) {
    const test::TemporaryFolder folder;
    const LiveScene scene = open_box(folder.path(), 20, ProxyUse::automatic, 300);
    PreviewBench bench;
    bench.begin(scene);
    bench.simulation.cancel();
    ASSERT_TRUE(test::wait_until([&] { return !bench.simulation.stopping(); }));
    bench.update(scene);
    EXPECT_THAT(bench.simulation.problem(kLinearBem), HasSubstr("stopped"));
    bench.simulation.retry(kLinearBem);
    bench.settle(scene);
    EXPECT_EQ(bench.simulation.problem(kLinearBem), "");
    EXPECT_TRUE(bench.simulation.answer(kLinearBem).has_answer());
}

}  // namespace
}  // namespace elastolab
