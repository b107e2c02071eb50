// What a ViewerState writes for other programs.
#include <utility>

#include "app/viewer_state.hpp"

namespace elastolab {

namespace fs = std::filesystem;

void ViewerState::export_mesh(const fs::path& file) {
    if (export_job_.running()) {
        messages.error(export_file_.filename().string() + " is still being written. Export " +
                       file.filename().string() + " when it is there.");
        return;
    }
    const bool is_preview = simulation.previewing(method);
    ExportSource source = export_source(*scene_, simulation.answer(method));
    if (!takes_solves(file) && source.refined) {  // the work of a frame
        attempt([&] {
            Control never_cancelled;
            write_export(file, source, never_cancelled);
            messages.note("Exported " + file.string());
        });
        return;
    }
    std::string note = "Exported " + file.string() + (is_preview ? ", the preview: the method is not ready yet" : "");
    export_file_ = file;
    export_job_.start([file, note, source = std::make_shared<const ExportSource>(std::move(source))](Control& control) {
        write_export(file, *source, control);
        return note;
    });
}

}  // namespace elastolab
