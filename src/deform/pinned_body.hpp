#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "deform/solid_model.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The body that a second answer is computed for. Where the constraints leave it free to move and its loads balance, it
/// is held by up to three more vertices (pins) that stand where the first answer puts them: what they bear is no more
/// than what both answers differ by. A body that is held stays as it is.
class PinnedBody {
public:
    /// positions  of the surface's vertices
    /// vertices   constrained, all different
    /// values     their displacements [L], 3*vertices.size(), then a factor for each load
    /// first      an answer: displacements [L] that begin with those of the surface's vertices
    PinnedBody(const Positions& positions, std::span<const int> vertices, const Eigen::VectorXd& values,
               const Eigen::VectorXd& first);

    /// False where not even pins hold it, and it has none: all its vertices lie on a line, but for a millionth of its
    /// size.
    bool is_held() const { return is_held_; }
    bool is_pinned() const { return n_constrained_ < std::ssize(vertices_); }
    /// Constrained vertices, then pins, and values for them.
    const std::vector<int>& vertices() const { return vertices_; }
    const Eigen::VectorXd& values() const { return values_; }

    /// The second answer of the body as given: without what the pins bear, moved as a rigid body, as far as the
    /// constraints let it, to where it is nearest to the first.
    ReferenceAnswer released(ReferenceAnswer second) const;

private:
    Positions positions_;
    Eigen::VectorXd first_;
    std::ptrdiff_t n_constrained_;
    bool is_held_ = true;
    std::vector<int> vertices_;
    Eigen::VectorXd values_;
};

}  // namespace elastolab
