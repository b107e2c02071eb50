#include "app/picture/shown_scene.hpp"

#include <algorithm>

#include "base/timer.hpp"

namespace elastolab {

namespace {

template <class Bodies>
auto find_body(Bodies& bodies, MethodKind kind) {
    return std::find_if(bodies.begin(), bodies.end(), [&](const ShownBody& body) { return body.kind() == kind; });
}

bool needs_reactions(const ShownAnswers& answers) {
    const Field field = answers.display.field;
    return answers.display.arrows || answers.probed || answers.forces_wanted || field == Field::traction ||
           stress_of(field).has_value();
}

}  // namespace

const ShownBody* ShownScene::body(MethodKind kind) const {
    const auto found = find_body(bodies_, kind);
    return found == bodies_.end() ? nullptr : &*found;
}

ShownBody& ShownScene::body_of(MethodKind kind) {
    const auto found = find_body(bodies_, kind);
    return found == bodies_.end() ? bodies_.emplace_back(kind) : *found;
}

const std::string& ShownScene::reaction_failure(MethodKind kind) const {
    static const std::string none;
    const auto found = reactions_.find(kind);
    return found == reactions_.end() ? none : found->second->failure();
}

std::pair<double, double> ShownScene::field_range(const DisplaySettings& display) const {
    if (const auto typed = display.typed_ranges.find(display.field); typed != display.typed_ranges.end())
        return std::minmax({typed->second.first, typed->second.second});
    double high = held_range_ ? *held_range_ : largest_magnitude(display);
    if (high == 0.0) high = 1.0;
    return {is_signed(display.field) ? -high : 0.0, high};
}

double ShownScene::largest_magnitude(const DisplaySettings& display) const {
    double largest = 0.0;
    for (const ShownBody& shown : bodies_) largest = std::max(largest, shown.largest_magnitude(display.range_part));
    return largest;
}

ColourScale ShownScene::field_scale(const DisplaySettings& display) const {
    const auto [low, high] = field_range(display);
    return colour_scale(low, high, display.logarithmic && !is_signed(display.field));
}

void ShownScene::forget() {
    bodies_.clear();
    load_arrows_.clear();
    filling_.reset();
    section_.reset();
    for (const auto& [kind, runner] : insides_) runner->rest();
    for (const auto& [kind, runner] : reactions_) runner->rest();
}

/// The reactions of a method, when something is shown that needs them.
const ReactionRunner* ShownScene::reactions(const ShownAnswers& answers, MethodKind kind) {
    std::unique_ptr<ReactionRunner>& runner = reactions_[kind];
    if (!runner) runner = std::make_unique<ReactionRunner>(wake_);
    if (!wants_reactions_) {
        runner->rest();
        return nullptr;
    }
    runner->update(answers.simulation.answer(kind).runner());
    return runner.get();
}

/// What fills the holes of the body. Methods that simulate it so share one filled surface.
void ShownScene::update_filling(const ShownAnswers& answers) {
    const Proxy* filled = nullptr;
    for (const MethodKind kind : answers.kinds)
        if (const Proxy* proxy = answers.simulation.embedded(kind).proxy(); proxy != nullptr && proxy->is_filled())
            filled = proxy;
    if (filled == nullptr || filled->shown != answers.scene.shared_mesh()) return filling_.reset();
    if (!filling_ || filling_->surface() != filled->surface) filling_ = std::make_shared<const FillingShape>(*filled);
}

/// The body cut open at rest, with its holes filled where it is simulated so; made anew only for another plane or body.
std::shared_ptr<const SectionShape> ShownScene::section(const ShownAnswers& answers) {
    if (!answers.display.section) return nullptr;
    const std::shared_ptr<const SurfaceMesh>& shown = answers.scene.shared_mesh();
    const std::shared_ptr<const SurfaceMesh>& surface = filling_ ? filling_->closed() : shown;
    const Plane plane = section_plane(shown->vertices, answers.display);
    const int n_filling = surface->n_triangles() - shown->n_triangles();
    if (!section_ || section_->surface() != surface || section_->plane() != plane)
        section_ = std::make_shared<const SectionShape>(surface, plane, n_filling);
    return section_;
}

const SectionRunner* ShownScene::inside(const ShownAnswers& answers, MethodKind kind) {
    std::unique_ptr<SectionRunner>& runner = insides_[kind];
    if (!runner) runner = std::make_unique<SectionRunner>(wake_);
    const EmbeddedRunner& answer = answers.simulation.answer(kind);
    if (section_ && answer.shows(answers.scene.mesh()))
        runner->update(answer, section_);
    else
        runner->rest();
    return runner.get();
}

/// From the first frame of a pull to its last. Of a body at rest there is no range to hold.
void ShownScene::hold_range(const ShownAnswers& answers) {
    const bool holds = answers.pulling && answers.display.hold_range;
    if (holds && !holding_) {
        const double largest = largest_magnitude(answers.display);
        if (largest > 0.0) held_range_ = largest;
    }
    if (!holds) held_range_.reset();
    holding_ = holds;
}

bool ShownScene::update(const ShownAnswers& answers) {
    const Stopwatch watch;
    hold_range(answers);
    wants_reactions_ = needs_reactions(answers);
    update_filling(answers);
    section_ = section(answers);
    const double cutting_seconds = watch.seconds();
    const auto is_shown = [&](MethodKind kind) {
        return std::find(answers.kinds.begin(), answers.kinds.end(), kind) != answers.kinds.end();
    };
    std::erase_if(bodies_, [&](const ShownBody& body) { return !is_shown(body.kind()); });
    for (const auto& [kind, runner] : reactions_)
        if (!is_shown(kind)) runner->rest();
    for (const auto& [kind, runner] : insides_)
        if (!is_shown(kind)) runner->rest();
    bool changed = false;
    double seconds = cutting_seconds;
    for (const MethodKind kind : answers.kinds) {
        const Stopwatch of_inside;
        const SectionRunner* known = inside(answers, kind);
        seconds += of_inside.seconds();
        const ShownBody::Sources sources{.scene = answers.scene,
                                         .answer = answers.simulation.answer(kind),
                                         .filling = filling_,
                                         .reference = answers.simulation.previewing(kind) ? nullptr : answers.reference,
                                         .reactions = reactions(answers, kind),
                                         .section = section_,
                                         .inside = known,
                                         .probed = answers.probed};
        ShownBody& body = body_of(kind);
        if (!body.update(sources, answers.display)) continue;
        seconds += body.section_seconds();
        changed = true;
    }
    if (!section_)
        section_cost_.reset();
    else if (changed)
        sum_costs(seconds);
    return changed;
}

void ShownScene::sum_costs(double update_seconds) {
    section_cost_ = SectionCost{{}, update_seconds};
    for (const auto& [kind, runner] : insides_) {
        const SectionRunner::Cost cost = runner->cost();
        section_cost_->inside.points += cost.points;
        section_cost_->inside.evaluated += cost.evaluated;
        section_cost_->inside.worker_seconds += cost.worker_seconds;
    }
}

const std::string& ShownScene::section_failure(MethodKind kind) const {
    static const std::string none;
    const auto found = insides_.find(kind);
    return found == insides_.end() ? none : found->second->failure();
}

bool ShownScene::cutting() const {
    return std::any_of(insides_.begin(), insides_.end(), [](const auto& entry) { return entry.second->running(); });
}

bool ShownScene::solving() const {
    return std::any_of(reactions_.begin(), reactions_.end(), [](const auto& entry) { return entry.second->running(); });
}

void ShownScene::cancel() {
    for (const auto& [kind, runner] : insides_) runner->cancel();
    for (const auto& [kind, runner] : reactions_) runner->cancel();
}

bool ShownScene::working() const {
    const auto works = [](const auto& entry) { return entry.second->working(); };
    return std::any_of(insides_.begin(), insides_.end(), works) ||
           std::any_of(reactions_.begin(), reactions_.end(), works);
}

}  // namespace elastolab
