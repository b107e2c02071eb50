#include "app/files/exports.hpp"

#include <memory>
#include <utility>

#include "app/job_notes.hpp"

namespace elastolab {

void Exports::start(const std::filesystem::path& file, const std::function<ExportSource()>& make_source,
                    const std::string& remark, Messages& messages) {
    if (running()) {
        messages.error(file_.filename().string() + " is still being written. Export " + file.filename().string() +
                       " when it is there.");
        return;
    }
    std::string note = "Exported " + file.string() + remark;
    ExportSource source = make_source();
    if (!takes_solves(file) && source.converged) {  // the work of a frame
        attempt(messages, [&] {
            Control never_cancelled;
            write_export(file, source, never_cancelled);
            messages.note(note);
        });
        return;
    }
    file_ = file;
    job_.start([file, note, source = std::make_shared<const ExportSource>(std::move(source))](Control& control) {
        write_export(file, *source, control);
        return note;
    });
}

bool Exports::poll(Messages& messages) { return tell_end(job_, messages); }

}  // namespace elastolab
