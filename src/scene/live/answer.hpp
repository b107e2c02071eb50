#pragma once

#include <cstdint>
#include <Eigen/Core>

#include "deform/finding.hpp"
#include "scene/constraints.hpp"

namespace elastolab {

/// Displacements of the shown vertices for constraints that change while a person edits: what a frame asks for,
/// whoever answers (a method's model, or a coarse preview of it). All members are for one thread.
class Answer {
public:
    virtual ~Answer() = default;

    /// Asks for the displacements under these constraints.
    virtual void set_constraints(const Constraints& constraints) = 0;
    /// Once per frame: takes over what workers finished, starts what is due and brings the displacements up to date.
    virtual void poll() = 0;

    /// Whether displacement() is of the present body and not just zero.
    virtual bool has_answer() const = 0;
    /// 3*n_vertices [L]; zero until the first answer. version() grows with every change.
    virtual const Eigen::VectorXd& displacement() const = 0;
    virtual std::uint64_t version() const = 0;
    /// What the person should know of the answer, as far as it is known by now.
    virtual Findings findings() const = 0;
};

}  // namespace elastolab
