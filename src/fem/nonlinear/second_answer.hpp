#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "deform/solid_model.hpp"
#include "fem/nonlinear/mesh.hpp"
#include "fem/nonlinear/newton.hpp"

namespace elastolab {

/// An answer of nonlinear FEM that is to be judged.
struct JudgedAnswer {
    const NonlinearMesh& mesh;
    const Newton& newton;              ///< that found it
    const std::vector<int>& vertices;  ///< constrained, all different
    const Eigen::VectorXd& values;     ///< as PinnedBody takes them
    std::span<const UnitLoad> loads;
    const NodeSolution& solution;
    bool fits = true;  ///< memory suffices for a better answer; without, ten nodes are judged by four
};

/// A second, better answer. Of ten-node elements: the same with all edges halved (halved_answer). Where that says
/// nothing, beyond a Poisson's ratio of 0.45: what it says of the body with that ratio and the same constraints; below:
/// four nodes, which are worse by as much as linear theory has it. Of four-node elements: ten nodes. A body
/// that is free to move is pinned (deform/pinned_body.hpp). Nothing where none is found.
/// Throws SolveError, Cancelled.
std::optional<ReferenceAnswer> second_answer(const JudgedAnswer& judged, Control& control);

}  // namespace elastolab
