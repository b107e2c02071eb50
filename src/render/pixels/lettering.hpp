#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "render/pixels/canvas.hpp"

namespace elastolab {

/// Whether this is a font of outlines (TrueType or CFF), in a file of its own or at this place of a collection.
bool is_readable_font(const std::filesystem::path& file, int index);

/// Text by a TrueType font at any size, drawn into pictures. Characters that the font lacks are shown as its box.
class Lettering {
public:
    /// Throws Error when the file is no font that can be read.
    explicit Lettering(const std::filesystem::path& font_file);
    ~Lettering();
    Lettering(const Lettering&) = delete;
    Lettering& operator=(const Lettering&) = delete;

    /// Width of one line of UTF-8 [pixels]; `size` is the height from the lowest to the highest letter.
    double width(std::string_view text, double size) const;
    /// Begins at `left`; `middle` is half the height of a digit above the baseline.
    void draw(Canvas& canvas, double left, double middle, std::string_view text, double size,
              const Colour& colour) const;

private:
    struct Font;
    std::unique_ptr<const Font> font_;
};

}  // namespace elastolab
