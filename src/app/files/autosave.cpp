#include "app/files/autosave.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <variant>

#include "app/window/state_folder.hpp"
#include "base/error.hpp"
#include "scene/file/scene_file.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr double kEverySeconds = 2.0;
constexpr int kMostNames = 1000;

fs::path autosave_folder() {
    const fs::path folder = state_folder();
    return folder.empty() ? folder : folder / "autosave";
}

FileDescriptor open_locked(const fs::path& file, int flags) {
    FileDescriptor descriptor(open(file.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | flags, 0600));
    if (descriptor && flock(descriptor.get(), LOCK_EX | LOCK_NB) != 0) descriptor.reset();
    return descriptor;
}

/// What was there stays where the new name cannot be written.
void write_origin(const FileDescriptor& lock, const fs::path& origin) {
    const std::string text = origin.string();
    const ssize_t n = pwrite(lock.get(), text.data(), text.size(), 0);
    if (n != static_cast<ssize_t>(text.size()) || ftruncate(lock.get(), n) != 0)
        throw std::system_error(errno, std::generic_category(), "the name of its file cannot be written");
}

fs::path read_origin(const FileDescriptor& lock) {
    std::array<char, 4096> text{};
    const ssize_t n = pread(lock.get(), text.data(), text.size(), 0);
    return std::string(text.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
}

std::string body_of(const fs::path& scene) {
    try {
        const MeshSource mesh = load_scene(scene).mesh;
        const MeshFile* file = std::get_if<MeshFile>(&mesh);
        return file != nullptr ? fs::path(file->file).filename().string() : std::get<Primitive>(mesh).name;
    } catch (const std::exception&) {  // recover() says what it is
        return {};
    }
}

}  // namespace

void AutosavedScene::remove() {
    std::error_code ignored;
    fs::remove(file, ignored);
    fs::remove(lock, ignored);
    locked.reset();
}

std::vector<AutosavedScene> find_autosaved() {
    std::vector<AutosavedScene> found;
    std::error_code error;
    const fs::path folder = autosave_folder();
    if (folder.empty()) return found;
    for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
        const fs::path lock = i->path();
        if (lock.extension() != ".lock") continue;
        FileDescriptor locked = open_locked(lock, 0);
        if (!locked) continue;  // its viewer runs
        const fs::path file = fs::path(lock).replace_extension(".json");
        std::error_code missing;
        const fs::file_time_type time = fs::last_write_time(file, missing);
        if (missing) continue;
        fs::path origin = read_origin(locked);
        found.push_back({file, lock, std::move(origin), body_of(file), time, std::move(locked)});
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.time > b.time; });
    return found;
}

void Autosave::make_place() {
    const fs::path folder = autosave_folder();
    if (folder.empty()) throw Error("There is no folder for it. Set HOME or XDG_STATE_HOME.");
    fs::create_directories(folder);
    for (int i = 0; i < kMostNames; ++i) {
        const std::string name = std::to_string(getpid()) + "-" + std::to_string(i);
        const fs::path lock = folder / (name + ".lock");
        if (FileDescriptor locked = open_locked(lock, O_CREAT | O_EXCL)) {
            place_ = AutosavedScene{folder / (name + ".json"), lock, {}, {}, {}, std::move(locked)};
            origin_is_named_ = false;
            return;
        }
    }
    throw Error(folder.string() + ": no file can be made in it. Check its permissions, and the space on its disk.");
}

void Autosave::name_origin(const fs::path& origin) {
    if (origin_is_named_ && place_->origin == origin) return;
    place_->origin = origin;
    origin_is_named_ = false;
    write_origin(place_->locked, origin);
    origin_is_named_ = true;
}

/// The same state is written when it is due again, to a new place where the old one is gone.
void Autosave::fail(std::string why) {
    failure_ = std::move(why);
    written_.reset();
    wanted_ = true;
    std::error_code ignored;
    if (place_ && !fs::exists(place_->lock, ignored)) place_.reset();
}

void Autosave::poll() {
    const JobEvent event = job_.poll();
    if (event == JobEvent::failed) fail(job_.failure());
    if (event == JobEvent::finished) failure_.clear();
}

void Autosave::update(const Scene& scene, double now) {
    poll();
    wanted_ = scene.modified && scene.revision != written_;
    if (!scene.modified) {
        if (place_ || !failure_.empty()) clear();
        return;
    }
    if (!wanted_ || due_in(now) > 0.0 || job_.working()) return;
    last_ = now;
    wanted_ = false;
    written_ = scene.revision;
    try {
        if (!place_) make_place();
        name_origin(scene.origin);
    } catch (const std::exception& error) {
        return fail(user_text(error));
    }
    auto document = std::make_shared<const Document>(scene.document());
    job_.start([document, file = place_->file](Control&) {
        save_scene(file, *document);
        return true;
    });
}

double Autosave::due_in(double now) const {
    constexpr double kWhileWriting = 0.25;
    return wanted_ ? std::max(job_.working() ? kWhileWriting : 0.0, last_ + kEverySeconds - now) : -1.0;
}

void Autosave::adopt(AutosavedScene scene) {
    clear();
    place_ = std::move(scene);
    origin_is_named_ = true;
}

void Autosave::clear() {
    job_.cancel();
    while (job_.working()) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // it only writes a file
    job_.poll();
    if (place_) place_->remove();
    place_.reset();
    written_.reset();
    wanted_ = false;
    failure_.clear();
}

}  // namespace elastolab
