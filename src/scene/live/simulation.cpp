#include "scene/live/simulation.hpp"

#include <algorithm>

#include "findings/cost.hpp"
#include "methods/registry.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

namespace {

using State = MethodRunner::State;

/// What nobody waits for may take so long by itself.
constexpr double kMaxCompletionSeconds = 120.0;

bool worth_completing(const SurfaceMesh& mesh, const Method& method, int complete_up_to) {
    if (mesh.n_vertices() > complete_up_to) return false;
    Method full = method;
    full.mode = Mode::full;
    return predict_cost(mesh, full).seconds <= kMaxCompletionSeconds;
}

}  // namespace

Method MethodChoices::of(MethodKind kind) const {
    Method method{.kind = kind, .mode = mode, .tractions = tractions, .update = update};
    if (!has(kind, mode)) method.mode = has(kind, Mode::full) ? Mode::full : Mode::on_demand;
    if (!has(kind, update)) method.update = Update::reduced;
    if (!kind->chooses_tractions) method.tractions = Tractions::discontinuous;
    if (method.mode == Mode::on_demand && method.update == Update::eqn9) method.update = Update::reduced;
    return method;
}

Simulation::Simulation(const std::function<void()>& wake) {
    for (const MethodKind kind : all_methods()) entries_.push_back({kind, std::make_unique<MethodRunner>(wake), ""});
}

/// Index in entries_.
std::size_t Simulation::place(MethodKind kind) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.kind == kind; });
    return static_cast<std::size_t>(found - entries_.begin());
}

bool Simulation::is_shown(MethodKind kind) const {
    return std::find(shown_.begin(), shown_.end(), kind) != shown_.end();
}

MethodRunner& Simulation::runner(MethodKind kind) { return *entries_[place(kind)].runner; }
const MethodRunner& Simulation::runner(MethodKind kind) const { return *entries_[place(kind)].runner; }

std::string Simulation::problem(MethodKind kind) const {
    const Entry& found = entries_[place(kind)];
    return found.unfit.empty() ? found.runner->failure() : found.unfit;
}

/// Gives a method the scene's body; false when it cannot take it.
bool Simulation::give_body(Entry& entry, const LiveScene& scene, const MethodChoices& choices) {
    entry.unfit.clear();
    try {
        entry.runner->set_body(scene.body(entry.kind), choices.of(entry.kind));
        return true;
    } catch (const std::exception& error) {
        entry.unfit = user_text(error);
        entry.runner->clear();
        return false;
    }
}

bool Simulation::update(const LiveScene& scene, const std::vector<MethodKind>& shown, const MethodChoices& choices) {
    shown_ = shown;
    rest_hidden(scene);
    bool changed = false, waiting = false;
    for (const MethodKind kind : shown) {
        Entry& present = entries_[place(kind)];
        MethodRunner& runner = *present.runner;
        const std::uint64_t before = runner.version();
        if (!waiting) give_body(present, scene, choices);
        if (runner.surface() != &scene.mesh()) {  // its turn has not come yet
            runner.clear();
            changed = changed || runner.version() != before;
            continue;
        }
        runner.set_frame_rule(choices.frame_rule);
        runner.set_constraints(scene.constraints());
        runner.poll();
        changed = changed || runner.version() != before;
        waiting = waiting || runner.precomputing();
    }
    for (const MethodKind kind : shown) runner(kind).check_at_rest();
    complete_one(scene, choices);
    return changed;
}

/// What a hidden method was computing is taken over when it is done, and given up when it is of another body.
void Simulation::rest_hidden(const LiveScene& scene) {
    for (const Entry& entry : entries_) {
        if (is_shown(entry.kind)) continue;
        if (entry.runner->surface() == &scene.mesh())
            entry.runner->take_models();
        else
            entry.runner->clear();
    }
}

/// Only when every shown method is ready, and one at a time: what is looked at comes first.
void Simulation::complete_one(const LiveScene& scene, const MethodChoices& choices) {
    if (choices.mode != Mode::on_demand) return;
    const bool precomputing =
        std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) { return runner(kind).precomputing(); });
    for (const Entry& entry : entries_)
        if (precomputing || !is_shown(entry.kind)) entry.runner->postpone_completion();
    if (busy()) return;
    for (const MethodKind kind : shown_) {
        if (!runner(kind).may_complete(choices.update)) continue;  // far cheaper to ask than what it would cost
        if (!worth_completing(scene.mesh(), choices.of(kind), choices.complete_up_to)) continue;
        runner(kind).complete(choices.update);
        if (runner(kind).completing()) return;
    }
}

void Simulation::prefetch(const ConstrainedSet& set) {
    for (const MethodKind kind : shown_) runner(kind).prefetch(set);
}

bool Simulation::waiting() const {
    return std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) {
        const State state = runner(kind).state();
        return state == State::precomputing || state == State::preparing;
    });
}

bool Simulation::busy() const {
    return waiting() ||
           std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) { return runner(kind).completing(); });
}

bool Simulation::checking() const {
    return std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) { return runner(kind).unchecked(); });
}

void Simulation::cancel() {
    for (Entry& entry : entries_) entry.runner->cancel();
}

bool Simulation::stopping() const {
    return std::any_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.runner->stopping(); });
}

}  // namespace elastolab
