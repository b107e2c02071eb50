#include "study/error/exact_reactions.hpp"

#include <cstddef>
#include <Eigen/Geometry>

namespace elastolab {

Reactions exact_reactions(const SurfaceMesh& mesh, const std::vector<int>& constrained,
                          const std::function<Eigen::Matrix3d(const Eigen::Vector3d&)>& stress) {
    const auto n = static_cast<Eigen::Index>(constrained.size());
    Reactions reactions{Eigen::Matrix3Xd::Zero(3, n), Eigen::Matrix3Xd::Zero(3, n)};
    std::vector<int> place(static_cast<std::size_t>(mesh.n_vertices()), -1);
    for (std::size_t i = 0; i < constrained.size(); ++i)
        place[static_cast<std::size_t>(constrained[i])] = static_cast<int>(i);
    // Barycentric (2/3, 1/6, 1/6) and its turns: quadratic polynomials exactly.
    const Eigen::Matrix3d points = Eigen::Matrix3d::Constant(1.0 / 6.0) + 0.5 * Eigen::Matrix3d::Identity();
    for (const auto& triangle : mesh.triangles.colwise()) {
        Eigen::Vector3i at;
        Eigen::Matrix3d corners;
        for (int i = 0; i < 3; ++i) {
            at[i] = place[static_cast<std::size_t>(triangle[i])];
            corners.col(i) = mesh.vertices.col(triangle[i]);
        }
        if (at.minCoeff() < 0) continue;
        const Eigen::Vector3d area = 0.5 * (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
        for (const auto& weights : points.colwise()) {
            const Eigen::Vector3d x = corners * weights, force = stress(x) * area / 3.0;
            for (int i = 0; i < 3; ++i) {
                reactions.forces.col(at[i]) += weights[i] * force;
                reactions.moments.col(at[i]) += weights[i] * x.cross(force);
            }
        }
    }
    return reactions;
}

}  // namespace elastolab
