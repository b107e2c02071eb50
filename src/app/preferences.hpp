#pragma once

#include "app/input/navigation.hpp"
#include "app/unit_names.hpp"

namespace elastolab {

/// What a person sets once and finds again at the next start.
struct Preferences {
    Navigation navigation = Navigation::standard;
    bool dark = true;
    float ui_scale = 1.0f;
    UnitNames units = {};

    bool operator==(const Preferences&) const = default;
};

/// Kept in state_folder(). Reading and writing never fails loudly: what cannot be read is as at the first start.
Preferences load_preferences();
void save_preferences(const Preferences& preferences);

}  // namespace elastolab
