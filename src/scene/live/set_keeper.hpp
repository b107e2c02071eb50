#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deform/deformer.hpp"
#include "deform/finding.hpp"
#include "scene/constraints.hpp"
#include "scene/live/background_job.hpp"
#include "scene/live/drag_solver.hpp"
#include "scene/wish.hpp"

namespace elastolab {

/// How a frame gets its displacements.
enum class FrameRule {
    drag_columns,  ///< three columns of the moving handle, computed when it is grabbed
    displace       ///< the method's update rule, every frame
};

/// Displacements by the method's update rule.
struct WholeUpdate {
    Eigen::VectorXd values;        ///< 3*n_handle_vertices [L], as Deformer::displace takes them
    Eigen::VectorXd displacement;  ///< 3*n_vertices [L]
};

/// Why a motion has no equilibrium, and where the body is crushed [L, at rest].
struct Crushed {
    std::string message;
    Eigen::Vector3d place;
};

/// A constrained set that is ready to answer, with what was solved for it: a drag solver, or the latest whole update,
/// whichever the frames use.
struct PreparedSet {
    std::shared_ptr<const Deformer> deformer = nullptr;
    std::optional<DragSolver> drag = std::nullopt;
    std::optional<WholeUpdate> whole = std::nullopt;  ///< not yet shown
    /// That the last solve took; before the first one nobody knows, and a frame must not find out.
    double solve_seconds = std::numeric_limits<double>::infinity();
    Findings findings = {};                                ///< of the set
    std::shared_ptr<const GripStiffness> grips = nullptr;  ///< of handles under a force, where there are any
    std::uint64_t memory_bytes = 0;  ///< of the set and, while it is made, of the estimate of its error
    // Of methods that are not linear:
    std::shared_ptr<const Wish> at = nullptr;       ///< that drag was prepared for
    std::optional<Crushed> crushed = std::nullopt;  ///< the last motion that was tried has no equilibrium
};

/// What is known of where handles under a force stand, by a method that is not linear.
enum class GripPlaces {
    in_equilibrium,  ///< where their forces hold them; or there are none, or it cannot be known
    nearby,          ///< where they stood, or what a tangent says: their equilibrium is on its way
    unknown          ///< nothing yet: what is wanted has them where the scene does, which is no answer to it
};

/// Prepares the wanted constrained set on a worker thread, and solves there for motions within it that take long. Where
/// the method iterates, columns to kFirstTolerance come first, and are converged to kSolveTolerance when there is
/// nothing else to do for the set. The set used before stays at hand. All members are for one thread.
///
/// Of a method that is not linear the worker follows the motion with equilibria, each from the one before: always for
/// the newest wish, never for a queue of them; where they take long, by turns that are not too far. Where it may hold
/// off (set_may_hold_off) and takes long, it waits until the motion rests, and gives up what is not wanted any more.
/// Nothing is solved for while the places of handles under a force are unknown.
class SetKeeper {
public:
    /// `wake` is called by the worker when poll() will find something.
    explicit SetKeeper(std::function<void()> wake) : job_(std::move(wake)) {}

    void want(const Constraints& constraints);
    /// Of the constraints that are wanted next. found: the equilibrium of current() where its handles under a force
    /// stand, from which the first answer begins; null where it is not known.
    void set_grip_places(GripPlaces places, std::shared_ptr<const Equilibrium> found);
    GripPlaces grip_places() const { return grip_places_; }
    const Wish& wanted() const { return wanted_; }
    const Eigen::VectorXd& wanted_values() const { return wanted_.values; }
    const std::vector<int>& handle_ends() const { return wanted_.ends; }
    /// True when the rule has changed.
    bool set_frame_rule(FrameRule rule);
    FrameRule frame_rule() const { return rule_; }
    /// Prepares a set that may be asked for soon, when there is nothing else to do. displacement: of all vertices
    /// where they are by now, 3*n_vertices, from where handles that are new are pulled; of another
    /// size: at rest.
    void prefetch(const ConstrainedSet& set, const Eigen::VectorXd& displacement);

    /// The sets of another model are prepared anew; the one at hand answers until then.
    void set_model(std::shared_ptr<const Model> model);
    void clear();

    enum class Event {
        none,
        another_set,    ///< current() has changed: earlier answers do not belong to it
        converged,      ///< current().drag has the same to kSolveTolerance
        motion_solved,  ///< current() has the motion that was given to the worker; as columns, its continuation too
        motion_failed   ///< see motion_failure(); of a method that is not linear, current() has what it had
    };
    /// Takes over what the worker finished and starts what is due.
    Event poll();

