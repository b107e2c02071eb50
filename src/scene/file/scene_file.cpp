#include "scene/file/scene_file.hpp"

#include <fstream>
#include <string>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& finding) {
    throw SceneError(one_line(file.string() + ": " + finding));
}

std::string read_text(const fs::path& file) {
    std::error_code error;
    if (!fs::exists(file, error)) fail(file, "there is no such file. Check the path.");
    if (fs::is_directory(file, error)) fail(file, "is a folder. Name a scene file.");
    if (!fs::is_regular_file(file, error) && !fs::is_fifo(file, error)) fail(file, "is no file. Name a scene file.");
    std::ifstream stream(file, std::ios::binary);
    if (stream && stream.peek() == std::ifstream::traits_type::eof()) fail(file, "is empty. Write a scene into it.");
    std::string text, block(std::size_t{1} << 16, '\0');
    while (stream.read(block.data(), std::ssize(block)) || stream.gcount() > 0)
        text.append(block, 0, static_cast<std::size_t>(stream.gcount()));
    if (!stream.eof()) fail(file, "cannot be read. Check its permissions.");
    return text;
}

}  // namespace

bool is_scene_file(const fs::path& file) { return lower_case(file.extension().string()) == ".json"; }

Document load_scene(const fs::path& file) { return parse_scene(read_text(file), file.string()); }

void save_scene(const fs::path& file, const Document& document) {
    const std::string text = print_scene(document);
    AtomicFile out(file);
    out.stream() << text;
    out.commit();
}

}  // namespace elastolab
