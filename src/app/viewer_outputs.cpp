#include "app/viewer_outputs.hpp"

#include <exception>

#include "app/picture/view_point.hpp"
#include "base/error.hpp"

namespace elastolab {

void write_outputs(const ViewerOptions& options, ViewerState& state, const std::optional<Image>& picture) {
    std::exception_ptr failure;
    const auto attempt = [&](const auto& write) {
        try {
            write();
        } catch (const std::exception&) {
            if (!failure) failure = std::current_exception();
        }
    };
    const Eigen::VectorXd& displacement = state.simulation.answer(state.method).displacement();
    if (!options.scene_out.empty())
        attempt([&] { write_scene(options.scene_out, state.scene(), state.method, view_point_of(state.camera)); });
    if (!options.mesh_out.empty()) attempt([&] { write_deformed_mesh(options.mesh_out, state.scene(), displacement); });
    if (state.measurements.timings) attempt([&] { state.measurements.timings->finish(); });
    if (state.measurements.recorder) attempt([&] { state.measurements.recorder->finish(); });
    if (!options.screenshot.empty())
        attempt([&] {
            if (!picture)
                throw Error(options.screenshot.string() +
                            ": the window could not be drawn, so there is no picture. Do not minimise it.");
            write_png(options.screenshot, *picture);
        });
    if (failure) std::rethrow_exception(failure);
}

}  // namespace elastolab
