#include "scene/live/simulation.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "findings/cost.hpp"
#include "methods/registry.hpp"
#include "scene/linear_theory.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

namespace {

using State = MethodRunner::State;

/// Longest predicted time of a completion, which nobody waits for.
constexpr double kMaxCompletionSeconds = 120.0;
/// Of the memory that is free, methods that are not shown keep one part in so many.
constexpr std::uint64_t kPartForHidden = 4;

/// As `solve` does it, so that both say the same.
bool is_gauged_itself(const LiveScene& scene) {
    return scene.mesh().n_vertices() <= kMostGaugedThemselves && !scene.needs_proxy(large_deformation_method());
}

}  // namespace

std::optional<Method> completion_of(const SurfaceMesh& mesh, MethodKind kind, const MethodChoices& choices) {
    const bool can_be = kind->full_serves_sets && has(kind, Mode::full) && has(kind, choices.update);
    if (choices.mode != Mode::on_demand || !can_be || mesh.n_vertices() > choices.complete_up_to) return std::nullopt;
    Method full = choices.of(kind);
    full.mode = Mode::full;
    if (predict_cost(mesh, full).seconds() > kMaxCompletionSeconds) return std::nullopt;
    return full;
}

Method MethodChoices::of(MethodKind kind) const {
    Method method{.kind = kind, .mode = mode, .tractions = tractions, .update = update};
    method.first_set_alone = true;
    if (!has(kind, mode)) method.mode = has(kind, Mode::full) ? Mode::full : Mode::on_demand;
    if (!has(kind, update)) method.update = Update::reduced;
    if (kind->chooses_elements) method.elements = elements;
    if (kind->chooses_rims) method.rims = rims;
    if (!kind->chooses_tractions) method.tractions = Tractions::discontinuous;
    if (method.mode == Mode::on_demand && method.update == Update::eqn9) method.update = Update::reduced;
    return method;
}

Simulation::Simulation(const std::function<void()>& wake) : proxies_(wake), previews_(wake), gauge_(wake) {
    for (const MethodKind kind : all_methods()) entries_.push_back({kind, std::make_unique<EmbeddedRunner>(wake)});
}

/// Index in entries_.
std::size_t Simulation::place(MethodKind kind) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.kind == kind; });
    return static_cast<std::size_t>(found - entries_.begin());
}

bool Simulation::is_shown(MethodKind kind) const {
    return std::find(shown_.begin(), shown_.end(), kind) != shown_.end();
}

MethodKind Simulation::stand_in(MethodKind kind) const {
    const Entry& entry = entries_[place(kind)];
    if (entry.before == nullptr || entry.before == kind || entry.previewing) return nullptr;
    return problem(kind).empty() && embedded(entry.before).has_answer() ? entry.before : nullptr;
}

const EmbeddedRunner& Simulation::answer(MethodKind kind) const {
    if (entries_[place(kind)].previewing) return preview(kind);
    const MethodKind other = stand_in(kind);
    return embedded(other ? other : kind);
}

std::string Simulation::problem(MethodKind kind) const {
    const Entry& found = entries_[place(kind)];
    if (!found.unfit.empty()) return found.unfit;
    const std::string& failure = found.runner->runner().failure();
    return failure.empty() ? found.runner->grip_failure() : failure;
}

const SurfaceMesh* Simulation::simulated_surface(MethodKind kind, const LiveScene& scene) const {
    if (!scene.needs_proxy(kind)) return &scene.mesh();
    return proxies_.model() && proxies_.model()->shown == scene.surface() ? proxies_.model()->surface.get() : nullptr;
}

void Simulation::ask_for_proxies(const LiveScene& scene, const MethodChoices& choices) {
    previews_.choose(scene, shown_, !shown_.empty() && runner(shown_.front()).answers(), choices.preview);
    const auto needs_proxy = [&](MethodKind kind) { return scene.needs_proxy(kind); };
    const bool needs_model = std::any_of(shown_.begin(), shown_.end(), needs_proxy) || proxies_.model();
    const bool gauges = choices.preview && is_worth_a_preview(scene) && gauged_on_.lock() == scene.surface() &&
                        !is_gauged_itself(scene);
    proxies_.ask(scene, needs_model, previews_.need_proxy() || gauges ? kPreviewVertices : 0);
    proxies_.poll();
}

/// Gives a method the body that it simulates; false when it cannot have one, or not yet.
bool Simulation::give_body(Entry& entry, const LiveScene& scene, const MethodChoices& choices) {
    entry.unfit.clear();
    entry.waits_for_proxy = false;
    try {
        std::shared_ptr<const Proxy> proxy;
        if (scene.needs_proxy(entry.kind)) {
            proxy = proxies_.model();
            if (!proxy && !proxies_.failure().empty()) throw MeshError(proxies_.failure());
            entry.waits_for_proxy = !proxy;
        }
        if (entry.waits_for_proxy)
            entry.runner->clear();
        else
            entry.runner->set_body(scene.body(entry.kind, proxy.get()), choices.of(entry.kind), proxy);
        return !entry.waits_for_proxy;
    } catch (const std::exception& error) {
        entry.unfit = user_text(error);
        entry.runner->clear();
        return false;
    }
}

