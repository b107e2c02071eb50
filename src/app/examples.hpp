#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace elastolab {

/// A scene that comes with the program.
struct Example {
    std::string name;  ///< "beam twist"
    std::filesystem::path scene;
    std::filesystem::path picture;  ///< a small PNG of it; empty when there is none
};

/// All of them, by name: those installed with the program (../share/elastolab from it), else those of the sources that
/// it was built from. None where neither is there.
std::vector<Example> examples();
/// Those of one folder, which has the folders scenes and thumbnails.
std::vector<Example> examples_in(const std::filesystem::path& folder);

}  // namespace elastolab
