#include "bem/hierarchical/node_potentials.hpp"

namespace elastolab {

namespace {

/// First of the columns that hold each potential.
constexpr int kInverse = 0, kTensor = 3, kDerivatives = 6;

}  // namespace

/// The powers of y are summed as forces are, so that all but 1 / r and its cube are products of matrices.
void add_node_potentials(const InterpolationNodes& field, const InterpolationNodes& source,
                         const Eigen::MatrixXd& forces, Eigen::MatrixXd& sum) {
    const Eigen::Matrix3Xd x = field.offsets().colwise() + (field.middle() - source.middle());
    const Eigen::Matrix3Xd& y = source.offsets();
    Eigen::MatrixXd inverse(x.cols(), y.cols());
    for (Eigen::Index j = 0; j < y.cols(); ++j)
        inverse.col(j) = ((x.row(0).array() - y(0, j)).square() + (x.row(1).array() - y(1, j)).square() +
                          (x.row(2).array() - y(2, j)).square())
                             .rsqrt()
                             .transpose();
    const Eigen::MatrixXd cube = inverse.array().cube();
    const Eigen::Index n_loads = forces.cols() / 3;
    constexpr int kMoments = 15;  // g, y_i g (i = 0, 1, 2), (y . g) y
    Eigen::MatrixXd moments(y.cols(), kMoments * n_loads);
    for (Eigen::Index load = 0; load < n_loads; ++load) {
        const auto g = forces.middleCols(3 * load, 3);
        auto own = moments.middleCols(kMoments * load, kMoments);
        own.leftCols<3>() = g;
        for (int i = 0; i < 3; ++i) own.middleCols(3 + 3 * i, 3) = y.row(i).transpose().asDiagonal() * g;
        const Eigen::VectorXd along = (y.transpose().array() * g.array()).rowwise().sum();
        own.rightCols<3>() = along.asDiagonal() * y.transpose();
    }
    const Eigen::MatrixXd of_cube = cube * moments, of_inverse = inverse * forces;
    for (Eigen::Index load = 0; load < n_loads; ++load) {
        auto own = sum.middleCols(kNodePotentials * load, kNodePotentials);
        own.middleCols<3>(kInverse) += of_inverse.middleCols(3 * load, 3);
        const auto B = of_cube.middleCols(kMoments * load, kMoments);
        for (Eigen::Index p = 0; p < x.cols(); ++p) {
            const Eigen::Vector3d at = x.col(p), g = B.row(p).head<3>().transpose();
            Eigen::Matrix3d y_g;  // row i: sum y_i g
            for (int i = 0; i < 3; ++i) y_g.row(i) = B.row(p).segment<3>(3 + 3 * i);
            const Eigen::Matrix3d r_g = at * g.transpose() - y_g;
            own.row(p).segment<3>(kTensor) +=
                (at * (at.dot(g) - y_g.trace()) - y_g * at + B.row(p).tail<3>().transpose()).transpose();
            for (int i = 0; i < 3; ++i) own.row(p).segment<3>(kDerivatives + 3 * i) += r_g.row(i);
        }
    }
}

}  // namespace elastolab
