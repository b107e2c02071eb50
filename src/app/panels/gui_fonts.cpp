#include "app/panels/gui_fonts.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr float kFontSize = 15.0f, kLargeFontSize = 20.0f;
constexpr std::size_t kMostOthers = 2000;  ///< characters beside our own, whose glyphs must fit into a texture

/// Latin, Greek, and the punctuation, arrows and mathematical signs that the panels use.
constexpr std::array<ImWchar, 11> kOwnCharacters = {0x0020, 0x00FF, 0x0370, 0x03FF, 0x2010, 0x2044,
                                                    0x2070, 0x209C, 0x2190, 0x22FF, 0};

bool is_own(char32_t character) {
    for (std::size_t i = 0; i + 1 < kOwnCharacters.size(); i += 2)
        if (character >= kOwnCharacters[i] && character <= kOwnCharacters[i + 1]) return true;
    return false;
}

}  // namespace

void GuiFonts::set_scale(float scale) {
    if (scale == scale_) return;
    scale_ = scale;
    load_fonts();
}

void GuiFonts::want_characters(std::string_view text) {
    const bool is_ascii =
        std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    if (is_ascii) return;
    for (const char32_t character : characters_of(text)) want_character(character);
}

void GuiFonts::want_character(char32_t character) {
    constexpr char32_t kFirstPrinted = 0x20;
    if (character >= kFirstPrinted && !is_own(character) && character <= IM_UNICODE_CODEPOINT_MAX &&
        others_.size() < kMostOthers && others_.emplace(character, std::nullopt).second)
        wanted_.push_back(character);
}

void GuiFonts::add_wanted_characters() {
    bool found = false;
    for (const char32_t character : std::exchange(wanted_, {})) {
        std::optional<FontFile>& font = others_[character] = font_with(character);
        found = found || font;
    }
    if (found) load_fonts();
}

void GuiFonts::load_fonts() {
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    ranges_.clear();
    // On screens whose logical pixels are larger than the physical ones the glyphs are made at physical size.
    const float density = std::max(
        1.0f, static_cast<float>(window_.framebuffer_size().x()) / static_cast<float>(std::max(1, window_.size().x())));
    fonts_.regular = load_font(regular_font(), kFontSize * scale_ * density);
    fonts_.bold = load_font(bold_font(), kFontSize * scale_ * density);
    fonts_.large = load_font(bold_font(), kLargeFontSize * scale_ * density);
    io.FontGlobalScale = 1.0f / density;
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

/// With the characters of other scripts, each from a font that has it; ImGui's own bitmap font when there is none.
ImFont* GuiFonts::load_font(const std::optional<std::filesystem::path>& file, float size) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    ImFont* const font = file
                             ? atlas.AddFontFromFileTTF(file->c_str(), std::round(size), nullptr, kOwnCharacters.data())
                             : atlas.AddFontDefault();
    std::vector<std::pair<FontFile, std::vector<ImWchar>>> by_font;
    for (const auto& [character, its] : others_) {
        if (!its) continue;
        const FontFile& its_file = *its;
        auto found =
            std::find_if(by_font.begin(), by_font.end(), [&](const auto& entry) { return entry.first == its_file; });
        if (found == by_font.end()) found = by_font.insert(found, {its_file, {}});
        found->second.insert(found->second.end(), 2, static_cast<ImWchar>(character));  // a range of one
    }
    for (auto& [other, ranges] : by_font) {
        ImFontConfig config;
        config.MergeMode = true;
        config.FontNo = other.index;
        ranges.push_back(0);
        ranges_.push_back(std::move(ranges));  // ImGui reads them when it makes the texture
        atlas.AddFontFromFileTTF(other.path.c_str(), std::round(size), &config, ranges_.back().data());
    }
    return font;
}

}  // namespace elastolab
