#pragma once

#include "app/panels/cost_predictions.hpp"

namespace elastolab {

struct PanelContext;

/// The methods with their costs, how far the chosen one is, and how it computes (computation_panel.hpp).
class MethodPanel {
public:
    /// costs: lives longer.
    explicit MethodPanel(CostPredictions& costs) : costs_(costs) {}
    void draw(const PanelContext& context);

private:
    MethodKind sooner_method(const ViewerState& state);
    /// One click to that method; empty without one.
    std::string sooner_words(const ViewerState& state, MethodKind sooner);

    CostPredictions& costs_;
};

}  // namespace elastolab
