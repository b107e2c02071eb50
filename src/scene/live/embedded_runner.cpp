#include "scene/live/embedded_runner.hpp"

#include <utility>

namespace elastolab {

namespace {

/// Those of each handle under a force.
std::vector<std::vector<int>> gripped_vertices(const Constraints& constraints) {
    std::vector<std::vector<int>> all;
    for (const std::size_t h : constraints.gripped()) {
        const auto [first, last] = constraints.range_of(h);
        all.emplace_back(constraints.set.handles.begin() + first, constraints.set.handles.begin() + last);
    }
    return all;
}

}  // namespace

void EmbeddedRunner::set_body(const Body& body, const Method& method, const std::shared_ptr<const Proxy>& proxy) {
    if (proxy.get() != this->proxy()) {
        carried_.reset();
        prefetched_.reset();
        if (proxy) prefetched_.emplace(carried_.emplace(proxy));
        displacement_version_.reset();
    }
    if (body.surface.get() != surface()) forget_grips();
    name_ = body.name;
    runner_.set_body(body, method);
}

void EmbeddedRunner::forget_grips() {
    placed_.clear();
    grip_motions_.clear();
    placer_.clear();
}

void EmbeddedRunner::clear() {
    runner_.clear();
    asked_.reset();
    forget_grips();
    carried_.reset();
    prefetched_.reset();
    displacement_version_.reset();
}

void EmbeddedRunner::give(const Constraints& constraints) {
    shown_ = constraints;
    if (carried_) carried_->set(constraints);
}

void EmbeddedRunner::set_constraints(const Constraints& constraints) {
    give(constraints);
    if (constraints.has_forces()) {
        asked_ = constraints;
        if (placed_ != gripped_vertices(constraints)) grip_motions_.clear();  // those are of other handles
        place_grips();
    } else if (asked_) {
        asked_.reset();
        forget_grips();
    }
    runner_.set_grip_places(grip_places(), placer_.equilibrium());
    runner_.set_constraints(this->constraints());
}

/// A set that is there now says where its handles under a force stand.
void EmbeddedRunner::poll() {
    const std::shared_ptr<const Deformer> before = runner_.deformer();
    runner_.poll();
    const bool placed = placer_.poll();
    if (!asked_) return;
    if (!placed && runner_.deformer() == before) return;
    set_constraints(Constraints(*asked_));
    runner_.poll();
}

/// Whether what answers is of the present constrained set.
bool EmbeddedRunner::may_place_grips() const {
    const std::shared_ptr<const Deformer>& deformer = runner_.deformer();
    return deformer && deformer->set() == constraints().set;
}

GripPlaces EmbeddedRunner::grip_places() const {
    const bool are_followed = asked_ && runner_.surface() && !runner_.method().kind->linear && !gripped().empty();
    if (!are_followed || !grip_failure().empty() || placer_.equilibrium()) return GripPlaces::in_equilibrium;
    return grip_motions_.empty() ? GripPlaces::unknown : GripPlaces::nearby;
}

/// Until it is known where their forces hold handles, they stay where they stood last, or else where the scene has
/// them.
void EmbeddedRunner::place_grips() {
    std::optional<std::vector<AffineMotion>> motions;
    if (may_place_grips())
        motions = placer_.place(runner_.deformer(), constraints(), runner_.grips());
    else
        placer_.wait();
    if (motions) grip_motions_ = std::move(*motions);
    if (grip_motions_.empty() || !grip_failure().empty()) return;
    Constraints moved = *asked_;
    placed_ = gripped_vertices(moved);
    const std::vector<std::size_t> handles = gripped();
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

void EmbeddedRunner::begin_from_rest() {
    placer_.begin_from_rest();
    runner_.begin_from_rest();
    if (asked_) set_constraints(Constraints(*asked_));
}

/// Handles that nothing holds are where the scene has them, as if they were moved.
void EmbeddedRunner::check_at_rest() {
    if (placing_grips()) return;
    runner_.check_at_rest([this] { return asked_ ? placer_.in_place() : GripsInPlace{}; });
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
