#include "scene/live/proxy_keeper.hpp"

#include <utility>

#include "base/error.hpp"

namespace elastolab {

void ProxyKeeper::ask(const LiveScene& scene, bool needs_model, int n_preview_vertices) {
    const bool same_surface = surface_ == scene.surface();
    const auto choice = needs_model ? std::optional(scene.document().proxy) : std::nullopt;
    if (same_surface && choice_ == choice && n_preview_ == n_preview_vertices) return;
    if (!same_surface || choice_ != choice) model_.reset();
    if (!same_surface || n_preview_ != n_preview_vertices) preview_.reset();
    surface_ = scene.surface();
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
    const bool fills = needs_model && choice_->use == ProxyUse::fill;
    std::vector<int> sizes;  // made at once: their first steps are the same
    if (needs_model && !fills) sizes.push_back(choice_->n_vertices);
    if (needs_preview) sizes.push_back(n_preview_);
    job_.start([surface = surface_, report = report_, name = name_, choice = choice_, sizes, fills,
                needs_preview](Control& control) {
        Made made;
        try {
            if (!sizes.empty()) {
                const auto proxies = make_proxies(name, surface, report, sizes, control);
                if (needs_preview) made.preview = proxies.back();
                if (proxies.size() > 1 || !needs_preview) made.model = proxies.front();
            }
        } catch (const MeshError&) {
            if (!fills) throw;  // a filled surface does without a preview
        }
        try {
            if (fills) made.model = make_proxy(name, surface, report, *choice, control);
        } catch (const MeshError& error) {
            made.failure = error.what();  // and the preview answers without it
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
