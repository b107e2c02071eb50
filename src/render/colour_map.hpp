#pragma once

#include <array>
#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/colour.hpp"

namespace elastolab {

/// A perceptually uniform colour map: in OKLab its lightness is linear (in each half, of a diverging one) and equal
/// steps of t are equal steps of colour. Computed from a few hues, not from a table.
class ColourMap {
public:
    static constexpr int kEntries = 256;

    /// A smooth curve through these (a, b) points of OKLab, run through at even speed while the lightness goes evenly
    /// from `dark` to `light`.
    static ColourMap sequential(std::string name, double dark, double light, std::span<const Eigen::Vector2d> hues);
    /// From `low` at t = 0 through a neutral grey of lightness `light` to `high`; both (a, b) at lightness `dark`.
    static ColourMap diverging(std::string name, double dark, double light, const Eigen::Vector2d& low,
                               const Eigen::Vector2d& high);

    const std::string& name() const { return name_; }
    bool is_diverging() const { return is_diverging_; }
    /// t in [0, 1]; values outside take the colour of the nearer end.
    Colour sample(double t) const;
    /// Samples at i / 255.
    const std::array<Colour, kEntries>& table() const { return table_; }

private:
    std::string name_;
    bool is_diverging_ = false;
    std::array<Colour, kEntries> table_;
};

/// All maps, the default one first: "lagoon" (dark violet, teal, yellow), "ember" (dark plum, red, pale yellow),
/// "slate" (grey), "balance" (blue, white, red; for signed values).
std::span<const ColourMap> colour_maps();
/// Throws Error, listing the names, when there is none of this name.
const ColourMap& colour_map(std::string_view name);

}  // namespace elastolab
