#include "scene/live/proxy_keeper.hpp"

#include <span>
#include <utility>

#include "base/error.hpp"

namespace elastolab {

namespace {

bool is_filling(const std::optional<ProxyChoice>& choice) { return choice && choice->use == ProxyUse::fill; }

}  // namespace

void ProxyKeeper::ask(const LiveScene& scene, bool needs_model, int n_preview_vertices) {
    const bool same_surface = surface_ == scene.surface() && taken_for_ == scene.document().proxy.taken_for;
    const auto choice = needs_model ? std::optional(scene.document().proxy) : std::nullopt;
    if (same_surface && choice_ == choice && n_preview_ == n_preview_vertices) return;
    const bool same_solid = same_surface && is_filling(choice_) == is_filling(choice);
    if (!same_surface || choice_ != choice) model_.reset();
    if (!same_solid || n_preview_ != n_preview_vertices) preview_.reset();
    surface_ = scene.surface();
    taken_for_ = scene.document().proxy.taken_for;
    report_ = scene.report();
    name_ = scene.name();
    choice_ = choice;
    n_preview_ = n_preview_vertices;
    begin();
}

void ProxyKeeper::begin() {
    failure_.clear();
    const bool needs_model = choice_ && !model_, needs_preview = n_preview_ > 0 && !preview_;
    if (!needs_model && !needs_preview) {
        job_.cancel();
        return;
    }
    if (is_filling(choice_))
        begin_filling(needs_preview);
    else
        begin_proxies(needs_model, needs_preview);
}

void ProxyKeeper::begin_proxies(bool needs_model, bool needs_preview) {
    std::vector<int> sizes;  // made together: their first steps are the same
    if (needs_model) sizes.push_back(choice_->n_vertices);
    if (needs_preview) sizes.push_back(n_preview_);
    job_.start([surface = surface_, report = report_, name = name_, taken_for = taken_for_, sizes, needs_model,
                needs_preview](Control& control) {
        Made made;
        const auto proxies = make_proxies(name, surface, report, sizes, control, taken_for);
        if (needs_model) made.model = proxies.front();
        if (needs_preview) made.preview = proxies.back();
        return made;
    });
}

/// The preview is made of the filled surface, which is solid where the open one may be a shell.
void ProxyKeeper::begin_filling(bool needs_preview) {
    job_.start([surface = surface_, report = report_, name = name_, choice = *choice_, n_preview = n_preview_,
                filled = model_, needs_preview](Control& control) {
        Made made;
        std::shared_ptr<const Proxy> solid = filled;
        try {
            if (!solid) solid = made.model = make_proxy(name, surface, report, choice, control);
        } catch (const MeshError& error) {
            made.failure = error.what();  // the preview is made of the open surface then
        }
        if (!needs_preview) return made;
        try {
            made.preview =
                solid
                    ? make_coarser_proxy(name, *solid, n_preview, control)
                    : make_proxies(name, surface, report, std::span(&n_preview, 1), control, choice.taken_for).front();
        } catch (const MeshError&) {  // there is no preview then
        }
        return made;
    });
}

bool ProxyKeeper::poll() {
    switch (job_.poll()) {
        case JobEvent::finished: {
            Made made = job_.take();
            if (made.model) model_ = std::move(made.model);
            if (made.preview) preview_ = std::move(made.preview);
            failure_ = std::move(made.failure);
            return true;
        }
        case JobEvent::failed:
            failure_ = job_.failure();
            return true;
        case JobEvent::cancelled:
        case JobEvent::none:
            break;
    }
    return false;
}

void ProxyKeeper::cancel() {
    if (!job_.running()) return;
    job_.cancel();
    failure_ = "Making the proxy was stopped. Compute, or open another file.";
}

void ProxyKeeper::retry() {
    if (!failure_.empty()) begin();
}

}  // namespace elastolab
