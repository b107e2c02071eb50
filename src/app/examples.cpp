#include "app/examples.hpp"

#include <algorithm>
#include <system_error>

#include "scene/file/scene_file.hpp"

namespace elastolab {

namespace fs = std::filesystem;

std::vector<Example> examples_in(const fs::path& folder) {
    std::vector<Example> found;
    std::error_code error;
    for (fs::directory_iterator i(folder / "scenes", error), end; !error && i != end; i.increment(error)) {
        const fs::path scene = i->path();
        if (!is_scene_file(scene)) continue;
        std::string name = scene.stem().string();
        std::replace(name.begin(), name.end(), '-', ' ');
        fs::path picture = folder / "thumbnails" / scene.filename().replace_extension(".png");
        std::error_code missing;
        if (!fs::exists(picture, missing)) picture.clear();
        found.push_back({std::move(name), scene, std::move(picture)});
    }
    std::sort(found.begin(), found.end(), [](const Example& a, const Example& b) { return a.name < b.name; });
    return found;
}

std::vector<Example> examples() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    std::vector<Example> installed = examples_in(program.parent_path().parent_path() / "share" / "elastolab");
    return installed.empty() ? examples_in(ELASTOLAB_ASSETS_DIR) : installed;
}

}  // namespace elastolab
