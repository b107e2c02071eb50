#include "app/window/fonts.hpp"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>

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

}  // namespace

std::optional<fs::path> regular_font() { return first_installed(kRegularFonts); }
std::optional<fs::path> bold_font() { return first_installed(kBoldFonts); }

std::optional<FontFile> font_with(char32_t character) {
    const Pattern wanted(FcPatternCreate());
    const CharSet characters(FcCharSetCreate());
    FcCharSetAddChar(characters.get(), character);
    FcPatternAddCharSet(wanted.get(), FC_CHARSET, characters.get());
    FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
    FcPatternAddString(wanted.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
    FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
    FcDefaultSubstitute(wanted.get());
    FcResult result = FcResultNoMatch;
    const Pattern found(FcFontMatch(nullptr, wanted.get(), &result));
    if (!found) return {};
    FcCharSet* its = nullptr;
    FcChar8* file = nullptr;
    int index = 0;
    if (FcPatternGetCharSet(found.get(), FC_CHARSET, 0, &its) != FcResultMatch ||
        FcCharSetHasChar(its, character) == FcFalse ||
        FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch)
        return {};
    FcPatternGetInteger(found.get(), FC_INDEX, 0, &index);
    return FontFile{reinterpret_cast<const char*>(file), index & 0xFFFF};  // above: an instance of a variable font
}

}  // namespace elastolab
