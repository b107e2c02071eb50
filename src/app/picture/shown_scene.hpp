#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/picture/colour_scale.hpp"
#include "app/picture/load_arrows.hpp"
#include "app/picture/reaction_runner.hpp"
#include "app/picture/section_runner.hpp"
#include "app/picture/shown_body.hpp"
#include "app/settings.hpp"
#include "render/viewport.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/live/simulation.hpp"

namespace elastolab {

/// A view of one or more methods' answers, somewhere in the window.
struct SceneViewport {
    Viewport place;
    std::vector<MethodKind> kinds;  ///< the first is the solid one, the others are its ghosts
};

/// What is to be seen.
struct ShownAnswers {
    const LiveScene& scene;
    const Simulation& simulation;
    std::vector<MethodKind> kinds;              ///< of the methods on the screen
    const EmbeddedRunner* reference = nullptr;  ///< of differences; null when nothing needs one
    const DisplaySettings& display;
    bool probed = false;         ///< a person looks at tractions and stresses of vertices
    bool forces_wanted = false;  ///< whatever is shown
    bool pulling = false;        ///< the range of the colours may be held meanwhile
};

/// What is on the screen: the bodies as the methods' answers have them, and what only the picture needs of the answers
/// (reactions, the inside of a body that is cut open). Owned by one thread.
class ShownScene {
public:
    /// `wake` is called by workers when poll() or update() will find something.
    explicit ShownScene(const std::function<void()>& wake) : wake_(wake) {}

    std::vector<SceneViewport> viewports;  ///< where the scene is in this frame
    const std::vector<ShownBody>& bodies() const { return bodies_; }
    const ShownBody* body(MethodKind kind) const;
    /// Why forces, tractions and stresses of this method are not known; empty when they are or will be.
    const std::string& reaction_failure(MethodKind kind) const;
    /// Whether something is shown that needs them, so that they are known as soon as they can be.
    bool wants_reactions() const { return wants_reactions_; }
    /// The range of the colours, and their scale.
    std::pair<double, double> field_range(const DisplaySettings& display) const;
    ColourScale field_scale(const DisplaySettings& display) const;

    /// The arrows of gravity and of all loads at this body, one of bodies(); see load_arrows().
    const std::vector<LoadArrow>& load_arrows_at(const ShownBody& body, const LiveScene& scene, double radius,
                                                 const std::optional<DraggedLoad>& dragged) const {
        return load_arrows_[body.kind()].update(scene, body.positions(), body.revision(), radius, dragged);
    }
    /// How often they were computed for this method.
    int n_load_arrows_computed(MethodKind kind) const { return load_arrows_[kind].n_computed(); }

    /// The scene was replaced.
    void forget();
    /// Why what is inside the body by this method is not known; empty when it is or will be.
    const std::string& section_failure(MethodKind kind) const;
    /// What the cut costs, of all methods; nothing when no body is cut open.
    struct SectionCost {
        SectionRunner::Cost inside;   ///< sums
        double update_seconds = 0.0;  ///< of the last update that changed something, for cutting and for following
    };
    const std::optional<SectionCost>& section_cost() const { return section_cost_; }
    /// Brings all that is shown up to date; returns whether something changed.
    bool update(const ShownAnswers& answers);

    bool cutting() const;  ///< what is inside the body is being evaluated
    bool solving() const;  ///< reactions are being computed
    /// Stops all workers at their next checkpoints; working(): some have not stopped yet.
    void cancel();
    bool working() const;

private:
    double largest_magnitude(const DisplaySettings& display) const;
    ShownBody& body_of(MethodKind kind);
    const ReactionRunner* reactions(const ShownAnswers& answers, MethodKind kind);
    void update_filling(const ShownAnswers& answers);
    std::shared_ptr<const SectionShape> section(const ShownAnswers& answers);
    const SectionRunner* inside(const ShownAnswers& answers, MethodKind kind);
    void hold_range(const ShownAnswers& answers);
    void sum_costs(double update_seconds);

    std::vector<ShownBody> bodies_;  ///< of every method on the screen
    mutable std::map<MethodKind, KeptLoadArrows> load_arrows_;
    std::function<void()> wake_;
    std::map<MethodKind, std::unique_ptr<ReactionRunner>> reactions_;
    bool wants_reactions_ = false;
    std::shared_ptr<const FillingShape> filling_;  ///< null where no method simulates the body with its holes filled
    std::shared_ptr<const SectionShape> section_;
    std::map<MethodKind, std::unique_ptr<SectionRunner>> insides_;
    std::optional<SectionCost> section_cost_;
    bool holding_ = false;
    std::optional<double> held_range_;  ///< its upper end; none while holding_ what began at rest
};

}  // namespace elastolab
