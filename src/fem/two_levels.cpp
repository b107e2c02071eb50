#include "fem/two_levels.hpp"

#include <array>
#include <Eigen/LU>
#include <utility>

#include "deform/conjugate_gradients.hpp"
#include "deform/gmres.hpp"

namespace elastolab {

namespace {

constexpr int kMostProducts = 150;
/// Residual, over that of the error's energy norm, at which answers are about as good.
constexpr double kResidualOfEnergy = 0.1;

}  // namespace

/// Between the nodes that are not prescribed; zero for the others.
class TwoLevels::FreeStiffness : public LinearOperator {
public:
    FreeStiffness(const TwoLevels& levels, const Product& K) : levels_(levels), K_(K) {}
    Eigen::Index size() const override { return 3 * std::ssize(levels_.is_prescribed_); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        Eigen::MatrixXd Y(X.rows(), X.cols());
        for (Eigen::Index c = 0; c < X.cols(); ++c) Y.col(c) = levels_.free_part(K_(X.col(c)));
        return Y;
    }

private:
    const TwoLevels& levels_;
    const Product& K_;
};

class TwoLevels::Preconditioner : public LinearOperator {
public:
    Preconditioner(const TwoLevels& levels, const Operators& apply) : levels_(levels), apply_(apply) {
        for (std::size_t node = 0; node < levels.is_midpoint_.size(); ++node) {
            Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
            if (levels.is_midpoint_[node] && !levels.is_prescribed_[node])
                block = apply.diagonal(static_cast<int>(node)).inverse();
            of_midpoints_.push_back(block);
        }
    }
    Eigen::Index size() const override { return 3 * std::ssize(of_midpoints_); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& R) const override {
        Eigen::MatrixXd Z(R.rows(), R.cols());
        for (Eigen::Index c = 0; c < R.cols(); ++c) Z.col(c) = corrected(R.col(c));
        return Z;
    }

private:
    Eigen::VectorXd corrected(const Eigen::VectorXd& residual) const {
        const Eigen::VectorXd on_coarse = levels_.prolongation_.transpose() * residual;
        Eigen::VectorXd z = levels_.prolongation_ * apply_.solve_coarse(on_coarse);
        for (std::size_t node = 0; node < of_midpoints_.size(); ++node)
            z.segment<3>(3 * static_cast<Eigen::Index>(node)) +=
                of_midpoints_[node] * residual.segment<3>(3 * static_cast<Eigen::Index>(node));
        return levels_.free_part(std::move(z));
    }

    const TwoLevels& levels_;
    const Operators& apply_;
    std::vector<Eigen::Matrix3d> of_midpoints_;
};

TwoLevels::TwoLevels(const QuadraticMesh& mesh, const SparseMatrix& prolongation, std::span<const int> prescribed)
    : prolongation_(prolongation),
      is_prescribed_(static_cast<std::size_t>(mesh.n_nodes()), 0),
      is_midpoint_(is_prescribed_) {
    for (const int node : prescribed) is_prescribed_[static_cast<std::size_t>(node)] = 1;
    for (const int node : mesh.elements.bottomRows<6>().reshaped()) is_midpoint_[static_cast<std::size_t>(node)] = 1;
}

Eigen::VectorXd TwoLevels::free_part(Eigen::VectorXd all) const {
    for (std::size_t node = 0; node < is_prescribed_.size(); ++node)
        if (is_prescribed_[node]) all.segment<3>(3 * static_cast<Eigen::Index>(node)).setZero();
    return all;
}

Eigen::VectorXd TwoLevels::solve(const Operators& apply, const Eigen::VectorXd& forces, double enough, Control& control,
                                 IterationReport* report) const {
    const char* const name = "stiffness matrix of quadratic elements";
    if (!apply.symmetric)
        return gmres(FreeStiffness(*this, apply.stiffness), Preconditioner(*this, apply), free_part(forces),
                     {.tolerance = kResidualOfEnergy * enough, .max_iterations = kMostProducts, .basis = kBasis}, name,
                     control, report)
            .col(0);
    return conjugate_gradients(FreeStiffness(*this, apply.stiffness), Preconditioner(*this, apply), free_part(forces),
                               {.energy_tolerance = enough, .max_iterations = kMostProducts, .must_converge = false},
                               name, control, report)
        .col(0);
}

SparseMatrix from_corners(const QuadraticMesh& mesh) {
    std::vector<std::array<int, 2>> ends(static_cast<std::size_t>(mesh.n_nodes()), {-1, -1});
    for (const auto& element : mesh.elements.colwise())
        for (int e = 0; e < 6; ++e)
            ends[static_cast<std::size_t>(element[4 + e])] = {element[kTetEdges[e][0]], element[kTetEdges[e][1]]};
    std::vector<int> corner(ends.size(), -1);
    int n_corners = 0;
    for (std::size_t node = 0; node < ends.size(); ++node)
        if (ends[node][0] < 0) corner[node] = n_corners++;
    std::vector<Eigen::Triplet<double>> entries;
    for (int node = 0; node < mesh.n_nodes(); ++node)
        for (int axis = 0; axis < 3; ++axis) {
            const auto add = [&](int corner_node, double weight) {
                entries.emplace_back(3 * node + axis, 3 * corner[static_cast<std::size_t>(corner_node)] + axis, weight);
            };
            const std::array<int, 2> own = ends[static_cast<std::size_t>(node)];
            if (own[0] < 0) add(node, 1.0);
            for (const int end : own)
                if (end >= 0) add(end, 0.5);
        }
    SparseMatrix P(3 * mesh.n_nodes(), 3 * n_corners);
    P.setFromTriplets(entries.begin(), entries.end());
    return P;
}

}  // namespace elastolab
