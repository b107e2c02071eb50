#include "render/pixels/lettering.hpp"

#include <stb_truetype.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"

namespace elastolab {

struct Lettering::Font {
    std::vector<unsigned char> bytes;
    stbtt_fontinfo info{};

    /// Advance of a code point [units of the font].
    int advance(int code, int next) const {
        int width = 0, bearing = 0;
        stbtt_GetCodepointHMetrics(&info, code, &width, &bearing);
        return width + (next != 0 ? stbtt_GetCodepointKernAdvance(&info, code, next) : 0);
    }
};

namespace {

/// As the font library counts them.
std::vector<int> code_points(std::string_view text) {
    const std::vector<char32_t> characters = characters_of(text);
    return {characters.begin(), characters.end()};
}

std::vector<unsigned char> bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool opens(const std::vector<unsigned char>& bytes, int index, stbtt_fontinfo& info) {
    constexpr std::size_t kHeader = 12;
    const int offset = bytes.size() > kHeader ? stbtt_GetFontOffsetForIndex(bytes.data(), index) : -1;
    return offset >= 0 && stbtt_InitFont(&info, bytes.data(), offset) != 0;
}

}  // namespace

bool is_readable_font(const std::filesystem::path& file, int index) {
    const std::vector<unsigned char> bytes = bytes_of(file);
    stbtt_fontinfo info{};
    return opens(bytes, index, info);
}

Lettering::Lettering(const std::filesystem::path& font_file) {
    auto font = std::make_unique<Font>();
    font->bytes = bytes_of(font_file);
    if (!opens(font->bytes, 0, font->info))
        throw Error(font_file.string() + ": is no font that can be read. Install fonts-roboto-unhinted.");
    font_ = std::move(font);
}

Lettering::~Lettering() = default;

double Lettering::width(std::string_view text, double size) const {
    const std::vector<int> codes = code_points(text);
    int sum = 0;
    for (std::size_t i = 0; i < codes.size(); ++i)
        sum += font_->advance(codes[i], i + 1 < codes.size() ? codes[i + 1] : 0);
    return sum * static_cast<double>(stbtt_ScaleForPixelHeight(&font_->info, static_cast<float>(size)));
}

void Lettering::draw(Canvas& canvas, double left, double middle, std::string_view text, double size,
                     const Colour& colour) const {
    const stbtt_fontinfo* const info = &font_->info;
    const float scale = stbtt_ScaleForPixelHeight(info, static_cast<float>(size));
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetCodepointBox(info, '0', &x0, &y0, &x1, &y1);
    const double base = middle + 0.5 * scale * y1;
    const std::vector<int> codes = code_points(text);
    std::vector<unsigned char> covers;
    double x = left;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const auto shift_x = static_cast<float>(x - std::floor(x)),
                   shift_y = static_cast<float>(base - std::floor(base));
        stbtt_GetCodepointBitmapBoxSubpixel(info, codes[i], scale, scale, shift_x, shift_y, &x0, &y0, &x1, &y1);
        const int width = x1 - x0, height = y1 - y0;
        covers.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
        if (!covers.empty())
            stbtt_MakeCodepointBitmapSubpixel(info, covers.data(), width, height, width, scale, scale, shift_x, shift_y,
                                              codes[i]);
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column) {
                const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
                const float cover = static_cast<float>(covers[at + static_cast<std::size_t>(column)]) / 255.0f;
                canvas.blend(static_cast<int>(std::floor(x)) + x0 + column,
                             static_cast<int>(std::floor(base)) + y0 + row, colour, cover);
            }
        x += scale * static_cast<double>(font_->advance(codes[i], i + 1 < codes.size() ? codes[i + 1] : 0));
    }
}

}  // namespace elastolab
