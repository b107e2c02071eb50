#include "app/preferences.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "app/window/state_folder.hpp"
#include "base/atomic_file.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr std::array kNavigations = {"standard", "blender", "paraview", "polyscope", "trackpad"};
constexpr float kLeastScale = 0.5f, kMostScale = 4.0f;

std::filesystem::path preferences_file() {
    const std::filesystem::path folder = state_folder();
    return folder.empty() ? folder : folder / "preferences.json";
}

std::string unit_name(const nlohmann::json& file, const char* key) {
    const std::string name = one_line(file.value(key, ""));
    return name.size() <= UnitNames::kLongest ? name : "";
}

}  // namespace

Preferences load_preferences() {
    Preferences preferences;
    try {
        std::ifstream in(preferences_file());
        if (!in) return preferences;
        const nlohmann::json file = nlohmann::json::parse(in);
        const std::string navigation = file.value("navigation", kNavigations.front());
        const auto* found = std::find(kNavigations.begin(), kNavigations.end(), navigation);
        if (found != kNavigations.end()) preferences.navigation = static_cast<Navigation>(found - kNavigations.begin());
        preferences.dark = file.value("dark", true);
        preferences.ui_scale = std::clamp(file.value("size", 1.0f), kLeastScale, kMostScale);
        preferences.units = {unit_name(file, "length_unit"), unit_name(file, "force_unit")};
    } catch (const std::exception&) {  // a convenience: nothing is lost without it
    }
    return preferences;
}

void save_preferences(const Preferences& preferences) {
    const std::filesystem::path path = preferences_file();
    if (path.empty()) return;
    try {
        std::filesystem::create_directories(path.parent_path());
        AtomicFile file(path);
        file.stream() << nlohmann::json{{"navigation", kNavigations[static_cast<std::size_t>(preferences.navigation)]},
                                        {"dark", preferences.dark},
                                        {"size", preferences.ui_scale},
                                        {"length_unit", preferences.units.length},
                                        {"force_unit", preferences.units.force}}
                             .dump(2)
                      << '\n';
        file.commit();
    } catch (const std::exception&) {
    }
}

}  // namespace elastolab
