#include "app/panels/cost_predictions.hpp"

#include <gtest/gtest.h>

#include "app/stage.hpp"
#include "fem/nonlinear/method.hpp"

namespace elastolab {
namespace {

TEST(CostPredictions, AreOfTheChosenElements) {
    test::Stage stage;
    stage.open(test::cube_document(6));
    ViewerState& state = stage.state;
    CostPredictions costs;
    for (const ElementDegree degree : {ElementDegree::quadratic, ElementDegree::linear, ElementDegree::quadratic}) {
        state.choices.elements = degree;
        const Method method = state.choices.of(kNonlinearFem);
        const Cost expected = predict_cost(stage.scene().mesh(), method);
        EXPECT_EQ(costs.of(state, method).memory_bytes, expected.memory_bytes);
        EXPECT_EQ(costs.of(state, method).degrees_of_freedom, expected.degrees_of_freedom);
        EXPECT_GE(costs.memory_with_completion(state, kNonlinearFem), expected.memory_bytes);
    }
}

}  // namespace
}  // namespace elastolab
