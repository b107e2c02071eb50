// What changes the scene of a ViewerState: the method, steps of the history, handles, loads, fixed sets.
#include <cmath>

#include "app/viewer_state.hpp"

namespace elastolab {

/// A choice of the method or its settings becomes a step of the scene's history, wherever it was made.
void ViewerState::keep_method() {
    const Document& document = scene_->document();
    if (document.method == method && document.settings == choices.settings()) return;
    scene_->set_method(method, choices.settings());
    if (gestures.action() == Gestures::Action::none) scene_->commit();  // else the gesture's own step has it
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

/// After undo and redo the numbers of handles and sets may mean others, their names do not.
void ViewerState::take_step(const std::function<void()>& step) {
    finish_gesture();
    keep_method();
    const std::string selected_handle = selected_handle_name(), selected_fixed_set = selected_fixed_name();
    const std::optional<int> selected_load = gestures.selected_load();
    const std::string load_name = selected_load && *selected_load >= 0 && *selected_load < scene_->n_loads()
                                      ? scene_->load_name(*selected_load)
                                      : "";
    step();
    take_method();
    gestures.select_handle(-1);
    gestures.keep_fixed(-1);
    gestures.select_load(std::nullopt);
    for (int handle = 0; handle < scene_->n_handles(); ++handle)
        if (scene_->handle_name(handle) == selected_handle) gestures.select_handle(handle);
    for (int set = 0; set < scene_->n_fixed_sets(); ++set)
        if (scene_->fixed_name(set) == selected_fixed_set) gestures.keep_fixed(set);
    if (selected_load == LiveScene::kGravity && scene_->document().gravity) gestures.select_load(selected_load);
    for (int load = 0; load < scene_->n_loads(); ++load)
        if (scene_->load_name(load) == load_name) gestures.select_load(load);
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
