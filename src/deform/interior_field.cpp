#include "deform/interior_field.hpp"

#include "base/parallel.hpp"

namespace elastolab {

BodyField::BodyField(std::shared_ptr<const SurfaceMesh> surface, std::vector<int> part_of_triangle,
                     std::vector<Part> parts, double young_modulus, Eigen::Index n_solutions)
    : surface_(std::move(surface)),
      part_of_triangle_(std::move(part_of_triangle)),
      parts_(std::move(parts)),
      young_modulus_(young_modulus),
      n_solutions_(n_solutions) {}

std::vector<std::vector<Eigen::Index>> BodyField::by_part(const Positions& points, Control& control) const {
    std::vector<std::vector<Eigen::Index>> result(parts_.size());
    std::vector<int> part(static_cast<std::size_t>(points.cols()), 0);
    if (parts_.size() > 1) {
        const ClosestPoint closest(*surface_);
        parallel_blocks(static_cast<int>(points.cols()), 64, control, [&](int begin, int end) {
            for (int i = begin; i < end; ++i)
                part[static_cast<std::size_t>(i)] =
                    part_of_triangle_[static_cast<std::size_t>(closest(points.col(i)).triangle)];
        });
    }
    for (std::size_t i = 0; i < part.size(); ++i)
        result[static_cast<std::size_t>(part[i])].push_back(static_cast<Eigen::Index>(i));
    return result;
}

InteriorValues BodyField::at(const Positions& points, Control& control) const {
    InteriorValues all{Eigen::MatrixXd::Zero(3 * points.cols(), n_solutions_),
                       Eigen::MatrixXd::Zero(6 * points.cols(), n_solutions_)};
    const std::vector<std::vector<Eigen::Index>> members = by_part(points, control);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        const Part& part = parts_[p];
        if (!part.field || members[p].empty()) continue;
        const Positions own = part.scale * (points(Eigen::all, members[p]).colwise() - part.origin);
        const InteriorValues values = part.field->at(own, control);
        // The solid's coordinates are those of the body times a factor; most displacements are not, so that their
        // gradients are too small.
        const double length = part.scaled_displacements ? 1.0 / part.scale : 1.0;
        const double unit = young_modulus_ * part.scale * length;
        for (std::size_t i = 0; i < members[p].size(); ++i) {
            const auto k = static_cast<Eigen::Index>(i);
            all.displacements.middleRows<3>(3 * members[p][i]) = length * values.displacements.middleRows<3>(3 * k);
            all.stresses.middleRows<6>(6 * members[p][i]) = unit * values.stresses.middleRows<6>(6 * k);
        }
    }
    return all;
}

}  // namespace elastolab
