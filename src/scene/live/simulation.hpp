#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "methods/registry.hpp"
#include "scene/live/embedded_runner.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/live/previews.hpp"
#include "scene/live/proxy_keeper.hpp"
#include "scene/live/theory_gauge.hpp"

namespace elastolab {

/// What a person may choose about the methods.
struct MethodChoices {
    Mode mode = Mode::on_demand;
    Tractions tractions = Tractions::discontinuous;
    Update update = Update::reduced;
    ElementDegree elements = ElementDegree::quadratic;
    int rims = 0;
    FrameRule frame_rule = FrameRule::drag_columns;
    /// Bodies of at most so many vertices get K and its inverse in the background.
    int complete_up_to = 2000;
    /// While a method is being prepared, a coarse preview answers.
    bool preview = true;

    /// The choices that a scene remembers.
    MethodSettings settings() const { return {mode, tractions, update, elements, rims}; }
    void set(const MethodSettings& settings) {
        mode = settings.mode;
        tractions = settings.tractions;
        update = settings.update;
        elements = settings.elements;
        rims = settings.rims;
    }
    /// The whole method of a kind under these choices.
    Method of(MethodKind kind) const;
};

/// What a worker completes a kind's model to by itself, with K and its inverse, once the methods on the screen are
/// ready; nothing where it leaves the model as it is, which is as choices.of(kind). `mesh` is what is simulated.
std::optional<Method> completion_of(const SurfaceMesh& mesh, MethodKind kind, const MethodChoices& choices);

/// The answers of several methods to one scene, each on the scene's surface or, where the method cannot use that, on a
/// proxy of it. Methods that nobody looks at are not computed; their last answers are kept, so that switching back is
/// instant. While a method's model or a new constrained set of it is being prepared, a coarse preview answers in its
/// place; so does one of a method that is not linear while a motion goes on and its equilibria take long, by the same
/// method. All members are for one thread, which calls update() once per frame.
class Simulation {
public:
    /// `wake` is called by the workers when update() will find something.
    explicit Simulation(const std::function<void()>& wake);

    /// Brings every method of `shown` up to date with the scene; the first is served first. The next one begins its
    /// precomputation when the one before has its model. Returns whether any displacement changed.
    bool update(const LiveScene& scene, const std::vector<MethodKind>& shown, const MethodChoices& choices);
    /// Prepares the methods of the last update for this set, which may be asked for soon.
    void prefetch(const Constraints& constraints);
    /// Tries again what failed or was stopped.
    void retry(MethodKind kind);
    /// MethodRunner::begin_from_rest.
    void begin_from_rest(MethodKind kind) { own(kind).begin_from_rest(); }

    MethodRunner& runner(MethodKind kind) { return own(kind).runner(); }
    const MethodRunner& runner(MethodKind kind) const { return embedded(kind).runner(); }
    /// The method's own answer, whether it is ready or not.
    const EmbeddedRunner& embedded(MethodKind kind) const { return *entries_[place(kind)].runner; }
    /// What is to be shown for the method: its answer, or what answers in its place.
    const EmbeddedRunner& answer(MethodKind kind) const;
    /// Something else answers in the method's place: its coarse preview, or stand_in().
    bool previewing(MethodKind kind) const { return entries_[place(kind)].previewing || stand_in(kind) != nullptr; }
    /// The method that was looked at before, where its answer is shown until this one or its preview has one to the
    /// present scene; else null.
    MethodKind stand_in(MethodKind kind) const;
    /// How far the preview was from the method's answer when that came: rms over all vertices, relative to the
    /// answer's; nothing when there was none.
    std::optional<double> preview_error(MethodKind kind) const { return entries_[place(kind)].preview_error; }
    /// The proxies: the one that methods simulate, and the preview's.
    const ProxyKeeper& proxies() const { return proxies_; }
    const EmbeddedRunner& preview(MethodKind kind) const { return previews_.of(kind); }
    /// The surface that a method computes on in this scene; null while its proxy is not there.
    const SurfaceMesh* simulated_surface(MethodKind kind, const LiveScene& scene) const;
    /// Whether a method's own model is not of the scene's material and choices, mode and update aside.
    bool is_of_former_model(MethodKind kind) const {
        return entries_[place(kind)].is_held_back || (runner(kind).has_answer() && !runner(kind).is_of_present_model());
    }
    /// Whether the proxy that a method needs is being made.
    bool making_proxy(MethodKind kind) const { return entries_[place(kind)].waits_for_proxy; }
    /// Why a method cannot take this scene (a mesh or material that is not fit for it), or why it failed; empty
    /// otherwise.
    std::string problem(MethodKind kind) const;

