#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "scene/constraints.hpp"
#include "scene/motion.hpp"

namespace elastolab {

/// What the handles of a constrained set are to do.
struct Wish {
    Eigen::VectorXd values = {};       ///< as Deformer::displace takes them
    std::vector<Motion> motions = {};  ///< of every handle; `values` are where they end. Empty: not known
    std::vector<int> ends = {};        ///< where the vertices of each handle end in the list of all handles' vertices
};
Wish wish_of(const Constraints& constraints);

/// Whether they end at the same values, after the same full turns.
bool same(const Wish& a, const Wish& b);

/// What to pass on the way to an answer of a method that is not linear (Approach in deform/equilibrium.hpp).
struct Way {
    bool from_rest = true;      ///< false: from where `from` led
    Eigen::MatrixXd path = {};  ///< values to pass, one column each; they turn by no more than a quarter at a time
};
/// The way to `to` from `from`, a wish for the same set that there is an equilibrium for, or null. rest: positions of
/// the vertices of all handles. Columns only where a handle turns too far for the shortest rotation to be the one that
/// is meant.
Way way_to(const Wish& to, const Wish* from, const Positions& rest);

/// A wish on the way from one to another, such that no handle turns by much more than `degrees`; nothing where none
/// turns further, or where it cannot be told what lies between. rest: as of way_to.
std::optional<Wish> step_towards(const Wish& to, const Wish& from, double degrees, const Positions& rest);

}  // namespace elastolab
