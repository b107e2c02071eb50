#pragma once

#include <filesystem>
#include <list>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "app/window/fonts.hpp"
#include "app/window/window.hpp"

struct ImFont;
using ImWchar = unsigned short;

namespace elastolab {

/// Fonts of the panels.
struct Fonts {
    ImFont* regular = nullptr;
    ImFont* bold = nullptr;
    ImFont* large = nullptr;
};

/// Loads the fonts of the panels into Dear ImGui, with glyphs for every character that was asked for. Needs its
/// context, and OpenGL.
class GuiFonts {
public:
    /// window: lives longer.
    explicit GuiFonts(const Window& window) : window_(window) {}

    const Fonts& fonts() const { return fonts_; }
    /// Logical pixels for a length that is 1 on an ordinary screen.
    float scale() const { return scale_; }
    /// Loads the fonts in this size, where it is another one. Between frames.
    void set_scale(float scale);
    /// Characters that will be shown, in UTF-8. Those of scripts beside Latin and Greek get their glyphs from an
    /// installed font, at the next add_wanted_characters().
    void want_characters(std::string_view text);
    void want_character(char32_t character);
    /// Between frames: the panels hold no text then.
    void add_wanted_characters();

private:
    void load_fonts();
    ImFont* load_font(const std::optional<std::filesystem::path>& file, float size);

    const Window& window_;
    Fonts fonts_;
    float scale_ = 0.0f;
    std::map<char32_t, std::optional<FontFile>> others_;  ///< characters beside our own, and a font that has them
    std::vector<char32_t> wanted_;                        ///< those of them whose font is still to be found
    std::list<std::vector<ImWchar>> ranges_;              ///< of the fonts that are loaded
};

}  // namespace elastolab
