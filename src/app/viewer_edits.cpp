// What changes the scene of a ViewerState: the method, steps of the history, handles, loads, fixed sets.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/viewer_state.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

/// Of the largest displacement: as far apart two answers to the same question are, of one equilibrium.
constexpr double kSameShape = 1e-3;

/// Of what a person selects, each by its number.
struct Names {
    std::vector<std::string> handles, fixed_sets, loads;
    bool gravity = false;
};

Names names_of(const LiveScene& scene) {
    Names names;
    for (int handle = 0; handle < scene.n_handles(); ++handle) names.handles.push_back(scene.handle_name(handle));
    for (int set = 0; set < scene.n_fixed_sets(); ++set) names.fixed_sets.push_back(scene.fixed_name(set));
    for (int load = 0; load < scene.n_loads(); ++load) names.loads.push_back(scene.load_name(load));
    names.gravity = scene.document().gravity.has_value();
    return names;
}

/// -1 where it is not there.
int place_of(const std::string& name, const std::vector<std::string>& names) {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

/// -1 where none or several are new.
int only_new_one(const std::vector<std::string>& before, const std::vector<std::string>& after) {
    int found = -1;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (place_of(after[i], before) >= 0) continue;
        if (found >= 0) return -1;
        found = static_cast<int>(i);
    }
    return found;
}

}  // namespace

/// A choice of the method or its settings becomes a step of the scene's history, wherever it was made; but it takes no
/// redo away.
void ViewerState::keep_method() {
    const Document& document = scene_->document();
    if (document.method == method && document.settings == choices.settings()) return;
    scene_->set_method(method, choices.settings());
    if (gestures.action() == Gestures::Action::none) scene_->commit_method();  // else the gesture's own step has it
}

void ViewerState::select_method(MethodKind kind) {
    method = kind;
    keep_method();
}

void ViewerState::take_method() {
    method = scene_->document().method;
    choices.set(scene_->document().settings);
}

std::string ViewerState::selected_fixed_name() const {
    const int set = gestures.selected_fixed();
    return set >= 0 && set < scene_->n_fixed_sets() ? scene_->fixed_name(set) : "";
}

std::string ViewerState::selected_handle_name() const {
    const int handle = gestures.selected_handle();
    return handle >= 0 && handle < scene_->n_handles() ? scene_->handle_name(handle) : "";
}

/// After undo and redo the numbers of handles, sets and loads may mean others, their names do not. One that a step
/// brought is selected, as it was when it was made.
void ViewerState::take_step(const std::function<void()>& step) {
    finish_gesture();
    keep_method();
    moved_by_force_.clear();
    const std::string handle = selected_handle_name(), fixed_set = selected_fixed_name();
    const std::optional<int> selected_load = gestures.selected_load();
    const Names before = names_of(*scene_);
    const bool is_load = selected_load && *selected_load >= 0 && *selected_load < scene_->n_loads();
    const std::string load = is_load ? scene_->load_name(*selected_load) : "";
    step();
    take_method();
    const Names after = names_of(*scene_);
    gestures.select_handle(place_of(handle, after.handles));
    gestures.keep_fixed(place_of(fixed_set, after.fixed_sets));
    gestures.select_load(std::nullopt);
    if (after.gravity && (selected_load == LiveScene::kGravity || !before.gravity))
        gestures.select_load(LiveScene::kGravity);
    if (const int kept = place_of(load, after.loads); kept >= 0) gestures.select_load(kept);
    if (const int brought = only_new_one(before.handles, after.handles); brought >= 0) gestures.select_handle(brought);
    if (const int brought = only_new_one(before.fixed_sets, after.fixed_sets); brought >= 0)
        gestures.select_fixed(brought);
    if (const int brought = only_new_one(before.loads, after.loads); brought >= 0) gestures.select_load(brought);
}

void ViewerState::undo() {
    take_step([&] {
        if (scene_->can_undo()) scene_->undo();
    });
}

void ViewerState::redo() {
    take_step([&] {
        if (scene_->can_redo()) scene_->redo();
    });
}

void ViewerState::remove_handle(int handle) {
    if (handle < 0 || handle >= scene_->n_handles()) return;
    const int vertex = scene_->vertices(handle).front();
    finish_gesture();  // which may remove another one: numbers change, vertices do not
    if (scene_->owner(vertex) < 0) return;
    scene_->remove_handle(scene_->owner(vertex));
    scene_->commit();
    gestures.select_handle(-1);
}

void ViewerState::clear_handles() {
    finish_gesture();
    scene_->clear_handles();
    scene_->commit();
    gestures.select_handle(-1);
}

void ViewerState::remove_load(int load) {
    if (load < 0 || load >= scene_->n_loads()) return;
    const std::string name = scene_->load_name(load);
    finish_gesture();  // which may remove another one: numbers change, names do not
    for (int l = 0; l < scene_->n_loads(); ++l) {
        if (scene_->load_name(l) != name) continue;
        scene_->remove_load(l);
        scene_->commit();
        break;
    }
    gestures.select_load(std::nullopt);
}

void ViewerState::clear_loads() {
    finish_gesture();
    scene_->clear_loads();
    scene_->commit();
    gestures.select_load(std::nullopt);
}

void ViewerState::remove_fixed_set(int set) {
    if (set < 0 || set >= scene_->n_fixed_sets()) return;
    finish_gesture();
    if (set >= scene_->n_fixed_sets()) return;
    scene_->remove_fixed_set(set);
    scene_->commit();
    gestures.select_fixed(-1);
}

void ViewerState::begin_from_rest() {
    finish_gesture();
    const MethodRunner& runner = simulation.runner(method);
    if (runner.equilibrium() == nullptr) return;
    from_rest_ = {method, scene_->revision(), runner.displacement()};
    simulation.begin_from_rest(method);
}

void ViewerState::tell_from_rest() {
    if (!from_rest_) return;
    const MethodRunner& runner = simulation.runner(from_rest_->method);
    const Eigen::VectorXd &before = from_rest_->before, &now = runner.displacement();
    if (from_rest_->revision != scene_->revision() || runner.crushed() || now.size() != before.size())
        return from_rest_.reset();
    if (runner.equilibrium() == nullptr || !runner.converged()) return;
    const auto largest = [](const Eigen::VectorXd& u) {
        return u.reshaped(3, u.size() / 3).colwise().norm().maxCoeff();
    };
    const double other = largest(now - before) / std::max(largest(before), largest(now));
    messages.note(other < kSameShape
                      ? "From rest the body comes to the same shape."
                      : "From rest the body comes to another shape, up to " + readable_number(100.0 * other, 2) +
                            " % of its largest displacement away: both are equilibria.");
    from_rest_.reset();
}

void ViewerState::set_young_modulus(double value) {
    if (!(value > 0.0 && std::isfinite(value))) {
        messages.error("Young's modulus must be positive. Enter a force per area above 0.");
        return;
    }
    Material material = scene_->document().material;
    material.young_modulus = value;
    scene_->set_material(material);
    scene_->commit();
}

}  // namespace elastolab
