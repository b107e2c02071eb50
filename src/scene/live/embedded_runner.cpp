#include "scene/live/embedded_runner.hpp"

#include "base/error.hpp"
#include "scene/user_text.hpp"

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

void EmbeddedRunner::give(const Constraints& constraints) {
    if (carried_)
        carried_->set(constraints);
    else
        shown_ = constraints;
}

void EmbeddedRunner::set_constraints(const Constraints& constraints) {
    give(constraints);
    grip_failure_.clear();
    if (constraints.has_forces()) {
        asked_ = constraints;
        move_grips(constraints);
    } else {
        asked_.reset();
        grip_motions_.clear();
    }
    runner_.set_constraints(this->constraints());
}

/// A set that is there now says where its handles under a force stand.
void EmbeddedRunner::poll() {
    const std::shared_ptr<const Deformer> before = runner_.deformer();
    runner_.poll();
    if (!asked_ || runner_.deformer() == before) return;
    set_constraints(Constraints(*asked_));
    runner_.poll();
}

/// Whether the stiffness of the present grips is at hand; makes it where that takes a moment only. Mostly the worker
/// that prepared the set has made it.
bool EmbeddedRunner::holds_grips() {
    const std::shared_ptr<const Deformer>& deformer = runner_.deformer();
    if (!deformer || !deformer->linear()) return false;
    const ConstrainedSet& set = constraints().set;
    if (deformer->set().base != set.base || deformer->set().handles != set.handles ||
        deformer->set().loads != set.loads)
        return false;
    std::shared_ptr<GripStiffness>& stiffness = runner_.grips();
    if (stiffness && stiffness->grips() == constraints().grips()) return true;
    if (deformer->iterates()) return false;
    Control control;
    stiffness = std::make_shared<GripStiffness>(*deformer, constraints().values, constraints().grips(), control);
    return true;
}

/// Puts handles under a force where that holds them: a 6 x 6 system for one handle, and a solve where anything else has
/// changed. Until that is known they stay where the scene has them.
void EmbeddedRunner::move_grips(const Constraints& constraints) {
    try {
        if (!holds_grips()) return;
        GripStiffness& stiffness = *runner_.grips();
        Constraints own = this->constraints();
        Eigen::VectorXd others = own.values;
        for (const Grip& grip : stiffness.grips())
            others.segment(3 * grip.begin, 3 * (grip.end - grip.begin)).setZero();
        if (grip_stiffness_.lock() != runner_.grips() || grip_values_.size() != others.size() ||
            grip_values_ != others) {
            Control control;
            stiffness.set_others(*runner_.deformer(), others, control);
            grip_stiffness_ = runner_.grips();
            grip_values_ = std::move(others);
        }
        grip_motions_ = own.move_grips(stiffness, surface()->vertices);
    } catch (const SolveError& error) {  // nothing holds them: they stay
        grip_failure_ = user_text(error);
        return;
    }
    Constraints moved = constraints;
    const std::vector<std::size_t> handles = moved.gripped();
    const Positions& shown = carried_ ? carried_->proxy().shown->vertices : surface()->vertices;
    for (std::size_t g = 0; g < handles.size() && g < grip_motions_.size(); ++g)
        moved.move(handles[g], grip_motions_[g], shown);
    give(moved);
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
