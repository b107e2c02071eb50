#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "scene/live/answer.hpp"
#include "scene/live/model_keeper.hpp"
#include "scene/live/rest_check.hpp"
#include "scene/live/set_keeper.hpp"

namespace elastolab {

/// One method's answer to a scene that is being edited: a model precomputed on a worker thread, the constrained set
/// prepared on another, and from them the displacements of every frame at once. The last complete answer stays until
/// the next one is there.
class MethodRunner : public Answer {
public:
    enum class State {
        idle,          ///< no body yet, or the precomputation was cancelled before there was any model
        precomputing,  ///< no model of this body, material and method yet
        preparing,     ///< the model is there; the constrained set, or a motion that takes long, is being prepared
        ready,         ///< displacements are those of the scene
        failed         ///< see failure(); the last complete answer stays
    };

    /// `wake` is called by the workers when poll() will find something.
    explicit MethodRunner(const std::function<void()>& wake) : models_(wake), sets_(wake), check_(wake) {}

    /// Asks for this body and method (ModelKeeper::ask).
    void set_body(const Body& body, const Method& method);
    /// Forgets the body and all that belongs to it. May be called again and again: that is how its workers come to
    /// rest.
    void clear();
    /// The surface of the body last set; null before.
    const SurfaceMesh* surface() const { return models_.body().surface.get(); }
    /// Constraints belong to the body last set.
    void set_constraints(const Constraints& constraints) override { sets_.want(constraints); }
    /// SetKeeper::set_grip_places, of the constraints that are set next. While places are unknown, the last complete
    /// answer stays.
    void set_grip_places(GripPlaces places, std::shared_ptr<const Equilibrium> found) {
        sets_.set_grip_places(places, std::move(found));
    }
    void set_frame_rule(FrameRule rule);
    /// Seconds that poll() may solve for a new motion itself, judged by the last time; longer solves, and the first
    /// ones of a set or of a rule, go to the worker, and the previous answer stays meanwhile.
    void set_solve_budget(double seconds) { solve_budget_ = seconds; }
    /// SetKeeper::set_may_hold_off.
    void set_may_hold_off(bool may) { sets_.set_may_hold_off(may); }
    void prefetch(const ConstrainedSet& set) { sets_.prefetch(set, displacement_); }

    void complete(Update update) { models_.complete(update); }
    bool may_complete(Update update) const { return models_.may_complete(update); }
    void postpone_completion() { models_.postpone_completion(); }

    /// Once the answer has rested for a while: estimates in the background how far it can be trusted (residual, and
    /// what the coarseness of the mesh does). What is found is among findings() until the answer changes.
    /// grips: its handles under a force, asked for when the estimate begins.
    void check_at_rest(const std::function<GripsInPlace()>& grips);
    bool unchecked() const { return state() == State::ready && has_motion() && !check_.done(); }
    Findings findings() const override;

    /// Takes over the models that the workers finished, and does nothing with them yet.
    void take_models();
    void poll() override;

    /// Stops the precomputation, the completion or the preparation that runs. What is there stays; what was stopped
    /// begins again with retry() or with the next change.
    void cancel();
    void retry();
    /// Of a method that is not linear: finds the equilibrium anew, from rest. An elastic body may have several, and one
    /// that was pulled far can stay in another than a straight way from rest leads to.
    void begin_from_rest();
    bool stopping() const { return models_.working() || sets_.working() || check_.working(); }

