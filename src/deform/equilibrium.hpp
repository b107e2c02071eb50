#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace elastolab {

/// What is known of an equilibrium of large deformations.
struct EquilibriumFacts {
    int iterations = 0;            ///< steps of Newton's method on the way to it; tangents factorised for predictions
    double energy = 0.0;           ///< stored in the body [force * L]
    double work_of_loads = 0.0;    ///< of the present loads along the straight way from rest [force * L]
    double largest_stretch = 1.0;  ///< largest ratio of a length after and before, in any element
    bool stable = true;            ///< false: a small push would make the body leave it
};

/// A state of one solid from which others are found. Made and understood by its NodeSolver alone; immutable.
class NodeState {
public:
    virtual ~NodeState() = default;
    /// In the solid's coordinates, for unit Young's modulus.
    virtual EquilibriumFacts facts() const = 0;
    /// The same, to begin from with another constrained set of the same model.
    virtual std::shared_ptr<const NodeState> for_another_set() const = 0;
};

/// An equilibrium of a Deformer, for methods that are not linear in the prescribed values (MethodTraits::linear).
/// It belongs to the deformer's constrained set.
struct Equilibrium {
    Eigen::VectorXd values;                                ///< as Deformer::displace takes them
    std::vector<std::shared_ptr<const NodeState>> solids;  ///< one for each part of the model; null: it rests
};
/// Where to begin with another constrained set of the same model under the same loads: Approach::start of its deformer.
std::shared_ptr<const Equilibrium> for_another_set(const Equilibrium& equilibrium);

/// What any equilibrium that is found takes less than.
inline constexpr int kMostEquilibriumSteps = 400;

/// Where to begin, and what to pass on the way: it makes an answer faster, and where there are several equilibria for
/// the same values (a bar turned twice about its axis prescribes what one at rest does) it decides which one is found.
/// Linear methods ignore it.
struct Approach {
    /// An equilibrium of the same deformer, or for_another_set() of another's; null: the body at rest.
    std::shared_ptr<const Equilibrium> start = nullptr;
    /// Values to pass, one column each, in their order, before those that are asked for: as many as it takes to tell
    /// motions of more than half a turn apart. No columns: the shortest rotation of each handle.
    Eigen::MatrixXd path = {};
    /// Steps of Newton's method from one of these values to the next, after which there is no equilibrium.
    int most_steps = kMostEquilibriumSteps;
};

/// No equilibrium was found for the prescribed values.
class NoEquilibriumError : public SolveError {
public:
    /// place: where the body is crushed; in a solid's coordinates until the Deformer has turned it into the body's.
    NoEquilibriumError(const std::string& message, const Eigen::Vector3d& place) : SolveError(message), place_(place) {}
    const Eigen::Vector3d& place() const { return place_; }

private:
    Eigen::Vector3d place_;
};

}  // namespace elastolab
