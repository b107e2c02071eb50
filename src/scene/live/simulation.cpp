#include "scene/live/simulation.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "findings/cost.hpp"
#include "methods/registry.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

namespace {

using State = MethodRunner::State;

/// Longest predicted time of a completion, which nobody waits for.
constexpr double kMaxCompletionSeconds = 120.0;

/// A body with no more vertices than this is ready before a person has looked at it.
constexpr int kFewestToPreview = 300;
/// Vertices of a preview's surface, which a worker has ready within a second.
constexpr int kPreviewVertices = 700;
/// A sound surface with no more vertices than this needs no coarser one.
constexpr int kMostToPreviewThemselves = 900;
/// The preview's elements cannot take 1/2 itself.
constexpr double kPreviewPoissonRatio = 0.49;

}  // namespace

std::optional<Method> completion_of(const SurfaceMesh& mesh, MethodKind kind, const MethodChoices& choices) {
    const bool can_be = kind->full_serves_sets && has(kind, Mode::full) && has(kind, choices.update);
    if (choices.mode != Mode::on_demand || !can_be || mesh.n_vertices() > choices.complete_up_to) return std::nullopt;
    Method full = choices.of(kind);
    full.mode = Mode::full;
    if (predict_cost(mesh, full).seconds > kMaxCompletionSeconds) return std::nullopt;
    return full;
}

Method MethodChoices::of(MethodKind kind) const {
    Method method{.kind = kind, .mode = mode, .tractions = tractions, .update = update};
    if (!has(kind, mode)) method.mode = has(kind, Mode::full) ? Mode::full : Mode::on_demand;
    if (!has(kind, update)) method.update = Update::reduced;
    if (kind->chooses_elements) method.elements = elements;
    if (!kind->chooses_tractions) method.tractions = Tractions::discontinuous;
    if (method.mode == Mode::on_demand && method.update == Update::eqn9) method.update = Update::reduced;
    return method;
}

