#include "deform/surface_stress.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <vector>

namespace elastolab {

namespace {

double area(const SurfaceMesh& surface, Eigen::Index triangle) {
    const Eigen::Vector3i t = surface.triangles.col(triangle);
    const Positions& x = surface.vertices;
    return 0.5 * (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0])).norm();
}

/// Adds a third of the area of every triangle that `counts` to its corners.
template <class Counts>
Eigen::VectorXd vertex_areas(const SurfaceMesh& surface, const Counts& counts) {
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(surface.n_vertices());
    for (Eigen::Index k = 0; k < surface.triangles.cols(); ++k) {
        const Eigen::Vector3i t = surface.triangles.col(k);
        if (counts(t)) areas(t).array() += area(surface, k) / 3.0;
    }
    return areas;
}

/// Orthonormal axes of a triangle: two in its plane, then its normal.
Eigen::Matrix3d triangle_axes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    Eigen::Matrix3d axes;
    axes.col(0) = a.normalized();
    axes.col(2) = a.cross(b).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
}

/// Stress from the strain within a plane and the traction on it (in axes whose third is the normal). Finite at nu =
/// 1/2.
Eigen::Matrix3d stress(const Material& material, const Eigen::Matrix2d& strain, const Eigen::Vector3d& traction) {
    const double mu = material.shear_modulus(), nu = material.poisson_ratio;
    Eigen::Matrix3d sigma;
    const double axial = 2.0 * mu / (1.0 - nu), pressed = nu / (1.0 - nu) * traction.z();
    sigma(0, 0) = axial * (strain(0, 0) + nu * strain(1, 1)) + pressed;
    sigma(1, 1) = axial * (strain(1, 1) + nu * strain(0, 0)) + pressed;
    sigma(0, 1) = sigma(1, 0) = 2.0 * mu * strain(0, 1);
    sigma.col(2) = traction;
    sigma.row(2) = traction.transpose();
    return sigma;
}

/// each(corners, area, axes, stress in these axes) for every triangle.
template <class Each>
void for_triangle_stresses(const SurfaceMesh& surface, const Material& material, const Eigen::VectorXd& u,
                           const Eigen::Matrix3Xd& tractions, const Each& each) {
    const Eigen::Map<const Eigen::Matrix3Xd> moved(u.data(), 3, u.size() / 3);
    for (Eigen::Index k = 0; k < surface.triangles.cols(); ++k) {
        const Eigen::Vector3i t = surface.triangles.col(k);
        const Eigen::Vector3d a = surface.vertices.col(t[1]) - surface.vertices.col(t[0]);
        const Eigen::Vector3d b = surface.vertices.col(t[2]) - surface.vertices.col(t[0]);
        const Eigen::Matrix3d axes = triangle_axes(a, b);
        Eigen::Matrix<double, 3, 2> edges, changes;
        edges << a, b;
        changes << moved.col(t[1]) - moved.col(t[0]), moved.col(t[2]) - moved.col(t[0]);
        const Eigen::Matrix<double, 3, 2> plane = axes.leftCols<2>();
        const Eigen::Matrix2d gradient = (plane.transpose() * changes) * (plane.transpose() * edges).inverse();
        const Eigen::Matrix3d at_corners = tractions(Eigen::all, t);
        const bool loaded = (at_corners.colwise().squaredNorm().array() > 0.0).all();
        const Eigen::Vector3d traction =
            loaded ? Eigen::Vector3d(axes.transpose() * at_corners.rowwise().mean()) : Eigen::Vector3d(0, 0, 0);
        const Eigen::Matrix2d strain = 0.5 * (gradient + gradient.transpose());
        each(t, 0.5 * a.cross(b).norm(), axes, stress(material, strain, traction));
    }
}

}  // namespace

Eigen::Matrix3Xd vertex_tractions(const SurfaceMesh& surface, std::span<const int> constrained,
                                  const Eigen::Matrix3Xd& forces) {
    std::vector<char> is_constrained(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const int v : constrained) is_constrained[static_cast<std::size_t>(v)] = 1;
    const auto all_constrained = [&](const Eigen::Vector3i& t) {
        return is_constrained[static_cast<std::size_t>(t[0])] && is_constrained[static_cast<std::size_t>(t[1])] &&
               is_constrained[static_cast<std::size_t>(t[2])];
    };
    const Eigen::VectorXd own = vertex_areas(surface, all_constrained);
    const Eigen::VectorXd around = vertex_areas(surface, [](const Eigen::Vector3i&) { return true; });
    Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, surface.n_vertices());
    for (std::size_t i = 0; i < constrained.size(); ++i) {
        const int v = constrained[i];
        tractions.col(v) = forces.col(static_cast<Eigen::Index>(i)) / (own[v] > 0.0 ? own[v] : around[v]);
    }
    return tractions;
}

Eigen::VectorXd surface_stress_measure(StressMeasure which, const SurfaceMesh& surface, const Material& material,
                                       const Eigen::VectorXd& u, const Eigen::Matrix3Xd& tractions) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(surface.n_vertices()), areas = sums;
    for_triangle_stresses(
        surface, material, u, tractions,
        [&](const Eigen::Vector3i& t, double weight, const Eigen::Matrix3d& axes, const Eigen::Matrix3d& local) {
            sums(t).array() += weight * measure(which, axes * local * axes.transpose());
            areas(t).array() += weight;
        });
    return sums.cwiseQuotient(areas);
}

Eigen::MatrixXd surface_stress(const SurfaceMesh& surface, const Material& material, const Eigen::VectorXd& u,
                               const Eigen::Matrix3Xd& tractions) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(6, surface.n_vertices());
    Eigen::RowVectorXd areas = Eigen::RowVectorXd::Zero(surface.n_vertices());
    for_triangle_stresses(
        surface, material, u, tractions,
        [&](const Eigen::Vector3i& t, double weight, const Eigen::Matrix3d& axes, const Eigen::Matrix3d& local) {
            const Eigen::Matrix3d sigma = axes * local * axes.transpose();
            for (const int v : t) {
                sums.col(v) += weight * stress_numbers(sigma);
                areas[v] += weight;
            }
        });
    return sums.array().rowwise() / areas.array();
}

}  // namespace elastolab