    /// Bytes that models of methods which are not shown may keep; without it, a quarter of what is free. The one that
    /// was not shown for longest is dropped first, when other methods are shown.
    void set_hidden_memory(std::uint64_t bytes) { hidden_memory_ = bytes; }
    /// Methods whose models were dropped since the last call.
    std::vector<MethodKind> take_dropped() { return std::exchange(dropped_, {}); }
    /// How far linear theory is off for the present motion, where the first method of the last update is linear and has
    /// answered; nothing until it is known. Computed on a mesh as coarse as the preview's.
    const std::optional<TheoryError>& theory_error() const { return gauge_.error(); }

    bool preparing_preview() const { return previews_.preparing(); }
    bool waiting() const;   ///< a method of the last update is not ready yet, and will be by itself
    bool busy() const;      ///< the same, or an answer is being converged, or K and its inverse completed
    bool checking() const;  ///< an answer is being checked, or will be once it has rested
    void cancel();          ///< stops all workers at their next checkpoints
    bool stopping() const;  ///< some worker has not stopped yet; for use after cancel(), without update()

private:
    struct Entry {
        MethodKind kind;
        std::unique_ptr<EmbeddedRunner> runner;
        std::string unfit = {};
        bool waits_for_proxy = false;
        bool waits_for_preview = false;  ///< its constraints are older than the scene's
        bool is_held_back = false;       ///< others come first, and its model is of the material or choices before
        bool previewing = false;         ///< by its coarse preview
        MethodKind before = nullptr;     ///< what was looked at when this one was chosen
        bool replaced_preview = false;   ///< by an answer that is not converged yet
        std::optional<double> preview_error = {};
        std::uint64_t last_shown = 0;  ///< clock_ then
    };
    std::size_t place(MethodKind kind) const;
    bool is_shown(MethodKind kind) const;
    void rest_hidden(const LiveScene& scene);
    EmbeddedRunner& own(MethodKind kind) { return *entries_[place(kind)].runner; }
    void ask_for_proxies(const LiveScene& scene, const MethodChoices& choices);
    bool update_method(Entry& entry, const LiveScene& scene, const MethodChoices& choices, bool may_begin);
    bool choose_answer(Entry& entry) const;
    void show(const std::vector<MethodKind>& shown);
    bool update_stand_in(const Entry& entry, const LiveScene& scene);
    bool give_body(Entry& entry, const LiveScene& scene, const MethodChoices& choices);
    void complete_one(const MethodChoices& choices);
    void gauge_theory(const LiveScene& scene);

    std::uint64_t memory_of(const Entry& entry) const;
    void bound_hidden_memory();

    std::vector<Entry> entries_;
    std::vector<MethodKind> shown_, dropped_;
    std::uint64_t clock_ = 0;  ///< grows when other methods are shown
    std::optional<std::uint64_t> hidden_memory_;
    ProxyKeeper proxies_;
    Previews previews_;
    TheoryGauge gauge_;
    Wish gauged_;                                 ///< of the scene, that it was asked about
    std::weak_ptr<const SurfaceMesh> gauged_on_;  ///< the scene it was needed for
    std::optional<CarriedConstraints> gauge_carried_;
};

}  // namespace elastolab
