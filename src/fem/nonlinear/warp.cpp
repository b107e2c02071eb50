#include "fem/nonlinear/warp.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "elasticity/rotation.hpp"

namespace elastolab {

namespace {

constexpr int kElementsAtOnce = 128;
/// Part of the Laplacian that keeps the mean of positions where it is, for bodies without any constrained node.
constexpr double kMeanShift = 1e-8;

/// int grad N_a . grad N_b, of one number a node.
double laplacian(const FiniteElements& elements, int element, int a, int b) {
    double sum = 0.0;
    for (int point = 0; point < elements.n_points(); ++point) {
        const auto g = elements.shape_gradients(element, point);
        sum += g.row(a).dot(g.row(b));
    }
    return sum * elements.volume(element) / elements.n_points();
}

/// Sets forces, n x 3, of one element to int (target - gradient of u)^T-products with the shape gradients. target: what
/// the gradient of `from` becomes by the rotation and strain of `change`.
void set_target(const FiniteElements& elements, int element, const Eigen::VectorXd& from, const Eigen::VectorXd& change,
                const Eigen::VectorXd& u, double* forces) {
    for (int i = 0; i < 3 * elements.nodes_per_element(); ++i) forces[i] = 0.0;
    for (int point = 0; point < elements.n_points(); ++point) {
        const auto g = elements.shape_gradients(element, point);
        const Eigen::Matrix3d F = Eigen::Matrix3d::Identity() + elements.gradient(from, element, g),
                              G = elements.gradient(change, element, g) * F.inverse();
        const Eigen::Matrix3d strain = 0.5 * (G + G.transpose()), spin = 0.5 * (G - G.transpose());
        const Eigen::Vector3d turn(spin(2, 1), spin(0, 2), spin(1, 0));
        const Eigen::Matrix3d target = rotation_by(turn) * (F + strain * F) - Eigen::Matrix3d::Identity();
        const Eigen::Matrix3d difference =
            elements.volume(element) / elements.n_points() * (target - elements.gradient(u, element, g));
        for (int a = 0; a < elements.nodes_per_element(); ++a)
            Eigen::Map<Eigen::Vector3d>(forces + 3 * a) += difference * g.row(a).transpose();
    }
}

}  // namespace

WarpedStart::WarpedStart(const Newton& newton, NewtonWork& work, Control& control)
    : tangent_(newton.shared_tangent()), material_(newton.material()) {
    bool stable = true;
    rest_ =
        newton.factor_at(Eigen::VectorXd::Zero(3 * elements().n_nodes()), newton.loads().none(), work, stable, control);
    if (!rest_)
        throw SolveError("stiffness at rest: is not positive definite. Check the mesh for degenerate tetrahedra.");
    SparseMatrix L =
        tangent_->node_matrix([&](int element, int a, int b) { return laplacian(elements(), element, a, b); });
    const bool all_are_free = std::ssize(tangent_->nodes()) == elements().n_nodes();
    for (int i = 0; all_are_free && i < L.cols(); ++i) L.coeffRef(i, i) += kMeanShift * elements().edge();
    poisson_ = std::make_shared<const SparseCholesky>(CholeskyAnalysis(L, 1), L, "Laplacian", &control);
}

Eigen::VectorXd WarpedStart::displace(const Eigen::VectorXd& logarithm, const Eigen::VectorXd& prescribed,
                                      ElementWork& work, Control& control) const {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(prescribed.size());
    const Eigen::VectorXd load = elements().force_change(zero, logarithm, material_, work, control);
    const Eigen::VectorXd linear = logarithm - tangent_->all_rows(rest_->solve(tangent_->free_rows(load)));
    return warped(zero, linear, prescribed, work, control);
}

Eigen::VectorXd WarpedStart::warped(const Eigen::VectorXd& from, const Eigen::VectorXd& change,
                                    const Eigen::VectorXd& prescribed, ElementWork& work, Control& control) const {
    Control inner;
    const int n = 3 * elements().nodes_per_element();
    parallel_blocks(elements().n_elements(), kElementsAtOnce, inner, [&](int begin, int end) {
        for (int e = begin; e < end; ++e)
            set_target(elements(), e, from, change, prescribed,
                       work.forces.data() + static_cast<std::ptrdiff_t>(n) * e);
    });
    const Eigen::VectorXd right = tangent_->free_rows(elements().gathered(work, control));
    const Eigen::MatrixXd by_axis = right.reshaped(3, right.size() / 3).transpose();
    const Eigen::MatrixXd solved = poisson_->solve(by_axis).transpose();
    return prescribed + tangent_->all_rows(solved.reshaped());
}

}  // namespace elastolab
