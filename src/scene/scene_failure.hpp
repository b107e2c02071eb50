#pragma once

#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"

namespace elastolab {

/// "scene.json: /handles/0": a place of a scene file, by its JSON path.
inline std::string place(const std::filesystem::path& scene_file, const std::string& path) {
    return scene_file.string() + ": " + path;
}

/// Throws the SceneError that says what is wrong there, and a way forward.
[[noreturn]] inline void fail_at(const std::filesystem::path& scene_file, const std::string& path,
                                 const std::string& finding) {
    throw SceneError(one_line(place(scene_file, path) + ": " + finding));
}

}  // namespace elastolab
