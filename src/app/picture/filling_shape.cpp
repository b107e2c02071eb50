#include "app/picture/filling_shape.hpp"

#include <algorithm>
#include <cassert>

namespace elastolab {

FillingShape::FillingShape(const Proxy& filled) : surface_(filled.surface) {
    assert(filled.is_filled());
    // Those of the shown surface come first.
    triangles_ = surface_->triangles.rightCols(surface_->n_triangles() - filled.shown->n_triangles());
    vertices_.assign(triangles_.data(), triangles_.data() + triangles_.size());
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (int& vertex : triangles_.reshaped())
        vertex = static_cast<int>(std::lower_bound(vertices_.begin(), vertices_.end(), vertex) - vertices_.begin());
    rest_ = surface_->vertices(Eigen::all, vertices_);
}

Positions FillingShape::displaced(const Eigen::VectorXd& of_surface, double scale) const {
    const Eigen::Map<const Eigen::Matrix3Xd> u(of_surface.data(), 3, of_surface.size() / 3);
    return rest_ + scale * u(Eigen::all, vertices_);
}

}  // namespace elastolab
