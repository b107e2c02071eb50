#pragma once

#include <string>

namespace elastolab {

/// What a person calls the units of the meshes and forces at hand, for what is shown: the program computes in whatever
/// they are. Empty: not named.
struct UnitNames {
    std::string length = {}, force = {};  ///< at most kLongest bytes

    static constexpr std::size_t kLongest = 12;

    /// "mm", "mesh units".
    std::string of_length() const { return length.empty() ? "mesh units" : length; }
    /// "N/mm\u00b2", "force / unit\u00b2".
    std::string of_stress() const;
    /// " N", " N mm", " N/mm\u00b2" behind a number; nothing where a unit has no name.
    std::string after_length() const { return length.empty() ? "" : " " + length; }
    std::string after_force() const { return force.empty() ? "" : " " + force; }
    std::string after_moment() const { return force.empty() || length.empty() ? "" : " " + force + " " + length; }
    std::string after_stress() const { return force.empty() || length.empty() ? "" : " " + of_stress(); }

    bool operator==(const UnitNames&) const = default;
};

inline std::string UnitNames::of_stress() const {
    if (force.empty() && length.empty()) return "force / unit\u00b2";
    return (force.empty() ? "force" : force) + "/" + (length.empty() ? "unit" : length) + "\u00b2";
}

}  // namespace elastolab
