#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "base/timer.hpp"
#include "deform/deformer.hpp"
#include "scene/linear_theory.hpp"
#include "scene/live/background_job.hpp"
#include "scene/wish.hpp"

namespace elastolab {

/// How far linear elasticity is off for a motion.
struct TheoryError {
    double relative = 0.0;  ///< as LinearTheoryGauge has it
    bool crushed = false;   ///< a real body has no equilibrium for this motion
    bool turns = false;     ///< the motion is a turn, of some handle at least
    bool loads = false;     ///< loads alone move the body
};

/// Computes that error in the background, on a coarse mesh, once a motion has rested. All members are for one thread.
class TheoryGauge {
public:
    /// `wake` is called by the worker when update() will find something.
    explicit TheoryGauge(std::function<void()> wake) : job_(std::move(wake)) {}

    /// The motion that is shown, and what it is gauged on: a body with few vertices, and a set, a wish of it and what
    /// moves by forces. Once per frame.
    void update(const Body& body, const ConstrainedSet& set, const Wish& wish, const HandleForces& by_force);
    /// There is nothing to gauge.
    void rest();
    /// Of the last update's motion; nothing until it is known, and where the body cannot take the methods.
    const std::optional<TheoryError>& error() const { return error_; }
    /// Whether it will be known by itself.
    bool working_on_it() const { return wanted_ && !done_; }

    void cancel() { job_.cancel(); }
    bool working() const { return job_.working(); }

private:
    /// A gauge, and what it was made for.
    struct Made {
        std::shared_ptr<const SurfaceMesh> surface;
        Material material;  ///< forces move a stiffer body less
        ConstrainedSet set;
        LinearTheoryGauge gauge;
    };
    struct Found {
        std::shared_ptr<const Made> made = nullptr;
        TheoryError error = {};
    };
    static Found find(std::shared_ptr<const Made> made, const Body& body, const ConstrainedSet& set, const Wish& wish,
                      const HandleForces& by_force, Control& control);

    std::shared_ptr<const Made> made_;
    std::optional<Wish> wanted_;
    ConstrainedSet set_;
    std::shared_ptr<const SurfaceMesh> surface_;
    Material material_;
    Stopwatch rest_;  ///< since another motion was wanted
    bool done_ = false;
    std::optional<TheoryError> error_;
    BackgroundJob<Found> job_;
};

}  // namespace elastolab
