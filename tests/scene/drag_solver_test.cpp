// Columns that serve the frames of a drag: of handles and of loads, by linear methods and about an equilibrium.
#include "scene/live/drag_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"
#include "scene/constraints.hpp"
#include "scene/loaded_cube.hpp"
#include "scene/scene_mesh.hpp"

namespace elastolab {
namespace {

/// loaded_cube() with what a drag solver of it is made from.
struct DraggedCube {
    Control control = {};
    Document document = loaded_cube();
    SceneMesh mesh = load_scene_mesh(document.mesh, "scene.json", control);
    Constraints constraints = make_constraints(document, mesh.checked.mesh, "scene.json");

    std::shared_ptr<const Deformer> deformer(MethodKind kind) {
        const Body body{"cube", std::make_shared<const SurfaceMesh>(mesh.checked.mesh), document.material};
        auto made = std::make_shared<Deformer>(precompute(body, {.kind = kind}, control));
        made->constrain(constraints.set, control);
        return made;
    }
    std::vector<int> handle_ends() const { return {static_cast<int>(constraints.set.handles.size())}; }
};

TEST(DragSolver, ServesChangesOfLoadsFromTheColumnsAtHand) {
    DraggedCube cube;
    for (const MethodKind kind : {kFem, kLinearBem, kGalerkinBem}) {
        const auto deformer = cube.deformer(kind);
        DragSolver drag(deformer, cube.handle_ends());
        Eigen::VectorXd values = cube.constraints.values, u;
        drag.prepare(values, kSolveTolerance, cube.control);
        values[values.size() - 4] += 0.5;
        drag.displace(values, u);  // the first change of a load takes its columns
        for (int frame = 0; frame < 3; ++frame) {
            values.tail(3) += Eigen::Vector3d(0.1, -0.2, 0.3);
            values[values.size() - 10] -= 1.0;
            EXPECT_TRUE(drag.has(values)) << name(kind);
            drag.displace(values, u);
            EXPECT_LT((u - deformer->displace(values)).norm(), 1e-10 * u.norm()) << name(kind);
        }
    }
}

/// The columns of loads would answer to any, and with nonsense where nothing holds the body.
TEST(DragSolver, RefusesLoadsThatDoNotBalance) {
    DraggedCube cube;
    cube.document.fixed.clear();
    cube.document.handles.clear();
    cube.document.gravity.reset();
    cube.document.loads.resize(1);
    cube.constraints = make_constraints(cube.document, cube.mesh.checked.mesh, "scene.json");
    for (const MethodKind kind : {kFem, kLinearBem, kGalerkinBem}) {
        const auto deformer = cube.deformer(kind);
        DragSolver drag(deformer, {});
        Eigen::VectorXd values = Eigen::VectorXd::Zero(cube.constraints.values.size()), u;
        drag.prepare(values, kSolveTolerance, cube.control);
        drag.displace(values, u);
        EXPECT_TRUE(u.isZero(0.0)) << name(kind);
        values.setOnes();
        EXPECT_THROW(drag.displace(values, u), SolveError) << name(kind);
    }
}

/// Of large deformations: the tangent's columns, once the worker has found the equilibrium with the first change.
TEST(DragSolver, ShowsAChangedLoadByTheTangentsColumns) {
    DraggedCube cube;
    const auto deformer = cube.deformer(kNonlinearFem);
    DragSolver drag(deformer, cube.handle_ends());
    Eigen::VectorXd values = cube.constraints.values, u;
    drag.prepare(values, kSolveTolerance, cube.control);
    const auto change = [&](double part) {
        Eigen::VectorXd changed = values;
        changed[values.size() - 4] += 20.0 * part;
        changed.tail<3>() += part * Eigen::Vector3d(10, 20, -30);
        return changed;
    };
    EXPECT_FALSE(drag.has(change(1.0))) << "the columns are those of the handle";
    drag.prepare(change(0.01), kSolveTolerance, cube.control, {drag.equilibrium(), {}});
    values = change(0.01);
    std::vector<double> off;
    for (const double part : {1.0, 0.5}) {
        ASSERT_TRUE(drag.has(change(part)));
        EXPECT_FALSE(drag.is_exact(change(part)));
        drag.displace(change(part), u);
        const Eigen::VectorXd truth = deformer->displace(change(part));
        off.push_back((u - truth).norm());
        EXPECT_LT(off.back(), 0.5 * (truth - drag.at_start()).norm());
    }
    EXPECT_NEAR(off[0] / off[1], 4.0, 0.5) << "right to second order";
}

/// Of large deformations: three columns serve a handle that is only shifted; one that turns gets those of its turn with
/// the next equilibrium.
TEST(DragSolver, FollowsAHandleThatIsShiftedAndThenTurned) {
    DraggedCube cube;
    const auto deformer = cube.deformer(kNonlinearFem);
    DragSolver drag(deformer, cube.handle_ends());
    const Eigen::VectorXd rest = cube.constraints.values;
    const Eigen::Index n = 3 * cube.handle_ends().back();
    const Positions positions = cube.mesh.checked.mesh.vertices(Eigen::all, cube.constraints.set.handles);
    const Eigen::Vector3d center = positions.rowwise().mean();
    const auto moved = [&](double shift, double turn) {
        Eigen::VectorXd values = rest;
        const Eigen::Matrix3d R = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitX()).toRotationMatrix();
        values.head(n) += (R * (positions.colwise() - center) - (positions.colwise() - center)).reshaped();
        for (Eigen::Index i = 0; i < n; i += 3) values[i] += shift;
        return values;
    };
    drag.prepare(rest, kFirstTolerance, cube.control);
    EXPECT_TRUE(drag.has(moved(0.02, 0.1))) << "nothing is known of the motion yet";
    drag.prepare(moved(0.02, 0.0), kFirstTolerance, cube.control, {drag.equilibrium(), {}});
    EXPECT_TRUE(drag.has(moved(0.04, 0.0)));
    EXPECT_FALSE(drag.has(moved(0.04, 0.1)));
    drag.prepare(moved(0.04, 0.1), kFirstTolerance, cube.control, {drag.equilibrium(), {}});
    ASSERT_TRUE(drag.has(moved(0.05, 0.15)));
    Eigen::VectorXd u;
    drag.displace(moved(0.05, 0.15), u);
    const Eigen::VectorXd truth = deformer->displace(moved(0.05, 0.15));
    EXPECT_LT((u - truth).norm(), 0.2 * (truth - drag.at_start()).norm());
}

}  // namespace
}  // namespace elastolab