    /// Deformer null before the first.
    PreparedSet& current() { return current_; }
    const PreparedSet& current() const { return current_; }
    /// Whether current() is of the wanted set, by the present model or an earlier one.
    bool answers() const;
    /// Whether current() is of the wanted set by the present model.
    bool is_current() const;

    /// Solves for the wanted values within the present set; does nothing where that has failed.
    void solve_on_worker();
    /// Somebody else answers while a motion goes on, where an equilibrium takes longer than kFollowSeconds.
    void set_may_hold_off(bool may) { may_hold_off_ = may; }
    bool may_hold_off() const { return may_hold_off_; }
    static constexpr double kFollowSeconds = 1.0 / 3.0;
    /// A motion that is further ahead is followed by such turns [degree], where each takes a while: as far as a tangent
    /// predicts well, so that each is found in one or two iterations and what is shown between is near it; and to this
    /// relative residual, since they are only passed.
    static constexpr double kFollowTurn = 15.0, kPassingTolerance = 1e-3;
    /// Whether equilibria take longer than kFollowSeconds.
    bool is_slow() const;
    /// Whether current().drag has the answer to what is wanted, and no extrapolation to it.
    bool is_exact() const;
    /// Of a method that is not linear: why the motion that was tried last has no equilibrium.
    const std::optional<Crushed>& crushed() const { return current_.crushed; }
    bool solving() const {
        return job_.running() && !converging_ && is_current() && same_as_wanted(preparing_set_) && !is_overtaken();
    }
    /// Of a method that is not linear: how what is wanted is reached from the equilibrium at hand; for another thread.
    Approach approach() const { return is_current() ? approach_to(wanted_) : Approach{}; }
    /// Whether the worker iterates on what current() answers with.
    bool converging() const { return job_.running() && converging_; }

    /// Stops what runs; what is not converged stays so until the next motion. Event: motion_failed when a motion that
    /// was waited for is given up.
    Event cancel();
    void retry() {
        failure_.clear();
        failed_.reset();
        may_converge_ = true;
    }
    /// Of a method that is not linear: forgets the equilibrium at hand, so that the next one is found from rest.
    void begin_from_rest();
    bool preparing() const { return job_.running(); }
    bool working() const { return job_.working(); }
    JobStatus status() const { return job_.status(); }
    double last_seconds() const { return job_.last_seconds(); }
    /// Why the wanted set cannot be had, or that it was stopped; else empty.
    const std::string& failure() const { return failure_; }
    const std::string& motion_failure() const { return motion_failure_; }

private:
    Event take_finished();
    Event use_or_prepare();
    void prepare(const ConstrainedSet& set, Wish wish);
    void update_on_worker();
    Event take_solution(PreparedSet prepared);
    bool is_linear() const { return current_.deformer->linear(); }
    bool may_solve_now();
    bool is_overtaken() const;
    Approach approach_to(const Wish& wish) const;
    std::optional<Wish> next_step() const;
    void converge_on_worker();
    void serve_further_sets();
    Event take_failure();
    void prepare_prefetched(const ConstrainedSet& set);
    std::shared_ptr<const Equilibrium> start_for(const ConstrainedSet& set) const;
    bool same_as_wanted(const ConstrainedSet& set) const;

    ConstrainedSet wanted_set_;
    std::vector<Grip> wanted_grips_;  ///< handles of it that are under a force
    GripPlaces grip_places_ = GripPlaces::in_equilibrium;
    std::shared_ptr<const Equilibrium> found_;  ///< of current_, with handles under a force where they stand
    Wish wanted_;
    Stopwatch rest_;  ///< since another motion was wanted
    FrameRule rule_ = FrameRule::drag_columns;
    std::optional<ConstrainedSet> prefetch_;
    Positions prefetch_moved_;  ///< its handles: how far they are moved by now

    std::shared_ptr<const Model> model_;
    PreparedSet current_;
    PreparedSet spare_;  ///< of the same model: prefetched, or the one used before
    ConstrainedSet preparing_set_;
    bool converging_ = false, may_converge_ = true;
    bool may_serve_sets_ = true;  ///< not yet tried with this model
    Wish solving_;                ///< what the worker solves for within the present set
    std::optional<Wish> failed_;  ///< that has no equilibrium
    bool may_hold_off_ = false;
    bool is_anew_ = false;  ///< the next equilibrium is to be found from rest, whatever is known
    std::string failure_, motion_failure_;
    BackgroundJob<PreparedSet> job_;  // last: its thread ends before what it wakes is destroyed
};

}  // namespace elastolab
