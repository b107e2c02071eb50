#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "scene/live/grip_placer.hpp"
#include "scene/live/method_runner.hpp"
#include "scene/proxy/carried_constraints.hpp"

namespace elastolab {

/// A method's answer for the surface that is shown: computed on that surface itself, or on a proxy and carried back.
/// All members are for one thread.
class EmbeddedRunner : public Answer {
public:
    /// `wake` is called by the workers when poll() will find something.
    explicit EmbeddedRunner(const std::function<void()>& wake) : runner_(wake), placer_(wake) {}

    /// The body's surface is that of `proxy`, or, when there is none, the one that is shown.
    void set_body(const Body& body, const Method& method, const std::shared_ptr<const Proxy>& proxy);
    void clear();
    /// What computes, on surface().
    MethodRunner& runner() { return runner_; }
    const MethodRunner& runner() const { return runner_; }
    /// Null when the shown surface itself is computed on.
    const Proxy* proxy() const { return carried_ ? &carried_->proxy() : nullptr; }
    /// The surface that the answer is computed on; null before set_body().
    const SurfaceMesh* surface() const { return runner_.surface(); }
    /// How the answer is carried to the shown vertices; null when the shown surface itself is computed on.
    const CarriedConstraints* carried() const { return carried_ ? &*carried_ : nullptr; }
    /// Whether the answer is for this surface.
    bool shows(const SurfaceMesh& mesh) const { return (proxy() ? proxy()->shown.get() : surface()) == &mesh; }
    /// The constraints that the answer is computed for: those of surface().
    const Constraints& constraints() const { return carried_ ? carried_->constraints() : shown_; }

    /// Those of the shown surface, last set, with handles under a force where grip_motions() have them.
    const Constraints& shown_constraints() const { return shown_; }

    /// Those of the shown surface.
    void set_constraints(const Constraints& constraints) override;
    /// Constraints that may be asked for soon.
    void prefetch(const Constraints& constraints);
    void poll() override;

    bool has_answer() const override { return runner_.has_answer(); }
    bool ready() const { return runner_.state() == MethodRunner::State::ready && !placing_grips(); }
    const Eigen::VectorXd& displacement() const override;
    std::uint64_t version() const override { return runner_.version(); }
    /// Findings of the body that is computed on, and of its proxy; some are those of CarriedConstraints::as_shown().
    Findings findings() const override;

    /// MethodRunner::check_at_rest, once handles under a force are placed.
    void check_at_rest();

    /// Handles under a force, but those that have no vertex on the proxy.
    std::vector<std::size_t> gripped() const { return constraints().gripped(); }
    /// Where these have come to; empty until that is known.
    const std::vector<AffineMotion>& grip_motions() const { return grip_motions_; }
    /// Why they stay where the scene has them though their set is there; else empty.
    const std::string& grip_failure() const { return placer_.failure(); }
    /// Where they stand is being computed.
    bool placing_grips() const { return placer_.placing(); }
    /// Stops its workers; what they were stopped at begins again with retry() or with the next change.
    void cancel() {
        runner_.cancel();
        placer_.cancel();
    }
    void retry() {
        runner_.retry();
        placer_.retry();
    }
    /// MethodRunner::begin_from_rest, with handles under a force where that leads them.
    void begin_from_rest();
    /// Whether a worker has not ended yet.
    bool stopping() const { return runner_.stopping() || placer_.working(); }

    /// One value for each vertex of surface(), carried to the shown vertices.
    Eigen::VectorXd shown_values(const Eigen::VectorXd& of_surface) const;

private:
    void give(const Constraints& constraints);
    bool may_place_grips() const;
    GripPlaces grip_places() const;
    void place_grips();
    void forget_grips();

    MethodRunner runner_;
    GripPlacer placer_;
    std::string name_;  ///< of the body
    Constraints shown_;
    std::optional<Constraints> asked_;  ///< the last ones of the shown surface, where a handle is under a force
    std::optional<CarriedConstraints> carried_, prefetched_;
    std::vector<std::vector<int>> placed_;  ///< vertices of the handles that grip_motions_ are of
    std::vector<AffineMotion> grip_motions_;
    // What was carried back last; made when it is asked for.
    mutable Eigen::VectorXd displacement_;
    mutable std::optional<std::uint64_t> displacement_version_;
};

}  // namespace elastolab
