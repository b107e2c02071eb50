#pragma once

#include <array>
#include <string>
#include <string_view>

#include "app/settings.hpp"

namespace elastolab {

/// For headings: the name of a method with a capital ("Linear BEM"), made from its name in scene files.
std::string title(MethodKind kind);

/// `text` with every method called as on its button: "Choose Galerkin BEM or FEM." for "Choose galerkin-bem or fem.".
/// Parts of longer words ("fem.obj", "my-fem") stay.
std::string with_titles(std::string text);

/// "displacement", "difference to linear-bem", ... and its unit in words.
std::string field_title(Field field, MethodKind reference, const UnitNames& units = {});
/// What stands behind a value of a field (UnitNames::after_length); of none, behind a displacement.
std::string after_value(Field field, const UnitNames& units);

/// What a worker is doing, for people, from the name of the stage in reports ("tetrahedralize": "making tetrahedra").
std::string stage_words(std::string_view stage);

/// An entry of a list of choices: its label, and what choosing it means, in physical terms.
template <class Value>
struct Choice {
    Value value;
    const char* label;
    const char* explanation;
};

}  // namespace elastolab
