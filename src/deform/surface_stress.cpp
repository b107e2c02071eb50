#include "deform/surface_stress.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>
#include <vector>

#include "deform/triangle_tractions.hpp"
#include "elasticity/neo_hookean.hpp"

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

Eigen::Matrix3d small_stress(const Material& material, const TriangleStrain& at, const Eigen::Vector3d& traction) {
    return at.axes * stress(material, at.small(), at.axes.transpose() * traction) * at.axes.transpose();
}

/// The displacement's derivative d along the normal N makes P N the traction: Newton's method on the energy, which is
/// convex in d as long as J < exp(1 + mu / lambda); steps are halved where they would turn the material inside out.
/// traction: per rest area.
Eigen::Matrix3d large_stress(const Material& material, const TriangleStrain& at, const Eigen::Vector3d& traction) {
    constexpr int kIterations = 30, kHalvings = 40;
    constexpr double kTolerance = 1e-12;
    const NeoHookean law(material);
    const Eigen::Vector3d N = at.axes.col(2);
    const Eigen::Matrix3d in_plane = at.gradient * at.axes.leftCols<2>().transpose();
    const auto gradient = [&](const Eigen::Vector3d& d) -> Eigen::Matrix3d { return in_plane + d * N.transpose(); };
    const auto potential = [&](const Eigen::Vector3d& d) {
        return volume_change(gradient(d)) > -1.0 ? law.energy(gradient(d)) - traction.dot(d)
                                                 : std::numeric_limits<double>::infinity();
    };
    // The present normal, as long as the area's change lets the volume stay.
    const Eigen::Matrix<double, 3, 2> edges = at.axes.leftCols<2>() + at.gradient;
    const Eigen::Vector3d cross = edges.col(0).cross(edges.col(1));
    if (!(cross.norm() > 0.0)) return Eigen::Matrix3d::Zero();
    Eigen::Vector3d d = cross / cross.squaredNorm() - N;
    for (int i = 0; i < kIterations; ++i) {
        const Eigen::Vector3d force = law.first_piola(gradient(d)) * N - traction;
        if (force.stableNorm() <= kTolerance * law.mu) break;
        const ElasticTensor A = law.tangent(gradient(d));
        Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
        for (int j = 0; j < 3; ++j)
            for (int l = 0; l < 3; ++l) K += N[j] * N[l] * A.block<3, 3>(3 * j, 3 * l);
        Eigen::Vector3d step = -K.ldlt().solve(force);
        if (!(step.dot(force) < 0.0)) step = -force / law.mu;
        const double before = potential(d);
        for (int h = 0; h < kHalvings && !(potential(d + step) <= before); ++h) step *= 0.5;
        d += step;
    }
    return stress_tensor(cauchy_stress(gradient(d), material));
}

/// each(corners, weight, stress in world axes) for every triangle; weight: its rest area.
template <class Each>
void for_triangle_stresses(const SurfaceMesh& surface, const Material& material, const Eigen::VectorXd& u,
                           const Eigen::Matrix3Xd& tractions, bool large, const Eigen::Matrix3Xd& of_loads,
                           const Each& each) {
    const Eigen::Map<const Eigen::Matrix3Xd> moved(u.data(), 3, u.size() / 3);
    const std::vector<TriangleStrain> strains = triangle_strains(surface, moved);
    Eigen::Matrix3Xd on_triangles = triangle_tractions(surface, material, strains, tractions, large);
    if (of_loads.cols() > 0) on_triangles += of_loads;
    for (Eigen::Index k = 0; k < surface.triangles.cols(); ++k) {
        const TriangleStrain& at = strains[static_cast<std::size_t>(k)];
        const Eigen::Vector3d traction = on_triangles.col(k);
        each(surface.triangles.col(k), at.area,
             large ? large_stress(material, at, traction) : small_stress(material, at, traction));
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

Eigen::Matrix3Xd load_tractions(const SurfaceMesh& surface, std::span<const UnitLoad> loads,
                                const Eigen::VectorXd& factors, const Eigen::VectorXd& u) {
    if (loads.empty()) return {};
    const auto cross = [](const Positions& x, const Eigen::Vector3i& t) -> Eigen::Vector3d {
        return (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0]));
    };
    const Positions present = u.size() > 0 ? Positions(surface.vertices + u.reshaped(3, u.size() / 3)) : Positions();
    // -p n of a pressure, on the present area over that at rest.
    const auto follow = [&](const Eigen::Vector3d& traction, const Eigen::Vector3i& t) -> Eigen::Vector3d {
        const Eigen::Vector3d rest = cross(surface.vertices, t);
        return traction.dot(rest) / rest.squaredNorm() * cross(present, t);
    };
    Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, surface.n_triangles());
    for (std::size_t i = 0; i < loads.size(); ++i)
        for (std::size_t k = 0; k < loads[i].triangles.size(); ++k)
            tractions.col(loads[i].triangles[k]) +=
                factors[static_cast<Eigen::Index>(i)] *
                (loads[i].follows && u.size() > 0
                     ? follow(loads[i].tractions.col(static_cast<Eigen::Index>(k)),
                              surface.triangles.col(loads[i].triangles[k]))
                     : Eigen::Vector3d(loads[i].tractions.col(static_cast<Eigen::Index>(k))));
    return tractions;
}

Eigen::VectorXd surface_stress_measure(StressMeasure which, const SurfaceMesh& surface, const Material& material,
                                       const Eigen::VectorXd& u, const Eigen::Matrix3Xd& tractions,
                                       bool large_deformations, const Eigen::Matrix3Xd& of_loads) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(surface.n_vertices()), areas = sums;
    for_triangle_stresses(surface, material, u, tractions, large_deformations, of_loads,
                          [&](const Eigen::Vector3i& t, double weight, const Eigen::Matrix3d& sigma) {
                              sums(t).array() += weight * measure(which, sigma);
                              areas(t).array() += weight;
                          });
    return sums.cwiseQuotient(areas);
}

Eigen::MatrixXd surface_stress(const SurfaceMesh& surface, const Material& material, const Eigen::VectorXd& u,
                               const Eigen::Matrix3Xd& tractions, bool large_deformations,
                               const Eigen::Matrix3Xd& of_loads) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(6, surface.n_vertices());
    Eigen::RowVectorXd areas = Eigen::RowVectorXd::Zero(surface.n_vertices());
    for_triangle_stresses(surface, material, u, tractions, large_deformations, of_loads,
                          [&](const Eigen::Vector3i& t, double weight, const Eigen::Matrix3d& sigma) {
                              for (const int v : t) {
                                  sums.col(v) += weight * stress_numbers(sigma);
                                  areas[v] += weight;
                              }
                          });
    return sums.array().rowwise() / areas.array();
}

}  // namespace elastolab
