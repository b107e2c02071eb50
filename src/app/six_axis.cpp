#include "app/six_axis.hpp"

#include <algorithm>

#include "app/viewer_state.hpp"
#include "scene/motion.hpp"

namespace elastolab {

namespace {

constexpr double kPause = 0.4;         ///< [s] that ends a step
constexpr double kRadiiASecond = 0.5;  ///< a full deflection moves by this part of the scene's radius, and turns by
constexpr double kTurnASecond = 1.0;   ///< [radians]

}  // namespace

bool SixAxisControl::apply(const std::optional<SixAxisMotion>& motion, double now, ViewerState& state) {
    LiveScene& scene = state.scene();
    if (!motion) {
        if (moved_at_ < 0.0 || now - moved_at_ < kPause) return false;
        end_step(state);
        return true;
    }
    const int handle = state.gestures.selected_handle();
    if (handle < 0 || handle >= scene.n_handles() || state.gestures.dragging()) return false;
    Eigen::Matrix3d screen;
    screen << state.camera.right(), state.camera.up(), state.camera.backward();
    const Eigen::Vector3d shift = kRadiiASecond * state.camera.scene().radius * (screen * motion->shift);
    const Eigen::Vector3d turn = kTurnASecond * (screen * motion->turn);
    const Positions rest = scene.rest_positions(handle);
    const Motion present = scene.document().handles[static_cast<std::size_t>(handle)].motion;
    const Eigen::Vector3d middle = rest.rowwise().mean() + mean_displacement(present, rest);
    scene.set_motion(handle, translated(turned(present, turn, middle, rest), shift));
    moved_at_ = now;
    return true;
}

void SixAxisControl::end_step(ViewerState& state) {
    if (moved_at_ >= 0.0) state.scene().commit();
    moved_at_ = -1.0;
}

double SixAxisControl::due_in(double now) const {
    return moved_at_ < 0.0 ? -1.0 : std::max(0.0, moved_at_ + kPause - now);
}

}  // namespace elastolab