/// Returns whether the method's displacements changed.
bool Simulation::update_method(Entry& entry, const LiveScene& scene, const MethodChoices& choices, bool may_begin) {
    EmbeddedRunner& runner = *entry.runner;
    const std::uint64_t before = runner.version();
    const SurfaceMesh* surface = runner.surface();
    if (may_begin) give_body(entry, scene, choices);
    const bool has_body = runner.surface() != nullptr && runner.surface() == simulated_surface(entry.kind, scene);
    if (!has_body || runner.surface() != surface) {
        entry.preview_error.reset();
        entry.replaced_preview = false;
    }
    if (!has_body) {
        if (!may_begin) entry.unfit.clear();  // what is known is of a body before
        entry.is_held_back = false;
        runner.clear();  // its turn has not come yet
        return runner.version() != before;
    }
    entry.is_held_back =
        !may_begin && runner.has_answer() && !runner.runner().is_of(scene.document().material, choices.of(entry.kind));
    // Two sets at a time would slow each other down, and the preview's takes only a moment.
    entry.waits_for_preview = previews_.preparing();
    runner.runner().set_frame_rule(choices.frame_rule);
    runner.runner().set_may_hold_off(entry.kind == previews_.finite_kind() && preview(entry.kind).has_answer());
    // A model that is on its way is to be of these: those before may belong to another body.
    if (!entry.waits_for_preview || runner.runner().precomputing()) runner.set_constraints(scene.constraints());
    runner.poll();
    return runner.version() != before;
}

/// The preview answers as long as it is ready and the method is not. Returns whether the one that answers has changed.
bool Simulation::choose_answer(Entry& entry) const {
    const bool before = entry.previewing;
    const bool ready = entry.runner->runner().answers() && !entry.waits_for_preview && !entry.is_held_back;
    const EmbeddedRunner& coarser = preview(entry.kind);
    if (ready || entry.runner->runner().crushed()) entry.before = nullptr;  // an answer to this scene
    if (ready || entry.runner->runner().crushed())
        entry.previewing = false;
    else if (previews_.follow(entry.kind) && coarser.runner().answers())
        entry.previewing = true;
    else if (entry.previewing ? !coarser.has_answer() : !entry.runner->has_answer())
        entry.previewing = previews_.follow(entry.kind) && coarser.has_answer();
    if (entry.previewing || !ready) {
        if (entry.previewing) entry.preview_error.reset();
        return entry.previewing != before;
    }
    entry.replaced_preview = before || entry.replaced_preview;
    if (entry.replaced_preview && entry.runner->runner().converged() && coarser.runner().answers()) {
        entry.replaced_preview = false;
        const Eigen::VectorXd& exact = entry.runner->displacement();
        const Eigen::VectorXd& coarse = coarser.displacement();
        if (exact.size() == coarse.size() && !exact.isZero(0.0))
            entry.preview_error = (coarse - exact).stableNorm() / exact.stableNorm();
    }
    return entry.previewing != before;
}

void Simulation::show(const std::vector<MethodKind>& shown) {
    if (shown_ == shown) return;
    const MethodKind front = shown_.empty() ? nullptr : shown_.front();
    const MethodKind seen = front && stand_in(front) ? stand_in(front) : front;
    for (const MethodKind kind : shown)
        if (!is_shown(kind)) entries_[place(kind)].before = seen;
    shown_ = shown;
    ++clock_;
    for (const MethodKind kind : shown) entries_[place(kind)].last_shown = clock_;
    bound_hidden_memory();
}

/// It follows the scene like one that is looked at. Returns whether its displacements changed.
bool Simulation::update_stand_in(const Entry& entry, const LiveScene& scene) {
    const MethodKind kind = stand_in(entry.kind);
    if (kind == nullptr || is_shown(kind)) return false;  // one that is shown is brought up to date anyway
    const std::uint64_t before = own(kind).version();
    own(kind).set_constraints(scene.constraints());
    own(kind).poll();
    return own(kind).version() != before;
}

bool Simulation::update(const LiveScene& scene, const std::vector<MethodKind>& shown, const MethodChoices& choices) {
    show(shown);
    ask_for_proxies(scene, choices);
    rest_hidden(scene);
    bool changed = false;
    // Previews are served before all methods: their models are what a press waits for.
    const bool preview_changed = previews_.update_linear(scene, proxies_, choices.frame_rule);
    const MethodKind finite = previews_.finite_kind();
    const bool finite_changed = previews_.update_finite(scene, proxies_, finite ? &runner(finite) : nullptr);
    bool waiting = previews_.any() && (proxies_.running() || previews_.hold_up_methods());
    for (const MethodKind kind : shown) {
        Entry& present = entries_[place(kind)];
        changed = update_method(present, scene, choices, !waiting) || changed;
        changed = choose_answer(present) || changed;
        changed = update_stand_in(present, scene) || changed;
        changed = changed || (present.previewing && (kind->linear ? preview_changed : finite_changed));
        waiting = waiting || present.runner->runner().precomputing();
    }
    for (const MethodKind kind : shown) own(kind).check_at_rest();
    gauge_theory(scene);
    complete_one(choices);
    return changed;
}

