#pragma once

#include <Eigen/Core>

#include "elasticity/material.hpp"
#include "elasticity/stress.hpp"

namespace elastolab {

/// Second derivatives of the energy: entry (i + 3 j, k + 3 l) is dP_ij / dF_kl.
using ElasticTensor = Eigen::Matrix<double, 9, 9>;

/// Compressible neo-Hookean material that agrees with Hooke's law for small strains, nu < 1/2:
///   psi(F) = mu/2 (F:F - 3) - mu ln J + lambda/2 (ln J)^2,    J = det F > 0
/// Every function takes the displacement gradient H = F - I, du_i / dX_j, so that nothing is lost for small strains;
/// J > 0 is asserted. Source: docs/formulation.md, large deformations.
struct NeoHookean {
    double mu = 0.0, lambda = 0.0;  ///< Lame's constants [force / L^2]

    explicit NeoHookean(const Material& material) : mu(material.shear_modulus()), lambda(material.lame_lambda()) {}

    /// psi, energy per rest volume [force / L^2].
    double energy(const Eigen::Matrix3d& H) const;
    /// First Piola-Kirchhoff stress P = d psi / dF: force on the body per rest area.
    Eigen::Matrix3d first_piola(const Eigen::Matrix3d& H) const;
    /// Cauchy stress P F^T / J: force per present area, in world axes.
    Eigen::Matrix3d cauchy(const Eigen::Matrix3d& H) const;
    ElasticTensor tangent(const Eigen::Matrix3d& H) const;
    /// The tangent with its eigenvalues raised to at least kLeastEigenvalue * mu: positive definite.
    ElasticTensor projected_tangent(const Eigen::Matrix3d& H) const;
};

inline constexpr double kLeastEigenvalue = 1e-3;

/// Cauchy stress from the gradient of the displacement (du_i / dX_j), the largest of its kind where the material is
/// turned inside out, so that it stays finite.
StressNumbers cauchy_stress(const Eigen::Matrix3d& gradient, const Material& material);

/// Hooke's stress, or Cauchy's of large deformations.
inline StressNumbers stress_of(const Eigen::Matrix3d& gradient, const Material& material, bool large_deformations) {
    return large_deformations ? cauchy_stress(gradient, material) : hooke(gradient, material);
}

/// J - 1 = det(I + H) - 1, without cancellation for small H.
double volume_change(const Eigen::Matrix3d& H);
/// Largest singular value of I + H, the largest ratio of a length after and before; or `least`, where that is more.
double largest_stretch(const Eigen::Matrix3d& H, double least = 0.0);

}  // namespace elastolab
