#include "app/window/recent_files.hpp"

#include <fstream>
#include <string>
#include <system_error>

#include "app/window/state_folder.hpp"
#include "base/atomic_file.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxFiles = 10;

/// Empty when there is no home folder.
fs::path remembered(const std::string& name) {
    const fs::path folder = state_folder();
    return folder.empty() ? folder : folder / name;
}

std::vector<fs::path> load_lines(const std::string& name) {
    std::vector<fs::path> lines;
    std::ifstream in(remembered(name));
    for (std::string line; lines.size() < kMaxFiles && std::getline(in, line);)
        if (!line.empty()) lines.emplace_back(line);
    return lines;
}

void save_lines(const std::string& name, const std::vector<fs::path>& lines) {
    const fs::path path = remembered(name);
    if (path.empty()) return;
    try {
        fs::create_directories(path.parent_path());
        AtomicFile file(path);
        for (const fs::path& entry : lines) file.stream() << entry.string() << '\n';
        file.commit();
    } catch (const std::exception&) {  // a convenience: nothing is lost without it
    }
}

}  // namespace

std::vector<fs::path> load_recent_files() { return load_lines("recent"); }
void save_recent_files(const std::vector<fs::path>& files) { save_lines("recent", files); }

fs::path load_last_folder(const std::string& kind) {
    for (const std::string& name : {"folder-" + kind, std::string("folder")}) {
        const std::vector<fs::path> lines = load_lines(name);
        std::error_code error;
        if (!lines.empty() && fs::is_directory(lines.front(), error)) return lines.front();
    }
    return {};
}

void save_last_folder(const std::string& kind, const fs::path& folder) {
    save_lines("folder-" + kind, {folder});
    save_lines("folder", {folder});
}

std::vector<fs::path> with_recent_file(std::vector<fs::path> files, const fs::path& file) {
    std::erase(files, file);
    files.insert(files.begin(), file);
    if (files.size() > kMaxFiles) files.resize(kMaxFiles);
    return files;
}

}  // namespace elastolab
