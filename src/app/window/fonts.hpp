#pragma once

#include <filesystem>
#include <optional>

namespace elastolab {

/// The fonts of the panels that are installed; nothing when none is.
std::optional<std::filesystem::path> regular_font();
std::optional<std::filesystem::path> bold_font();

struct FontFile {
    std::filesystem::path path;
    int index = 0;  ///< in a collection

    bool operator==(const FontFile&) const = default;
};
/// An installed font that has this character; nothing when there is none.
std::optional<FontFile> font_with(char32_t character);

}  // namespace elastolab
