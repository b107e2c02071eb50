#include "scene/live/previews.hpp"

#include <algorithm>

namespace elastolab {

namespace {

/// A body with no more vertices than this is ready before a person has looked at it.
constexpr int kFewestToPreview = 300;
/// A sound surface with no more vertices than this needs no coarser one: with quick_method() it answers sooner than a
/// proxy of it (docs/results.md).
constexpr int kMostToPreviewThemselves = 2000;
/// The same for preview_method(), which takes longer, and bends rubber as well as steel.
constexpr int kMostToPreviewRubber = 900;
/// From this Poisson's ratio on quick_method() is too stiff to show what will come.
constexpr double kRubber = 0.45;
/// Poisson's ratio in place of 1/2 for finite elements, which cannot take that.
constexpr double kNearlyIncompressible = 0.49;
/// Method::growth: linear FEM of the surface itself takes 0.3 to 0.6 of the time and is up to half as much further off,
/// quadratic FEM on a proxy takes 0.5 to 0.9 of the time and is as accurate (docs/results.md).
constexpr double kGrowth = 0.6;
/// Equilibria of a surface with no more vertices than this follow a drag.
constexpr int kMostQuickAtEquilibria = 900;

/// Whether equilibria of the scene's own surface follow a drag.
bool is_quick_at_equilibria(const LiveScene& scene) {
    return !scene.needs_proxy(large_deformation_method()) && scene.mesh().n_vertices() <= kMostQuickAtEquilibria;
}

/// The method that the preview simulates the scene's own surface by; null where it is made on a proxy.
MethodKind preview_on_itself(const LiveScene& scene) {
    const bool is_rubber = scene.document().material.poisson_ratio > kRubber;
    const int most = is_rubber ? kMostToPreviewRubber : kMostToPreviewThemselves;
    if (scene.mesh().n_vertices() > most) return nullptr;
    const MethodKind kind = is_rubber ? preview_method() : quick_method();
    return scene.needs_proxy(kind) ? nullptr : kind;
}

/// Gives a preview the body that it simulates: the scene's own surface by `on_itself`, or, where that is null, the
/// proxy by `on_proxy` (null: preview_method()); false when it has none.
bool give_body(EmbeddedRunner& preview, MethodKind on_itself, MethodKind on_proxy, bool wanted, const LiveScene& scene,
               const ProxyKeeper& proxies) {
    const std::shared_ptr<const Proxy>& proxy = proxies.preview();
    if (!wanted || (proxies.running() && !on_itself)) {
        if (!proxy || proxy->shown != scene.surface()) preview.clear();
        if (!wanted) return false;
    }
    if (!on_itself && !proxy) {
        preview.clear();
        return false;
    }
    const MethodKind kind = on_itself ? on_itself : on_proxy ? on_proxy : preview_method();
    Body body{.name = scene.name(),
              .surface = on_itself ? scene.surface() : proxy->surface,
              .material = scene.document().material};
    if (!kind->takes_incompressible)
        body.material.poisson_ratio = std::min(body.material.poisson_ratio, kNearlyIncompressible);
    preview.set_body(body, {.kind = kind, .growth = kGrowth}, on_itself ? nullptr : proxy);
    return true;
}

bool prepares_first_set(const MethodRunner& runner) {
    return runner.state() == MethodRunner::State::preparing && !runner.has_set();
}

}  // namespace

bool is_worth_a_preview(const LiveScene& scene) { return scene.mesh().n_vertices() > kFewestToPreview; }

void Previews::choose(const LiveScene& scene, const std::vector<MethodKind>& shown, bool first_answers, bool wanted) {
    wanted = wanted && is_worth_a_preview(scene);
    on_itself_ = preview_on_itself(scene);
    // One that is there, for a method that was looked at before, stays until then.
    const bool is_there = linear_.has_answer() && linear_.surface() == scene.surface().get();
    const bool comes_first_anyway = !shown.empty() && shown.front() == on_itself_ && (first_answers || !is_there);
    has_linear_ = wanted && !comes_first_anyway &&
                  std::any_of(shown.begin(), shown.end(), [](MethodKind kind) { return kind->linear; });
    const auto finite = std::find_if(shown.begin(), shown.end(), [](MethodKind kind) { return !kind->linear; });
    finite_kind_ = wanted && finite != shown.end() && !is_quick_at_equilibria(scene) ? *finite : nullptr;
}

bool Previews::update_linear(const LiveScene& scene, const ProxyKeeper& proxies, FrameRule rule) {
    const std::uint64_t before = linear_.version();
    if (!give_body(linear_, on_itself_, nullptr, has_linear_, scene, proxies)) return linear_.version() != before;
    linear_.runner().set_frame_rule(rule);
    linear_.set_constraints(scene.constraints());
    linear_.poll();
    return linear_.version() != before;
}

bool Previews::update_finite(const LiveScene& scene, const ProxyKeeper& proxies, const MethodRunner* method) {
    const std::uint64_t before = finite_.version();
    if (!give_body(finite_, nullptr, finite_kind_, finite_kind_ != nullptr, scene, proxies))
        return finite_.version() != before;
    finite_follows_ = !method->has_set() || method->is_slow();
    if (finite_follows_) finite_.set_constraints(scene.constraints());
    finite_.poll();
    return finite_.version() != before;
}

bool Previews::preparing() const { return hold_up_methods() || (has_linear_ && prepares_first_set(linear_.runner())); }

bool Previews::hold_up_methods() const {
    const auto precomputes = [](const MethodRunner& runner) {
        return runner.state() == MethodRunner::State::precomputing;
    };
    if (has_linear_ && precomputes(linear_.runner())) return true;
    return finite_kind_ && (precomputes(finite_.runner()) || prepares_first_set(finite_.runner()));
}

void Previews::prefetch(const Constraints& constraints) {
    if (has_linear_) linear_.prefetch(constraints);
    if (finite_kind_) finite_.prefetch(constraints);
}

void Previews::retry() {
    linear_.retry();
    finite_.retry();
}

void Previews::cancel() {
    linear_.cancel();
    finite_.cancel();
}

}  // namespace elastolab
