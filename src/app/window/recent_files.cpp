#include "app/window/recent_files.hpp"

#include <cstdlib>
#include <fstream>
#include <string>

#include "base/atomic_file.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxFiles = 10;

/// Empty when there is no home folder.
fs::path list_file() {
    if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0')
        return fs::path(state) / "elastolab" / "recent";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return fs::path(home) / ".local" / "state" / "elastolab" / "recent";
    return {};
}

}  // namespace

std::vector<fs::path> load_recent_files() {
    std::vector<fs::path> files;
    std::ifstream in(list_file());
    for (std::string line; files.size() < kMaxFiles && std::getline(in, line);)
        if (!line.empty()) files.emplace_back(line);
    return files;
}

void save_recent_files(const std::vector<fs::path>& files) {
    const fs::path path = list_file();
    if (path.empty()) return;
    try {
        fs::create_directories(path.parent_path());
        AtomicFile file(path);
        for (const fs::path& entry : files) file.stream() << entry.string() << '\n';
        file.commit();
    } catch (const std::exception&) {  // a convenience: nothing is lost without it
    }
}

std::vector<fs::path> with_recent_file(std::vector<fs::path> files, const fs::path& file) {
    std::erase(files, file);
    files.insert(files.begin(), file);
    if (files.size() > kMaxFiles) files.resize(kMaxFiles);
    return files;
}

}  // namespace elastolab
