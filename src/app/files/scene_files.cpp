#include "app/files/scene_files.hpp"

#include <system_error>
#include <utility>
#include <variant>

#include "app/job_notes.hpp"
#include "app/window/recent_files.hpp"
#include "base/error.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

/// When the file of the mesh was written; nothing where there is none.
std::optional<fs::file_time_type> time_of_mesh(const Document& document) {
    const auto* mesh = std::get_if<MeshFile>(&document.mesh);
    std::error_code failure;
    if (mesh == nullptr) return {};
    const fs::file_time_type time = fs::last_write_time(mesh->file, failure);
    return failure ? std::optional<fs::file_time_type>() : time;
}

}  // namespace

SceneFiles::SceneFiles(EditedScene edited, Messages& messages, const std::function<void()>& wake)
    : edited_(std::move(edited)), messages_(messages), recent_(load_recent_files()), load_job_(wake), autosave_(wake) {}

void SceneFiles::open(const fs::path& file) {
    guard([this, file] { begin_loading(file); });
}

void SceneFiles::open_now(const fs::path& file, Control& control) {
    replace(load_scene_or_mesh(file, control));
    add_recent(file);
}

void SceneFiles::open_document(Document document, const fs::path& base) {
    edited_.finish_gesture();
    load_job_.cancel();  // what is wanted last counts
    asked_ = {};
    attempt(messages_, [&] { replace({.scene = std::make_unique<LiveScene>(std::move(document), base), .file = {}}); });
}

void SceneFiles::begin_with(const AskedFor& asked) {
    if (loading()) asked_ = asked;
}

void SceneFiles::begin_loading(const fs::path& file) {
    recovering_.reset();  // another one is wanted now; it is offered again at the next start
    load(file, [file](Control& control) { return load_scene_or_mesh(file, control); });
}

void SceneFiles::load(fs::path file, std::function<LoadedScene(Control&)> work) {
    load_job_.start(
        [work = std::move(work)](Control& control) { return std::make_shared<LoadedScene>(work(control)); });
    pending_file_ = std::move(file);
    revision_at_open_ = revision();
}

void SceneFiles::poll() {
    switch (load_job_.poll()) {
        case JobEvent::finished:
            // What was changed while it was being loaded counts, too.
            unsaved.guard(
                edited_.scene().modified() && revision() != revision_at_open_,
                [this, loaded = load_job_.take(), file = pending_file_] { take_loaded(std::move(*loaded), file); });
            break;
        case JobEvent::failed:
            messages_.error(load_job_.failure());
            asked_ = {};
            recovering_.reset();
            break;
        case JobEvent::cancelled:
            asked_ = {};
            break;
        case JobEvent::none:
            break;
    }
}

void SceneFiles::take_loaded(LoadedScene loaded, const fs::path& file) {
    if (loaded.recovered) recovered_ = std::exchange(recovering_, std::nullopt);
    replace(std::move(loaded));
    add_recent(file);
}

void SceneFiles::replace(LoadedScene loaded) {
    file_ = loaded.file;
    owns_file_ = false;
    ++n_replaced_;
    loaded.asked = std::exchange(asked_, {});
    edited_.replace(std::move(loaded));
    mesh_written_ = time_of_mesh(edited_.document());
}

bool SceneFiles::save(const fs::path& file) {
    edited_.finish_gesture();
    return attempt(messages_, [&] {
        const Document document = edited_.document();
        write_scene(file, document);
        edited_.scene().mark_saved();
        file_ = fs::absolute(file);
        owns_file_ = true;
        add_recent(file);
        const std::string problem = mesh_file_problem(document);
        if (problem.empty()) return messages_.note("Saved " + file.string());
        throw SceneError("Saved " + file.string() + ", but " + problem);
    });
}

std::string SceneFiles::mesh_file_problem(const Document& document) const {
    const auto* mesh = std::get_if<MeshFile>(&document.mesh);
    if (mesh == nullptr || !mesh_written_) return "";
    const std::optional<fs::file_time_type> now = time_of_mesh(document);
    if (now == mesh_written_) return "";
    return "its mesh " + mesh->file + (now ? " is another file than" : " is no longer there, as") +
           " when it was opened: the saved scene is of what is there. Bring the file back before you open it "
           "again.";
}

std::string SceneFiles::title() const {
    const LiveScene& scene = edited_.scene();
    const fs::path name = file_.empty() ? fs::path(scene.name()) : file_;
    return name.filename().string() + (scene.modified() ? " (not saved)" : "");
}

void SceneFiles::add_recent(const fs::path& file) {
    if (file.empty()) return;  // a primitive
    recent_ = with_recent_file(recent_, fs::absolute(file));
    save_recent_files(recent_);
}

void SceneFiles::guard(UnsavedChanges::Action action) {
    edited_.finish_gesture();
    unsaved.guard(edited_.scene().modified(), std::move(action));
}

/// A save that fails leaves the question: there is still time to choose otherwise.
void SceneFiles::answer(UnsavedAnswer answer) {
    if (answer == UnsavedAnswer::cancel) return unsaved.cancel();
    if (answer == UnsavedAnswer::save) {
        wants_name = !owns_file_;
        if (wants_name || !save(fs::path(file_))) return;
    }
    unsaved.proceed();
}

void SceneFiles::recover() {
    if (recoverable.empty()) return;
    const auto left = std::make_shared<AutosavedScene>(std::move(recoverable.front()));
    recoverable.erase(recoverable.begin());
    // Where the answer is that the present scene stays, this copy is offered again at the next start.
    unsaved.guard(edited_.scene().modified(), [this, left] {
        recovering_ = std::move(*left);
        load(recovering_->origin, [file = recovering_->file, origin = recovering_->origin](Control& control) {
            return load_autosaved(file, origin, control);
        });
    });
}

void SceneFiles::discard_recoverable() {
    if (recoverable.empty()) return;
    recoverable.front().remove();
    recoverable.erase(recoverable.begin());
}

std::uint64_t SceneFiles::revision() const { return edited_.scene().revision() + (n_replaced_ << 32); }

bool SceneFiles::keep_copy(double now) {
    const std::string before = autosave_.failure();
    if (recovered_) autosave_.adopt(*std::exchange(recovered_, std::nullopt));
    autosave_.update(
        {.revision = revision(), .modified = edited_.scene().modified(), .origin = file_, .document = edited_.document},
        now);
    return autosave_.failure() != before;
}

}  // namespace elastolab