    State state() const;
    /// Why the present scene has no answer; empty when it has one or will have.
    const std::string& failure() const;
    const Eigen::VectorXd& displacement() const override { return displacement_; }
    std::uint64_t version() const override { return version_; }
    bool has_answer() const override;
    /// The model that answers now; null before the first.
    const std::shared_ptr<const Model>& model() const { return models_.model(); }
    const Method& method() const { return models_.method(); }
    /// What answers now (null before the first), for reactions and quality.
    const std::shared_ptr<const Deformer>& deformer() const { return sets_.current().deformer; }
    /// Of handles under a force, with everything else as it was when the set was prepared; null where there were none.
    const std::shared_ptr<const GripStiffness>& grips() const { return sets_.current().grips; }
    /// The values that displacement() belongs to, as Deformer::displace takes them; empty before the first answer.
    const Eigen::VectorXd& values() const { return values_; }
    /// Whether these are what the scene asks for.
    bool shows_wanted() const { return same(seen_, sets_.wanted()); }
    /// How values() are reached from the last equilibrium, of a method that is not linear.
    Approach approach() const { return following() ? sets_.approach() : Approach{equilibrium(), {}}; }
    /// Whether the constrained set is prepared.
    bool has_set() const { return sets_.is_current(); }
    /// Of a method that is not linear: an equilibrium takes longer than SetKeeper::kFollowSeconds.
    bool is_slow() const { return sets_.is_slow(); }
    /// The equilibrium that displacement() is, of a method that is not linear; null while it is following().
    std::shared_ptr<const Equilibrium> equilibrium() const;
    /// Whether displacement() is the solution for values(): false where there is none, and the previous answer stands.
    bool solved() const { return solved_; }
    /// Relative residual of displacement(), where the method iterates: kFirstTolerance at first, and kSolveTolerance
    /// once it is converged.
    double tolerance() const { return tolerance_; }
    bool converged() const { return tolerance_ <= kSolveTolerance; }
    /// Of a method that is not linear: displacement() is what the tangent about the last equilibrium makes of the
    /// present motion, or has handles where their forces do not hold them yet, and the equilibrium is on its way.
    bool following() const { return following_ || (has_answer() && !is_placed()); }
    /// Of a method that is not linear: the motion that was tried last has no equilibrium, and displacement() is the
    /// last one that was found.
    const std::optional<Crushed>& crushed() const { return sets_.crushed(); }
    /// Whether it is being converged.
    bool converging() const { return sets_.converging(); }

    /// Whether displacement() is what the scene asks for, by whichever model that has the same: a model with its
    /// inverse is prepared while the one without it answers.
    bool answers() const;
    /// Whether what answers now is of this material and these choices, mode and update aside. Forces depend on Young's
    /// modulus where displacements need not.
    bool is_of(const Material& material, const Method& method) const;
    /// The same of those that were asked for.
    bool is_of_present_model() const { return is_of(models_.body().material, models_.method()); }

    bool precomputing() const { return models_.precomputing(); }
    bool preparing() const { return sets_.preparing(); }
    bool completing() const { return models_.completing(); }
    bool has_inverse() const { return models_.has_inverse(); }
    /// That of the job that runs now; of several, the one that is waited for.
    JobStatus status() const;
    /// Bytes that the set that answers takes and, while it is made, the estimate of its error; 0 before there is one.
    std::uint64_t set_memory() const { return sets_.current().memory_bytes; }
    /// Seconds that the last preparation of a constrained set took.
    double prepare_seconds() const { return sets_.last_seconds(); }

private:
    void forget_answer();
    bool model_fits() const;
    void handle(SetKeeper::Event event);
    /// Handles under a force are where they are in equilibrium.
    bool is_placed() const { return sets_.grip_places() == GripPlaces::in_equilibrium; }
    bool was_tried(const Eigen::VectorXd& wanted) const;
    bool takes_long() const;
    void update_displacement();
    void update_whole();
    void drag();
    void take_whole_update();
    void follow();
    void fall_back();
    void take_values(Eigen::VectorXd values, bool solved);
    bool has_motion() const { return solved_ && !values_.isZero(0.0); }

    ModelKeeper models_;
    SetKeeper sets_;
    RestCheck check_;
    std::string failure_;  ///< of the wanted values
    double solve_budget_ = 0.015;
    bool up_to_date_ = false;  ///< values_ were tried under the present set
    bool solved_ = false, following_ = false;
    double tolerance_ = kSolveTolerance;
    Eigen::VectorXd values_, displacement_;
    Wish seen_;  ///< that values_ are of
    std::uint64_t version_ = 0;
};

}  // namespace elastolab
