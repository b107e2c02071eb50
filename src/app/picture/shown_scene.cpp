#include "app/picture/shown_scene.hpp"

#include <algorithm>

namespace elastolab {

namespace {

template <class Bodies>
auto find_body(Bodies& bodies, MethodKind kind) {
    return std::find_if(bodies.begin(), bodies.end(), [&](const ShownBody& body) { return body.kind() == kind; });
}

bool needs_reactions(const DisplaySettings& display) {
    return display.arrows || display.field == Field::traction || display.field == Field::von_mises;
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
    if (!display.auto_range) return {display.range_low, display.range_high};
    double high = 0.0;
    for (const ShownBody& shown : bodies_) high = std::max(high, shown.max_value());
    return {0.0, high > 0.0 ? high : 1.0};
}

void ShownScene::forget() {
    bodies_.clear();
    volume_.forget();
    for (const auto& [kind, runner] : reactions_) runner->rest();
}

/// The reactions of a method, when something is shown that needs them.
const ReactionRunner* ShownScene::reactions(const ShownAnswers& answers, MethodKind kind) {
    std::unique_ptr<ReactionRunner>& runner = reactions_[kind];
    if (!runner) runner = std::make_unique<ReactionRunner>(wake_);
    if (!needs_reactions(answers.display)) {
        runner->rest();
        return nullptr;
    }
    runner->update(answers.simulation.answer(kind).runner());
    return runner.get();
}

/// The inside of a method's body, when it is to be cut open.
const Volume* ShownScene::volume(const ShownAnswers& answers, MethodKind kind) {
    const EmbeddedRunner& answer = answers.simulation.embedded(kind);
    const bool answers_now = &answer == &answers.simulation.answer(kind) && answer.shows(answers.scene.mesh());
    return answers.display.section && answers_now ? volume_.of(answer.runner()) : nullptr;
}

bool ShownScene::update(const ShownAnswers& answers) {
    if (!answers.display.section) volume_.forget();
    const auto is_shown = [&](MethodKind kind) {
        return std::find(answers.kinds.begin(), answers.kinds.end(), kind) != answers.kinds.end();
    };
    std::erase_if(bodies_, [&](const ShownBody& body) { return !is_shown(body.kind()); });
    for (const auto& [kind, runner] : reactions_)
        if (!is_shown(kind)) runner->rest();
    bool changed = false;
    for (const MethodKind kind : answers.kinds) {
        const ShownBody::Sources sources{.scene = answers.scene,
                                         .answer = answers.simulation.answer(kind),
                                         .reference = answers.simulation.previewing(kind) ? nullptr : answers.reference,
                                         .reactions = reactions(answers, kind),
                                         .volume = volume(answers, kind)};
        changed = body_of(kind).update(sources, answers.display) || changed;
    }
    return changed;
}

bool ShownScene::solving() const {
    return std::any_of(reactions_.begin(), reactions_.end(), [](const auto& entry) { return entry.second->running(); });
}

void ShownScene::cancel() {
    volume_.cancel();
    for (const auto& [kind, runner] : reactions_) runner->cancel();
}

bool ShownScene::working() const {
    return volume_.working() ||
           std::any_of(reactions_.begin(), reactions_.end(), [](const auto& entry) { return entry.second->working(); });
}

}  // namespace elastolab
