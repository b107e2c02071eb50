#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/document.hpp"

namespace elastolab {

/// The version of the scene file format that this program writes and reads.
inline constexpr int kSceneVersion = 1;

/// Whether a file is called like a scene (.json, .JSON) and not like a mesh.
bool is_scene_file(const std::filesystem::path& file);

/// Reads a scene file (docs/reference.md, "Scene files"). Strict: everything that is not understood is an error.
/// Throws SceneError in one line: the file, the JSON path (or line and column), the finding and a way forward.
Document load_scene(const std::filesystem::path& file);

/// The same for text in memory; `name` stands for the file in messages.
Document parse_scene(std::string_view text, const std::string& name);

/// The text of a scene file. parse_scene gives back an equal document, every number exactly.
/// Throws SceneError when a name in it is not valid UTF-8.
std::string print_scene(const Document& document);

/// Writes a scene file; one of that name is replaced once the new one is complete. Throws Error.
void save_scene(const std::filesystem::path& file, const Document& document);

}  // namespace elastolab