/// What a hidden method was computing is taken over when it is done, and given up when it is of another body.
void Simulation::rest_hidden(const LiveScene& scene) {
    for (const Entry& entry : entries_) {
        if (is_shown(entry.kind)) continue;
        const SurfaceMesh* surface = simulated_surface(entry.kind, scene);
        if (surface != nullptr && entry.runner->surface() == surface)
            entry.runner->runner().take_models();
        else
            entry.runner->clear();
    }
}

std::uint64_t Simulation::memory_of(const Entry& entry) const {
    const MethodRunner& runner = entry.runner->runner();
    return runner.model() ? runner.model()->facts().memory_bytes + runner.set_memory() : 0;
}

/// Models of methods that nobody looks at are kept for when they are looked at again, while there is room.
void Simulation::bound_hidden_memory() {
    std::vector<Entry*> hidden;
    std::uint64_t sum = 0;
    for (Entry& entry : entries_)
        if (const std::uint64_t bytes = memory_of(entry); !is_shown(entry.kind) && bytes > 0) {
            hidden.push_back(&entry);
            sum += bytes;
        }
    const std::uint64_t most = hidden_memory_.value_or((available_memory_bytes() + sum) / kPartForHidden);
    std::sort(hidden.begin(), hidden.end(),
              [](const Entry* a, const Entry* b) { return a->last_shown < b->last_shown; });
    for (Entry* entry : hidden) {
        if (sum <= most) return;
        sum -= memory_of(*entry);
        entry->runner->clear();
        dropped_.push_back(entry->kind);
    }
}

/// On a scene's own mesh where that is coarse enough, else on a proxy, which is asked for once a motion rests.
void Simulation::gauge_theory(const LiveScene& scene) {
    const MethodKind kind = shown_.front();
    const Constraints& asked = own(kind).shown_constraints();
    const bool moves = !asked.values.isZero(0.0) || std::any_of(asked.motions.begin(), asked.motions.end(),
                                                                [](const Motion& m) { return !(m == Motion{}); });
    if (!kind->linear || !moves) return gauge_.rest();
    if (Wish wish = wish_of(asked); !same(wish, gauged_)) {
        gauge_.rest();
        gauged_ = std::move(wish);
    }
    if (runner(kind).state() != State::ready || !runner(kind).converged() || !runner(kind).answers()) return;
    gauged_on_ = scene.surface();
    Body body{.name = scene.name(), .surface = scene.surface(), .material = scene.document().material};
    if (is_gauged_itself(scene))
        return gauge_.update(body, asked.set, wish_of(asked), {asked.grips(), asked.grip_forces()});
    const std::shared_ptr<const Proxy>& proxy = proxies_.preview();
    if (!proxy || proxy->shown != scene.surface()) return;
    if (!gauge_carried_ || &gauge_carried_->proxy() != proxy.get()) gauge_carried_.emplace(proxy);
    gauge_carried_->set(asked);
    body.surface = proxy->surface;
    const Constraints& carried = gauge_carried_->constraints();
    gauge_.update(body, carried.set, wish_of(carried), {carried.grips(), carried.grip_forces()});
}

/// Only when every shown method is ready, and one at a time: what is looked at comes first.
void Simulation::complete_one(const MethodChoices& choices) {
    if (choices.mode != Mode::on_demand) return;
    const bool precomputing =
        std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) { return runner(kind).precomputing(); });
    for (const Entry& entry : entries_)
        if (precomputing || !is_shown(entry.kind)) entry.runner->runner().postpone_completion();
    if (busy()) return;
    for (const MethodKind kind : shown_) {
        if (!runner(kind).may_complete(choices.update)) continue;  // far cheaper to ask than what it would cost
        if (!completion_of(*embedded(kind).surface(), kind, choices)) continue;
        runner(kind).complete(choices.update);
        if (runner(kind).completing()) return;
    }
}

void Simulation::prefetch(const Constraints& constraints) {
    previews_.prefetch(constraints);
    for (const MethodKind kind : shown_) own(kind).prefetch(constraints);
}

void Simulation::retry(MethodKind kind) {
    proxies_.retry();
    previews_.retry();
    own(kind).retry();
}

bool Simulation::waiting() const {
    if (proxies_.running()) return true;
    return std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) {
        const State state = runner(kind).state();
        return state == State::precomputing || state == State::preparing || making_proxy(kind) ||
               embedded(kind).placing_grips();
    });
}

bool Simulation::busy() const {
    return waiting() || previews_.preparing() || std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) {
               return runner(kind).converging() || runner(kind).completing();
           });
}

bool Simulation::checking() const {
    return gauge_.working_on_it() ||
           std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) { return runner(kind).unchecked(); });
}

void Simulation::cancel() {
    proxies_.cancel();
    previews_.cancel();
    gauge_.cancel();
    for (Entry& entry : entries_) entry.runner->cancel();
}

bool Simulation::stopping() const {
    return proxies_.working() || previews_.stopping() || gauge_.working() ||
           std::any_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.runner->stopping(); });
}

}  // namespace elastolab
