#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deform/grip.hpp"
#include "deform/grip_check.hpp"
#include "deform/grip_equilibrium.hpp"
#include "scene/constraints.hpp"
#include "scene/live/background_job.hpp"

namespace elastolab {

/// Where handles under a force stand, for a watcher that never waits. By linear methods forces that change cost a small
/// dense system, and anything else that changes costs a solve, on a worker where that takes longer than a frame has;
/// meanwhile handles stand where they would if nothing else had changed. By others a worker follows with equilibria,
/// the newest forces next, and handles stand where the tangent of the last one has them. All members are for one
/// thread.
class GripPlacer {
public:
    /// `wake` is called by the worker when poll() will find something.
    explicit GripPlacer(std::function<void()> wake) : job_(std::move(wake)) {}

    /// The motions of constraints.gripped(); none where they are not known yet, or nothing holds them (failure()).
    /// deformer: of the constraints' set. made: stiffness that came with the set, if any; null else.
    std::optional<std::vector<AffineMotion>> place(const std::shared_ptr<const Deformer>& deformer,
                                                   Constraints constraints,
                                                   const std::shared_ptr<const GripStiffness>& made);
    /// The handles where place() has put them, when it is not placing(); none where it has none.
    GripsInPlace in_place() const;
    /// Whether place() would say something new.
    bool poll();
    /// No handle is under a force any more.
    void clear();
    /// The set is being prepared: nothing is known of it, and no failure.
    void wait() {
        failure_.clear();
        exact_.reset();
    }
    /// Stops the worker. What it was stopped at begins again with retry() or with the next change.
    void cancel();
    void retry();
    /// Of a method that is not linear: what place() says next is found from rest.
    void begin_from_rest();

    /// Whether the worker is at it: what place() said last is not the last word.
    bool placing() const { return deformer_ != nullptr && job_.running(); }
    bool working() const { return job_.working(); }
    /// Of a method that is not linear, where place() said last where the forces hold them and not what is near; else
    /// null.
    const std::shared_ptr<const Equilibrium>& equilibrium() const { return exact_; }
    /// Why place() has none; else empty.
    const std::string& failure() const { return failure_; }

private:
    /// What the worker makes: stiffness, and what one solve took; or an equilibrium.
    struct Made {
        std::shared_ptr<const GripStiffness> stiffness = nullptr;
        double solve_seconds = std::numeric_limits<double>::infinity();
        std::shared_ptr<const GripEquilibrium> equilibrium = nullptr;
        Eigen::VectorXd asked = {};  ///< the equilibrium is for these values
    };
    std::optional<std::vector<AffineMotion>> place_by_stiffness(Constraints& constraints);
    std::optional<std::vector<AffineMotion>> place_by_equilibria(Constraints& constraints);
    /// Starts the worker for these constraints, unless it is at it or has failed for them.
    void follow(const Constraints& constraints);
    static Made updated(GripStiffness stiffness, const Deformer& deformer, const Eigen::VectorXd& values,
                        Control& control);
    bool holds(const std::vector<Grip>& grips) const { return made_.stiffness && made_.stiffness->grips() == grips; }
    void make(const Eigen::VectorXd& values, const std::vector<Grip>& grips);
    void update(const Eigen::VectorXd& values);
    bool was_asked(const Eigen::VectorXd& values) const;
    void ask(const Eigen::VectorXd& values);

    std::shared_ptr<const Deformer> deformer_;
    Made made_;
    std::shared_ptr<const Equilibrium> exact_;  ///< of made_, where it is what place() was asked for
    // Of the worker.
    std::vector<Grip> asked_grips_;
    Eigen::VectorXd asked_;                ///< values
    std::vector<GripForce> asked_forces_;  ///< of methods that are not linear
    std::string worker_failure_;           ///< for these; empty where it has not failed
    std::string failure_;
    BackgroundJob<Made> job_;  // last: its thread ends before what it wakes is destroyed
};

}  // namespace elastolab
