#include "elasticity/neo_hookean.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace elastolab {

namespace {

using Eigen::Matrix3d;

/// Kirchhoff stress J sigma = mu (F F^T - I) + lambda ln J I.
Matrix3d kirchhoff(const NeoHookean& material, const Matrix3d& H, double ln_J) {
    Matrix3d tau = material.mu * (H + H.transpose() + H * H.transpose());
    tau.diagonal().array() += material.lambda * ln_J;
    return tau;
}

/// With its eigenvalues raised to `least`.
template <int n>
Eigen::Matrix<double, n, n> raised(const Eigen::Matrix<double, n, n>& A, double least) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver(A);
    return solver.eigenvectors() * solver.eigenvalues().cwiseMax(least).asDiagonal() *
           solver.eigenvectors().transpose();
}

}  // namespace

double volume_change(const Matrix3d& H) {
    const double trace = H.trace();
    return trace + 0.5 * (trace * trace - (H * H).trace()) + H.determinant();
}

double largest_stretch(const Matrix3d& H, double least) {
    const Matrix3d F = Matrix3d::Identity() + H, C = F.transpose() * F;
    const double bound = C.cwiseAbs().rowwise().sum().maxCoeff();  // of the eigenvalues of C
    if (bound <= least * least) return least;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(C, Eigen::EigenvaluesOnly);
    return std::max(least, std::sqrt(solver.eigenvalues()[2]));
}

double NeoHookean::energy(const Matrix3d& H) const {
    const double j = volume_change(H), ln_J = std::log1p(j);
    assert(j > -1.0);
    return 0.5 * mu * (H.squaredNorm() + 2.0 * (H.trace() - j) + 2.0 * (j - ln_J)) + 0.5 * lambda * ln_J * ln_J;
}

Matrix3d NeoHookean::first_piola(const Matrix3d& H) const {
    const double j = volume_change(H);
    assert(j > -1.0);
    return kirchhoff(*this, H, std::log1p(j)) * (Matrix3d::Identity() + H).inverse().transpose();
}

Matrix3d NeoHookean::cauchy(const Matrix3d& H) const {
    const double j = volume_change(H);
    assert(j > -1.0);
    return kirchhoff(*this, H, std::log1p(j)) / (1.0 + j);
}

StressNumbers cauchy_stress(const Matrix3d& gradient, const Material& material) {
    constexpr double kLeastJ = 1e-3;
    const NeoHookean law(material);
    const double j = std::max(volume_change(gradient), kLeastJ - 1.0);
    return stress_numbers(kirchhoff(law, gradient, std::log1p(j)) / (1.0 + j));
}

ElasticTensor NeoHookean::tangent(const Matrix3d& H) const {
    const Matrix3d inverse = (Matrix3d::Identity() + H).inverse();
    const double c = mu - lambda * std::log1p(volume_change(H));
    ElasticTensor A;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 3; ++l)
                    A(i + 3 * j, k + 3 * l) = mu * (i == k && j == l) + c * inverse(l, i) * inverse(j, k) +
                                              lambda * inverse(j, i) * inverse(l, k);
    return A;
}

/// In the frames of the singular vectors, F = U diag(s) V^T, the tangent falls into a 3 x 3 block of the diagonal
/// entries and a 2 x 2 block for each pair of axes.
ElasticTensor NeoHookean::projected_tangent(const Matrix3d& H) const {
    const Eigen::JacobiSVD<Matrix3d> svd(Matrix3d::Identity() + H, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Vector3d inverse = svd.singularValues().cwiseInverse();
    const double c = mu - lambda * std::log1p(volume_change(H)), least = kLeastEigenvalue * mu;
    ElasticTensor A = ElasticTensor::Zero();
    Matrix3d stretch = lambda * inverse * inverse.transpose();
    for (int i = 0; i < 3; ++i) stretch(i, i) += mu + c * inverse[i] * inverse[i];
    stretch = raised<3>(stretch, least);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) A(4 * i, 4 * k) = stretch(i, k);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < i; ++j) {
            const double off = c * inverse[i] * inverse[j];
            const double sum = std::max(mu + off, least), difference = std::max(mu - off, least);
            const int p = i + 3 * j, q = j + 3 * i;
            A(p, p) = A(q, q) = 0.5 * (sum + difference);
            A(p, q) = A(q, p) = 0.5 * (sum - difference);
        }
    // vec(U X V^T) = (V kron U) vec(X)
    ElasticTensor turn;
    for (int l = 0; l < 3; ++l)
        for (int j = 0; j < 3; ++j) turn.block<3, 3>(3 * j, 3 * l) = svd.matrixV()(j, l) * svd.matrixU();
    return turn * A * turn.transpose();
}

}  // namespace elastolab
