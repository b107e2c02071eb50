#include "app/panels/computation_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/panels/cost_predictions.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr std::array<Choice<Mode>, 2> kModes = {
    {{Mode::on_demand, "on demand",
      "One factorisation; columns of the inverse when a handle needs them. Ready soonest."},
     {Mode::full, "K and inverse", "The stiffness K and its (bordered) inverse in memory, as the paper has it."}}};

constexpr std::array<Choice<Update>, 3> kUpdates = {
    {{Update::reduced, "collapsed (9')",
      "Solves the capacitance system, as small as the constrained set. Same displacements, least work."},
     {Update::eqn9, "Eqn. 9",
      "As the paper writes it: the inverse of the free block from the inverse of K. Needs K and inverse."},
     {Update::direct, "Eqn. 7", "Factorises the free block of K again for every constrained set."}}};

constexpr std::array<Choice<FrameRule>, 2> kFrameRules = {
    {{FrameRule::drag_columns, "moving columns",
      "The drag response: three columns, computed when the handle is grabbed. "
      "A frame only reads them, as fast as memory allows."},
     {FrameRule::displace, "whole update", "Every frame solves by the update rule above, to see what that costs."}}};

constexpr std::array<Choice<ElementDegree>, 2> kElements = {
    {{ElementDegree::quadratic, "ten-node", "Ten nodes a tetrahedron: accurate. Of nonlinear FEM."},
     {ElementDegree::linear, "four-node",
      "Four nodes a tetrahedron: an eighth of the unknowns, too stiff in bending."}}};
constexpr std::array<Choice<int>, 4> kRims = {
    {{0, "as given", "The triangles of the body."},
     {1, "one thin row",
      "A row of thin triangles along the rims of the constrained patches, where most of the error comes from: a "
      "quarter of the error, and three to five times the time until a new handle is ready. Of Galerkin BEM."},
     {2, "two thin rows",
      "Two of them, thinner towards the rim: a fifth of the error, ten times the time. Of Galerkin BEM."},
     {3, "three thin rows", "Three of them: little more accurate than two, as the rest of the error is elsewhere."}}};
constexpr std::array<Choice<Tractions>, 3> kTractions = {
    {{Tractions::discontinuous, "discontinuous",
      "Tractions may jump at the rim of a constrained patch, where they are "
      "singular. Most accurate."},
     {Tractions::restricted, "restricted", "Linear over a constrained patch, ending at its rim."},
     {Tractions::continuous, "continuous",
      "As in the paper: they leak over one ring of triangles onto the free surface."}}};

const char* update_label(Update update) {
    for (const Choice<Update>& choice : kUpdates)
        if (choice.value == update) return choice.label;
    return "";
}

/// A row that is grey where no shown method has such a choice.
template <class Value>
void draw_choice(const PanelContext& context, const char* label, Value& value, std::span<const Choice<Value>> choices,
                 bool has_choice) {
    set_item_width(context.gui.scale());
    ImGui::BeginDisabled(!has_choice);
    choose<Value>(label, value, choices);
    ImGui::EndDisabled();
}

/// What is there of the model, in rows that are there before it is.
void draw_model(const PanelContext& context, const MethodRunner& runner) {
    const Colour& dim = context.palette.text_dim;
    const std::shared_ptr<const Model>& model = runner.model();
    const auto told = [&](const auto& of) { return model ? of(model->facts()) : std::string("\u2013"); };
    fact("degrees of freedom", told([](const ModelFacts& f) { return count_text(f.n_degrees_of_freedom); }), dim);
    fact("memory", told([&](const ModelFacts& f) {
             return readable_bytes(static_cast<double>(f.memory_bytes + runner.set_memory()));
         }),
         dim);
    tooltip("Of the model and of the present constrained set, the estimate of its error included.");
    if (context.state.method->has_inside)
        fact("tetrahedra", told([](const ModelFacts& f) { return count_text(f.n_tetrahedra); }), dim);
    fact("K and its inverse", runner.completing() ? "being completed" : runner.has_inverse() ? "ready" : "\u2013", dim);
    fact("update in use",
         model ? update_label(model->method().rims > 0 ? Update::direct : model->method().update) : "\u2013", dim);
    tooltip(
        "Eqn. 9 needs K and its inverse. Until they are computed the collapsed form is used, which gives the same "
        "displacements.");
}

/// The modes with what each would cost; those that would not fit cannot be chosen.
void draw_mode(const PanelContext& context, CostPredictions& costs) {
    ViewerState& state = context.state;
    set_item_width(context.gui.scale());
    if (begin_choice("ahead", state.choices.mode == Mode::full ? kModes[1].label : kModes[0].label)) {
        for (const Choice<Mode>& choice : kModes) {
            Method method = state.choices.of(state.method);
            method.mode = choice.value;
            const Cost& price = costs.of(state, method);
            const bool fits = price.memory_bytes < available_memory_bytes();
            const std::string label = std::string(choice.label) + "   " + readable_prediction(price.seconds()) + ", " +
                                      readable_bytes(static_cast<double>(price.memory_bytes)) +
                                      (fits ? "" : " (does not fit)");
            ImGui::BeginDisabled(!fits);
            if (choice_entry(label.c_str(), choice.explanation, choice.value == state.choices.mode))
                state.choices.mode = choice.value;
            ImGui::EndDisabled();
        }
        end_choice();
    }
    if (state.choices.mode != Mode::on_demand) return;
    ImGui::BeginDisabled(!has(state.method, Mode::full));
    slider("complete up to", state.choices.complete_up_to, 0, 5000, "%d vertices", context.gui.scale());
    ImGui::EndDisabled();
    tooltip(
        "On bodies of up to this many vertices, K and its inverse are computed in the background once the body can be "
        "pulled. After that a new handle is ready sooner.");
}

}  // namespace

void draw_computation(const PanelContext& context, CostPredictions& costs) {
    ViewerState& state = context.state;
    if (!ImGui::TreeNode("How it computes")) return;
    draw_model(context, state.simulation.runner(state.method));
    draw_mode(context, costs);
    const std::vector<MethodKind> shown = state.shown_kinds();
    const auto any = [&](bool MethodTraits::*has) {
        return std::any_of(shown.begin(), shown.end(), [&](MethodKind kind) { return kind->*has; });
    };
    MethodChoices& choices = state.choices;
    draw_choice<Update>(context, "update", choices.update, kUpdates, true);
    draw_choice<FrameRule>(context, "each frame", choices.frame_rule, kFrameRules, any(&MethodTraits::linear));
    draw_choice<Tractions>(context, "tractions", choices.tractions, kTractions, any(&MethodTraits::chooses_tractions));
    draw_choice<ElementDegree>(context, "elements", choices.elements, kElements, any(&MethodTraits::chooses_elements));
    draw_choice<int>(context, "rims", choices.rims, kRims, any(&MethodTraits::chooses_rims));
    ImGui::TreePop();
}

}  // namespace elastolab
