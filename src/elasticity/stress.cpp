#include "elasticity/stress.hpp"

#include <cmath>
#include <Eigen/Eigenvalues>

namespace elastolab {

namespace {

double von_mises(const Eigen::Matrix3d& stress) {
    // Squares of large stresses are beyond double precision.
    const double scale = stress.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (scale == 0.0) return 0.0;
    const Eigen::Matrix3d s = stress / scale;
    const double axial =
        std::pow(s(0, 0) - s(1, 1), 2) + std::pow(s(1, 1) - s(2, 2), 2) + std::pow(s(2, 2) - s(0, 0), 2);
    const double shear = std::pow(s(0, 1), 2) + std::pow(s(1, 2), 2) + std::pow(s(0, 2), 2);
    return scale * std::sqrt(0.5 * axial + 3.0 * shear);
}

/// Ascending. An iteration, not the closed form: that loses half the digits of equal eigenvalues.
Eigen::Vector3d principal_stresses(const Eigen::Matrix3d& stress) {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace

StressNumbers stress_numbers(const Eigen::Matrix3d& s) {
    return (StressNumbers() << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)).finished();
}

Eigen::Matrix3d stress_tensor(const Eigen::Ref<const StressNumbers>& s) {
    return (Eigen::Matrix3d() << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]).finished();
}

StressNumbers hooke(const Eigen::Matrix3d& gradient, const Material& material) {
    const double mu = material.shear_modulus(), nu = material.poisson_ratio;
    const double volumetric = nu < 0.5 ? 2.0 * mu * nu / (1.0 - 2.0 * nu) * gradient.trace() : 0.0;
    return stress_numbers(mu * (gradient + gradient.transpose()) + volumetric * Eigen::Matrix3d::Identity());
}

double measure(StressMeasure which, const Eigen::Matrix3d& stress) {
    switch (which) {
        case StressMeasure::von_mises:
            return von_mises(stress);
        case StressMeasure::first_principal:
            return principal_stresses(stress)[2];
        case StressMeasure::third_principal:
            return principal_stresses(stress)[0];
        default:
            return stress_numbers(stress)[static_cast<int>(which) - static_cast<int>(StressMeasure::xx)];
    }
}

}  // namespace elastolab
