#include "scene/live/embedded_runner.hpp"

namespace elastolab {

void EmbeddedRunner::set_body(const Body& body, const Method& method, const std::shared_ptr<const Proxy>& proxy) {
    if (proxy.get() != this->proxy()) {
        carried_.reset();
        prefetched_.reset();
        if (proxy) prefetched_.emplace(carried_.emplace(proxy));
        displacement_version_.reset();
    }
    name_ = body.name;
    runner_.set_body(body, method);
}

void EmbeddedRunner::clear() {
    runner_.clear();
    carried_.reset();
    prefetched_.reset();
    displacement_version_.reset();
}

void EmbeddedRunner::set_constraints(const Constraints& constraints) {
    if (carried_)
        carried_->set(constraints);
    else
        shown_ = constraints;
    runner_.set_constraints(this->constraints());
}

void EmbeddedRunner::prefetch(const Constraints& constraints) {
    if (surface() == nullptr) return;  // it is not known yet which surface is computed on
    if (!carried_) return runner_.prefetch(constraints.set);
    prefetched_->set(constraints);
    runner_.prefetch(prefetched_->constraints().set);
}

const Eigen::VectorXd& EmbeddedRunner::displacement() const {
    const Eigen::VectorXd& own = runner_.displacement();
    if (!carried_ || own.size() == 0) return own;
    if (displacement_version_ != runner_.version()) {
        displacement_ = runner_.shows_wanted() ? carried_->displacement(own) : carried_->places(own);
        displacement_version_ = runner_.version();
    }
    return displacement_;
}

Findings EmbeddedRunner::findings() const {
    Findings all = carried_ ? findings_of_proxy(carried_->proxy(), name_) : Findings{};
    const Findings own = carried_ ? carried_->as_shown(runner_.findings()) : runner_.findings();
    all.insert(all.end(), own.begin(), own.end());
    return all;
}

Eigen::VectorXd EmbeddedRunner::shown_values(const Eigen::VectorXd& of_surface) const {
    return carried_ ? carried_values(carried_->proxy(), of_surface) : of_surface;
}

}  // namespace elastolab
