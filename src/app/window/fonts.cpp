#include "app/window/fonts.hpp"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "render/pixels/lettering.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

/// The first that is installed is taken.
constexpr std::array kRegularFonts = {"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
                                      "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
                                      "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"};
constexpr std::array kBoldFonts = {"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Medium.ttf",
                                   "/usr/share/fonts/truetype/noto/NotoSans-Bold.ttf",
                                   "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"};

std::optional<fs::path> first_installed(std::span<const char* const> candidates) {
    const auto found =
        std::find_if(candidates.begin(), candidates.end(), [](const char* file) { return fs::exists(fs::path(file)); });
    return found == candidates.end() ? std::nullopt : std::optional<fs::path>(*found);
}

template <auto destroy>
struct Destroy {
    template <class T>
    void operator()(T* object) const {
        destroy(object);
    }
};
using Pattern = std::unique_ptr<FcPattern, Destroy<FcPatternDestroy>>;
using CharSet = std::unique_ptr<FcCharSet, Destroy<FcCharSetDestroy>>;
using FontSet = std::unique_ptr<FcFontSet, Destroy<FcFontSetDestroy>>;

/// The file of a font that has the character as outlines, in a format that panels and pictures can read.
std::optional<FontFile> outlines_with(FcPattern& font, char32_t character) {
    FcCharSet* its = nullptr;
    FcChar8* file = nullptr;
    FcBool has_outlines = FcFalse;
    int index = 0;
    FcPatternGetBool(&font, FC_OUTLINE, 0, &has_outlines);
    FcPatternGetInteger(&font, FC_INDEX, 0, &index);
    index &= 0xFFFF;  // above: an instance of a variable font
    if (has_outlines == FcFalse || FcPatternGetCharSet(&font, FC_CHARSET, 0, &its) != FcResultMatch ||
        FcCharSetHasChar(its, character) == FcFalse || FcPatternGetString(&font, FC_FILE, 0, &file) != FcResultMatch)
        return {};
    const fs::path path = reinterpret_cast<const char*>(file);
    return is_readable_font(path, index) ? std::optional(FontFile{path, index}) : std::nullopt;
}

}  // namespace

std::optional<fs::path> regular_font() {
    if (auto known = first_installed(kRegularFonts)) return known;
    const std::optional<FontFile> any = font_with(U'0');
    return any && any->index == 0 ? std::optional(any->path) : std::nullopt;
}

std::optional<fs::path> bold_font() {
    const auto known = first_installed(kBoldFonts);
    return known ? known : regular_font();
}

std::optional<FontFile> font_with(char32_t character) {
    const Pattern wanted(FcPatternCreate());
    const CharSet characters(FcCharSetCreate());
    FcCharSetAddChar(characters.get(), character);
    FcPatternAddCharSet(wanted.get(), FC_CHARSET, characters.get());
    FcPatternAddString(wanted.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
    FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
    FcDefaultSubstitute(wanted.get());
    FcResult result = FcResultNoMatch;
    const FontSet sorted(FcFontSort(nullptr, wanted.get(), FcTrue, nullptr, &result));
    if (!sorted) return {};
    for (FcPattern* const found : std::span(sorted->fonts, static_cast<std::size_t>(sorted->nfont)))
        if (std::optional<FontFile> file = outlines_with(*found, character)) return file;
    return {};
}

}  // namespace elastolab
