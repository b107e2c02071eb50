#include "scene/live/proxy_keeper.hpp"

#include <utility>

namespace elastolab {

void ProxyKeeper::ask(const LiveScene& scene, int n_model_vertices, int n_preview_vertices) {
    const bool same_surface = surface_ == scene.surface();
    if (same_surface && n_model_ == n_model_vertices && n_preview_ == n_preview_vertices) return;
    if (!same_surface || n_model_ != n_model_vertices) model_.reset();
    if (!same_surface || n_preview_ != n_preview_vertices) preview_.reset();
    surface_ = scene.surface();
    report_ = scene.report();
    name_ = scene.name();
    n_model_ = n_model_vertices;
    n_preview_ = n_preview_vertices;
    begin();
}

void ProxyKeeper::begin() {
    failure_.clear();
    const bool needs_model = n_model_ > 0 && !model_, needs_preview = n_preview_ > 0 && !preview_;
    if (!needs_model && !needs_preview) {
        job_.cancel();
        return;
    }
    std::vector<int> sizes;
    if (needs_model) sizes.push_back(n_model_);
    if (needs_preview) sizes.push_back(n_preview_);
    job_.start([surface = surface_, report = report_, name = name_, sizes, needs_model](Control& control) {
        const auto proxies = make_proxies(name, surface, report, sizes, control);
        Made made;
        if (needs_model) made.model = proxies.front();
        if (proxies.size() > 1 || !needs_model) made.preview = proxies.back();
        return made;
    });
}

bool ProxyKeeper::poll() {
    switch (job_.poll()) {
        case JobEvent::finished: {
            Made made = job_.take();
            if (made.model) model_ = std::move(made.model);
            if (made.preview) preview_ = std::move(made.preview);
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
