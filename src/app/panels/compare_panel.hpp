#pragma once

#include "app/panels/cost_predictions.hpp"

namespace elastolab {

struct PanelContext;

/// Which methods are compared and how, their differences from the reference, and the memory that this needs.
class ComparePanel {
public:
    /// costs: lives longer.
    explicit ComparePanel(CostPredictions& costs) : costs_(costs) {}
    void draw(const PanelContext& context);

private:
    CostPredictions& costs_;
};

}  // namespace elastolab
