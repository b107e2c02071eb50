#include "fem/stiffness_product.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "base/parallel.hpp"

namespace elastolab {

namespace {

/// Points of the rule of four points, of second degree, and the slopes of the ten shapes at each: side by side.
Eigen::Matrix<double, 10, 16> slopes_at_points() {
    const double near = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0, far = (5.0 - std::sqrt(5.0)) / 20.0;
    Eigen::Matrix<double, 10, 16> slopes;
    for (int p = 0; p < 4; ++p) {
        Eigen::Vector4d at = Eigen::Vector4d::Constant(far);
        at[p] = near;
        slopes.middleCols<4>(4 * p) = quadratic_slopes(at);
    }
    return slopes;
}

/// Sums over elements are made in so many parts, each by one thread.
constexpr int kSums = 8;

}  // namespace

StiffnessProduct::StiffnessProduct(const QuadraticMesh& mesh, const Material& material)
    : mesh_(mesh), lambda_(material.lame_lambda()), mu_(material.shear_modulus()) {
    assert(material.poisson_ratio < 0.5);
    for (Eigen::Index t = 0; t < mesh.elements.cols(); ++t) {
        const Eigen::Vector4i corners = mesh.elements.col(t).head<4>();
        elements_.push_back(make_element(mesh.positions(Eigen::all, corners), t));
    }
}

Eigen::VectorXd StiffnessProduct::operator()(const Eigen::VectorXd& u) const {
    // Each kept so that its columns are along the sums' results.
    const Eigen::Matrix<double, 10, 16> slopes = slopes_at_points();
    const Eigen::Matrix<double, 16, 10> transposed = slopes.transpose();
    const Eigen::Map<const Eigen::Matrix3Xd> displacement(u.data(), 3, mesh_.n_nodes());
    const auto n = static_cast<int>(elements_.size());
    std::array<Eigen::Matrix3Xd, kSums> sums;
    Control control;
    parallel_blocks(kSums, 1, control, [&](int part, int) {
        Eigen::Matrix3Xd& f = sums[static_cast<std::size_t>(part)];
        f = Eigen::Matrix3Xd::Zero(3, mesh_.n_nodes());
        for (int t = static_cast<int>(std::int64_t{n} * part / kSums),
                 end = static_cast<int>(std::int64_t{n} * (part + 1) / kSums);
             t < end; ++t) {
            const TetElement& element = elements_[static_cast<std::size_t>(t)];
            Eigen::Matrix<double, 10, 3> own;
            for (int a = 0; a < 10; ++a) own.row(a) = displacement.col(mesh_.elements(a, t));
            Eigen::Matrix<double, 16, 3> along = transposed.lazyProduct(own);  // the barycentric coordinates
            for (int p = 0; p < 4; ++p) {
                const Eigen::Matrix3d H = element.gradients * along.middleRows<4>(4 * p);
                Eigen::Matrix3d sigma = mu_ * (H + H.transpose());
                sigma.diagonal().array() += lambda_ * H.trace();
                along.middleRows<4>(4 * p) = element.gradients.transpose() * (0.25 * element.volume * sigma);
            }
            own = slopes.lazyProduct(along);
            for (int a = 0; a < 10; ++a) f.col(mesh_.elements(a, t)) += own.row(a);
        }
    });
    for (int part = 1; part < kSums; ++part) sums[0] += sums[static_cast<std::size_t>(part)];
    return sums[0].reshaped();
}

Eigen::Matrix3Xd StiffnessProduct::diagonal() const {
    const Eigen::Matrix<double, 10, 16> slopes = slopes_at_points();
    Eigen::Matrix3Xd blocks = Eigen::Matrix3Xd::Zero(3, 3 * Eigen::Index{mesh_.n_nodes()});
    for (std::size_t t = 0; t < elements_.size(); ++t) {
        const TetElement& element = elements_[t];
        for (int a = 0; a < 10; ++a) {
            Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
            for (int p = 0; p < 4; ++p) {
                const Eigen::Vector3d g = element.gradients * slopes.block<1, 4>(a, 4 * p).transpose();
                block += (lambda_ + mu_) * g * g.transpose();
                block.diagonal().array() += mu_ * g.squaredNorm();
            }
            const Eigen::Index node = mesh_.elements(a, static_cast<Eigen::Index>(t));
            blocks.middleCols<3>(3 * node) += 0.25 * element.volume * block;
        }
    }
    return blocks;
}

}  // namespace elastolab
