#include "app/screen.hpp"

#include "app/panels/layout.hpp"

namespace elastolab::test {

Screen::Screen(const std::filesystem::path& scene, const Eigen::Vector2i& window) {
    state_.files.open_now(scene);
    place_ = layout_of(window, 1.0f).scene;
    state_.shown.viewports = viewports_of(state_, place_);
    state_.frame_body();
}

}  // namespace elastolab::test