Simulation::Simulation(const std::function<void()>& wake) : proxies_(wake), preview_(wake) {
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

const EmbeddedRunner& Simulation::answer(MethodKind kind) const {
    const Entry& entry = entries_[place(kind)];
    return entry.previewing ? preview_ : *entry.runner;
}

std::string Simulation::problem(MethodKind kind) const {
    const Entry& found = entries_[place(kind)];
    return found.unfit.empty() ? found.runner->runner().failure() : found.unfit;
}

const SurfaceMesh* Simulation::simulated_surface(MethodKind kind, const LiveScene& scene) const {
    if (!scene.needs_proxy(kind)) return &scene.mesh();
    return proxies_.model() && proxies_.model()->shown == scene.surface() ? proxies_.model()->surface.get() : nullptr;
}

void Simulation::ask_for_proxies(const LiveScene& scene, const MethodChoices& choices) {
    const auto needs_proxy = [&](MethodKind kind) { return scene.needs_proxy(kind); };
    const bool needs_model = std::any_of(shown_.begin(), shown_.end(), needs_proxy) || proxies_.model();
    has_preview_ = choices.preview && scene.mesh().n_vertices() > kFewestToPreview;
    const bool is_own_preview =
        !scene.needs_proxy(preview_method()) && scene.mesh().n_vertices() <= kMostToPreviewThemselves;
    proxies_.ask(scene, needs_model, has_preview_ && !is_own_preview ? kPreviewVertices : 0);
    proxies_.poll();
}

bool Simulation::preparing_preview() const {
    const State state = preview_.runner().state();
    return has_preview_ && (state == State::precomputing || state == State::preparing);
}

/// The preview is served before all methods: its model is what a press waits for.
bool Simulation::update_preview(const LiveScene& scene, const MethodChoices& choices) {
    const std::uint64_t before = preview_.version();
    const std::shared_ptr<const Proxy>& proxy = proxies_.preview();
    if (!has_preview_ || proxies_.running()) {
        if (!proxy || proxy->shown != scene.surface()) preview_.clear();
        if (!has_preview_) return false;
    }
    const bool on_itself =
        !scene.needs_proxy(preview_method()) && scene.mesh().n_vertices() <= kMostToPreviewThemselves;
    if (!on_itself && !proxy) {
        preview_.clear();
        return preview_.version() != before;
    }
    Body body{.name = scene.name(),
              .surface = on_itself ? scene.surface() : proxy->surface,
              .material = scene.document().material};
    body.material.poisson_ratio = std::min(body.material.poisson_ratio, kPreviewPoissonRatio);
    preview_.set_body(body, Method{.kind = preview_method()}, on_itself ? nullptr : proxy);
    preview_.runner().set_frame_rule(choices.frame_rule);
    preview_.set_constraints(scene.constraints());
    preview_.poll();
    return preview_.version() != before;
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
    if (may_begin) give_body(entry, scene, choices);
    if (runner.surface() == nullptr || runner.surface() != simulated_surface(entry.kind, scene)) {
        runner.clear();  // its turn has not come yet
        return runner.version() != before;
    }
    // Two at a time would slow each other down, and the preview's set takes only a moment.
    entry.waits_for_preview = preparing_preview();
    runner.runner().set_frame_rule(choices.frame_rule);
    if (!entry.waits_for_preview) runner.set_constraints(scene.constraints());
    runner.poll();
    return runner.version() != before;
}

/// The preview answers as long as it is ready and the method is not. Returns whether the one that answers has changed.
bool Simulation::choose_answer(Entry& entry) const {
    const bool before = entry.previewing;
    const bool ready = entry.runner->runner().answers() && !entry.waits_for_preview;
    if (ready)
        entry.previewing = false;
    else if (has_preview_ && preview_.runner().answers())
        entry.previewing = true;
    else if (entry.previewing ? !preview_.has_answer() : !entry.runner->has_answer())
        entry.previewing = has_preview_ && preview_.has_answer();
    if (entry.previewing || !ready) {
        if (entry.previewing) entry.preview_error.reset();
        return entry.previewing != before;
    }
    entry.replaced_preview = before || entry.replaced_preview;
    if (entry.replaced_preview && entry.runner->runner().refined() && preview_.runner().answers()) {
        entry.replaced_preview = false;
        const Eigen::VectorXd& exact = entry.runner->displacement();
        const Eigen::VectorXd& coarse = preview_.displacement();
        if (exact.size() == coarse.size() && !exact.isZero(0.0))
            entry.preview_error = (coarse - exact).stableNorm() / exact.stableNorm();
    }
    return entry.previewing != before;
}

bool Simulation::update(const LiveScene& scene, const std::vector<MethodKind>& shown, const MethodChoices& choices) {
    shown_ = shown;
    ask_for_proxies(scene, choices);
    rest_hidden(scene);
    bool changed = false;
    const bool preview_changed = update_preview(scene, choices);
    bool waiting = has_preview_ && (proxies_.running() || preparing_preview());
    for (const MethodKind kind : shown) {
        Entry& present = entries_[place(kind)];
        changed = update_method(present, scene, choices, !waiting) || changed;
        changed = choose_answer(present) || changed;
        changed = changed || (present.previewing && preview_changed);
        waiting = waiting || present.runner->runner().precomputing();
    }
    for (const MethodKind kind : shown) runner(kind).check_at_rest();
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
    if (has_preview_) preview_.prefetch(constraints);
    for (const MethodKind kind : shown_) own(kind).prefetch(constraints);
}

void Simulation::retry(MethodKind kind) {
    proxies_.retry();
    preview_.runner().retry();
    runner(kind).retry();
}

bool Simulation::waiting() const {
    if (proxies_.running()) return true;
    return std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) {
        const State state = runner(kind).state();
        return state == State::precomputing || state == State::preparing || making_proxy(kind);
    });
}

bool Simulation::busy() const {
    return waiting() || preparing_preview() || std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) {
               return runner(kind).refining() || runner(kind).completing();
           });
}

bool Simulation::checking() const {
    return std::any_of(shown_.begin(), shown_.end(), [&](MethodKind kind) { return runner(kind).unchecked(); });
}

void Simulation::cancel() {
    proxies_.cancel();
    preview_.runner().cancel();
    for (Entry& entry : entries_) entry.runner->runner().cancel();
}

bool Simulation::stopping() const {
    return proxies_.working() || preview_.runner().stopping() ||
           std::any_of(entries_.begin(), entries_.end(),
                       [](const Entry& entry) { return entry.runner->runner().stopping(); });
}

}  // namespace elastolab
