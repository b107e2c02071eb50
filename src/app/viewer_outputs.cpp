#include "app/viewer_outputs.hpp"

#include <exception>

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
    Control never_cancelled;
    if (!options.scene_out.empty()) attempt([&] { write_scene(options.scene_out, state.document_to_save()); });
    if (!options.mesh_out.empty())
        attempt([&] { write_export(options.mesh_out, state.export_source_now(), never_cancelled); });
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
