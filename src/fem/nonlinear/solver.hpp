#pragma once

#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <vector>

#include "base/control.hpp"
#include "base/spare.hpp"
#include "deform/equilibrium.hpp"
#include "deform/node_solver.hpp"
#include "elasticity/material.hpp"
#include "fem/nonlinear/elements.hpp"
#include "fem/nonlinear/newton.hpp"
#include "fem/nonlinear/patch_motion.hpp"
#include "fem/nonlinear/warp.hpp"

namespace elastolab {

/// Nodes that are prescribed, for a NonlinearSolver.
struct PrescribedNodes {
    std::vector<int> nodes;
    int n_fixed = 0;   ///< the first ones do not move
    bool held = true;  ///< false: the body can move as a whole, and of all motions the smallest is taken
};

/// An equilibrium of one solid. Its factorised tangent is there for as long as the solver keeps it: equilibria that are
/// remembered would each hold one.
class NonlinearState : public NodeState {
public:
    NonlinearState(NewtonState newton, EquilibriumFacts facts)
        : newton_(std::move(newton)), factor_(newton_.factor), facts_(facts) {
        newton_.factor.reset();
    }
    EquilibriumFacts facts() const override { return facts_; }
    /// Without a factor, which is that of other free nodes.
    std::shared_ptr<const NodeState> for_another_set() const override {
        return std::make_shared<const NonlinearState>(newton_, facts_);
    }
    /// Without the factor.
    const NewtonState& newton() const { return newton_; }
    NewtonState with_factor() const {
        NewtonState state = newton_;
        state.factor = factor_.lock();
        return state;
    }

private:
    NewtonState newton_;
    std::weak_ptr<const SparseCholesky> factor_;
    EquilibriumFacts facts_;
};

/// Equilibria of a neo-Hookean body for one constrained set under given loads; on the way from one to the next the
/// loads grow with the motion. NodeSolution::loads are the forces at the constrained nodes. Throws NoEquilibriumError
/// where none is found, with the place of the crushed element at rest.
class NonlinearSolver : public NodeSolver {
public:
    NonlinearSolver(std::shared_ptr<const FiniteElements> elements, const Material& material, PrescribedNodes nodes,
                    Control& control, NonlinearLoads loads = {});

    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;
    NodeSolution solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                               Control& control) const override;
    NodeSolution solve_task(const NodeTask& task, double tolerance, Control& control) const override;
    bool linear() const override { return false; }

    const FiniteElements& elements() const { return newton_.tangent().elements(); }
    const Newton& newton() const { return newton_; }
    const std::vector<int>& nodes() const { return nodes_.nodes; }

private:
    using StatePtr = std::shared_ptr<const NonlinearState>;
    /// Residual to which equilibria on the way are found.
    static constexpr double kPassing = 1e-3;
    /// Iterations that a factor of a state close by is worth.
    static constexpr int kFewIterations = 8;
    static constexpr const char* kNoTangent =
        "tangent stiffness: is not finite. Check the mesh for degenerate tetrahedra.";

    /// The equilibrium for these values (NodeTask::prescribed), from one before it. far: rotation-strain warping may
    /// begin.
    StatePtr advance(const NonlinearState& from, const Eigen::VectorXd& values, bool far, double tolerance,
                     int most_steps, NewtonWork& work, Control& control) const;
    // The way from one equilibrium to the next (equilibrium_path.cpp).
    NewtonState warped(const MotionPath& path, const Eigen::VectorXd& factors, double tolerance, int most_steps,
                       NewtonWork& work, Control& control) const;
    Eigen::VectorXd tangent_answer(NewtonState& at, const Eigen::VectorXd& load, int& iterations, NewtonWork& work,
                                   Control& control) const;
    Eigen::VectorXd predicted(NewtonState& at, const Eigen::VectorXd& prescribed, const Eigen::VectorXd& factors,
                              int& iterations, NewtonWork& work, Control& control) const;
    NewtonState followed(const NonlinearState& from, const MotionPath& path, const Eigen::VectorXd& factors,
                         double tolerance, int most_steps, NewtonWork& work, Control& control) const;
    Eigen::VectorXd factors_of(const Eigen::VectorXd& values) const { return values.tail(newton_.loads().size()); }
    Eigen::VectorXd displacements_of(const Eigen::VectorXd& values) const {
        return values.head(3 * std::ssize(nodes_.nodes));
    }
    /// Whether an equilibrium is stable, where the tangent on the way to it was not positive definite: out of
    /// equilibrium that of a body which is free to turn is not, since turning it by its tangent changes its energy.
    void judge_at_its_end(NewtonState& state, NewtonWork& work, Control& control) const;
    bool leaves(const NewtonState& state, NewtonWork& work, Control& control) const;
    Eigen::VectorXd pushed_far(const NewtonState& state, const Eigen::VectorXd& push, NewtonWork& work,
                               Control& control) const;
    /// The state itself where it is stable, else the stable one that it is left for, where there is one.
    NewtonState stabilised(NewtonState state, double tolerance, int most_steps, NewtonWork& work,
                           Control& control) const;
    /// Of a body that nothing holds, turned about what its loads do not resist.
    NewtonState turned_to_rest(NewtonState state, double tolerance, NewtonWork& work, Control& control) const;
    StatePtr settled(NewtonState state, double tolerance, int most_steps, NewtonWork& work, Control& control) const;
    /// Keeps a factor, in place of the last one.
    void keep(std::shared_ptr<const SparseCholesky> factor) const;
    StatePtr at_rest(NewtonWork& work, Control& control) const;
    /// tolerance: of the state.
    Eigen::MatrixXd derivatives(const NonlinearState& state, const Eigen::MatrixXd& changes, double tolerance,
                                NewtonWork& work, Control& control) const;
    Eigen::VectorXd of_all_nodes(const Eigen::VectorXd& prescribed) const;
    Eigen::VectorXd of_prescribed(const Eigen::VectorXd& all) const;
    std::shared_ptr<const WarpedStart> rest(NewtonWork& work, Control& control) const;

    void find_faces();
    /// Throws NoEquilibriumError where a prescribed face is flattened: the Gauss points of ten-node elements do not see
    /// that their volume vanishes there.
    void require_faces(const Eigen::VectorXd& prescribed) const;

    PrescribedNodes nodes_;
    /// Faces of elements with all corners on handles: their places among the prescribed nodes.
    std::vector<Eigen::Vector3i> faces_;
    std::vector<int> patches_;
    Positions rest_positions_;
    Newton newton_;
    mutable Spare<std::unique_ptr<NewtonWork>> work_;
    mutable std::mutex rest_mutex_;
    mutable std::shared_ptr<const WarpedStart> rest_;
    mutable std::mutex kept_mutex_;
    mutable std::shared_ptr<const SparseCholesky> kept_;  ///< of the last equilibrium, from which the next one begins
};

}  // namespace elastolab
