#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "deform/deformer.hpp"
#include "deform/model.hpp"

namespace elastolab {

/// A body, what is held and pulled, and how far: degrees, or per cent of its length.
struct LargeScene {
    Body body;
    ConstrainedSet set;
    std::function<Eigen::VectorXd(double amount)> values;
};

/// Motions of one kind by any amount.
struct LargeMotion {
    std::string name, what, unit;
    /// cells: across a bar of 4 x 1 x 1; for the rabbit it decides how many vertices there are.
    LargeScene (*make)(int cells);
    bool is_bar = true;
};

/// A bar twisted, bent along a circle, and stretched; the ear of the rabbit turned.
const std::vector<LargeMotion>& large_motions();

}  // namespace elastolab
