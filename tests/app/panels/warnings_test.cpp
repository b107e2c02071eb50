// What the panel says of an answer, and in which order.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "app/panels/warnings_panel.hpp"
#include "app/stage.hpp"
#include "bem/collocation/method.hpp"
#include "fem/nonlinear/method.hpp"

namespace elastolab::test {
namespace {

using testing::EndsWith, testing::StartsWith;

constexpr int kLooks = 1500;  ///< 20 ms apart

/// Of a cube whose end is turned by a right angle, once so many of them tell how far displacements are off.
std::vector<WarningsPanel::Warning> warnings_of_a_turn(MethodKind method, double poisson_ratio, int n_errors) {
    Document document = cube_document_with_handle(4);
    document.method = method;
    document.material.poisson_ratio = poisson_ratio;
    AffineMotion turn;
    turn.rotate = {.axis = Eigen::Vector3d::UnitX(), .degrees = 90.0, .center = {1.0, 0.5, 0.5}};
    document.handles.at(0).motion = turn;
    Stage stage;
    stage.open(document);
    stage.settle();
    std::vector<WarningsPanel::Warning> found;
    const auto n_off = [&] {
        return std::count_if(found.begin(), found.end(), [](const auto& one) {
            return one.text.find("displacements are off") != std::string::npos || one.text.starts_with("Linear theory");
        });
    };
    // Workers find them after the answer.
    for (int i = 0; i < kLooks && n_off() < n_errors; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        stage.frame();
        found = WarningsPanel::present(stage.state);
    }
    return found;
}

/// By constant elements the mesh is 41 % off and linear theory 39 %, by linear ones the mesh is some percent off.
TEST(WarningsOfTheViewer, BeginWithWhatIsFarthestOff) {
    const auto constant = warnings_of_a_turn(kConstantBem, 0.3, 2), linear = warnings_of_a_turn(kLinearBem, 0.3, 2);
    ASSERT_GE(constant.size(), 2u);
    EXPECT_THAT(constant[0].text, StartsWith("Constant BEM: displacements are off by about "));
    EXPECT_EQ(constant[1].better, kNonlinearFem);
    ASSERT_GE(linear.size(), 2u);
    EXPECT_THAT(linear[0].text, StartsWith("Linear theory: "));
    EXPECT_EQ(linear[0].better, kNonlinearFem);
    EXPECT_THAT(linear[1].text, StartsWith("Linear BEM: displacements are off by about "));
}

TEST(WarningsOfTheViewer, OfferNoMethodThatCannotTakeTheBody) {
    const auto found = warnings_of_a_turn(kLinearBem, 0.4999, 1);
    const auto theory =
        std::ranges::find_if(found, [](const auto& one) { return one.text.starts_with("Linear theory"); });
    ASSERT_NE(theory, found.end());
    EXPECT_EQ(theory->better, nullptr);
    EXPECT_THAT(theory->text, EndsWith("with a Poisson's ratio farther from 1/2."));
}

}  // namespace
}  // namespace elastolab::test
