#pragma once

namespace elastolab {

struct PanelContext;
class CostPredictions;

/// How the chosen method computes, in a part that can be folded: what there is of its model, and the choices of mode,
/// update, tractions, elements and rims. It keeps nothing: all is in the state's MethodChoices.
void draw_computation(const PanelContext& context, CostPredictions& costs);

}  // namespace elastolab
