#include "fem/nodal_field.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>
#include <numeric>
#include <vector>

#include "base/parallel.hpp"
#include "elasticity/neo_hookean.hpp"
#include "elasticity/stress.hpp"
#include "fem/quadratic_mesh.hpp"

namespace elastolab {

namespace {

/// Barycentric weights that are below zero by no more than this count as rounding.
constexpr double kOnFace = 1e-9;
/// Poisson's ratios between which the stress of ten-node elements goes over from the pressure at their nodes to that
/// recovered from their means.
constexpr double kPressureOfNodes = 0.4, kPressureOfMeans = 0.49;
/// Least eigenvalue of a patch's moments, scaled to a diagonal of ones, above which they determine a slope.
constexpr double kTellsSlope = 0.02;

Eigen::Matrix3d edges_of(const TetMesh& tets, Eigen::Index t) {
    const Eigen::Matrix<double, 3, 4> x = tets.vertices(Eigen::all, tets.tetrahedra.col(t));
    return x.rightCols<3>().colwise() - x.col(0);
}

/// A BoxTree takes triangles: for each tetrahedron, one with the same bounding box.
SurfaceMesh diagonals_of_boxes(const TetMesh& tets) {
    SurfaceMesh mesh{Positions(3, 2 * tets.n_tetrahedra()), Triangles(3, tets.n_tetrahedra())};
    for (int t = 0; t < tets.n_tetrahedra(); ++t) {
        const Eigen::Matrix<double, 3, 4> x = tets.vertices(Eigen::all, tets.tetrahedra.col(t));
        mesh.vertices.col(2 * t) = x.rowwise().minCoeff();
        mesh.vertices.col(2 * t + 1) = x.rowwise().maxCoeff();
        mesh.triangles.col(t) = Eigen::Vector3i(2 * t, 2 * t + 1, 2 * t + 1);
    }
    return mesh;
}

std::vector<int> all_tetrahedra(const TetMesh& tets) {
    std::vector<int> all(static_cast<std::size_t>(tets.n_tetrahedra()));
    std::iota(all.begin(), all.end(), 0);
    return all;
}

/// For each node, the row that takes (1, place) of a tetrahedron around it to the weight of its stress in a linear
/// least-squares fit over all of these, weighted by volume. place: of the centroid, relative to the node in units of
/// `edge`.
class PatchFits {
public:
    PatchFits(const TetMesh& tets, double edge) : tets_(tets), edge_(edge) {
        std::vector<Eigen::Matrix4d> sums(static_cast<std::size_t>(tets.n_vertices()), Eigen::Matrix4d::Zero());
        for (Eigen::Index t = 0; t < tets.tetrahedra.cols(); ++t) {
            const double volume = edges_of(tets, t).determinant();
            for (const int corner : tets.tetrahedra.col(t)) {
                const Eigen::Vector4d p = place(t, corner);
                sums[static_cast<std::size_t>(corner)] += volume * p * p.transpose();
            }
        }
        for (const Eigen::Matrix4d& sum : sums) rows_.push_back(first_row_of_inverse(sum));
    }
    double weight(Eigen::Index tetrahedron, int corner, double volume) const {
        return volume * rows_[static_cast<std::size_t>(corner)].dot(place(tetrahedron, corner));
    }

private:
    Eigen::Vector4d place(Eigen::Index t, int corner) const {
        const Eigen::Vector3d middle = tets_.vertices(Eigen::all, tets_.tetrahedra.col(t)).rowwise().mean();
        Eigen::Vector4d p;
        p << 1.0, (middle - tets_.vertices.col(corner)) / edge_;
        return p;
    }
    /// Few tetrahedra, or coplanar ones, do not determine a slope: then their mean.
    static Eigen::Vector4d first_row_of_inverse(const Eigen::Matrix4d& sum) {
        const Eigen::Vector4d scale = sum.diagonal().cwiseSqrt().cwiseMax(1e-300);
        const Eigen::Matrix4d unit = scale.cwiseInverse().asDiagonal() * sum * scale.cwiseInverse().asDiagonal();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(unit);
        if (!(solver.eigenvalues()[0] > kTellsSlope)) return Eigen::Vector4d::UnitX() / std::max(sum(0, 0), 1e-300);
        const Eigen::Vector4d column = solver.eigenvectors() * solver.eigenvalues().cwiseInverse().asDiagonal() *
                                       solver.eigenvectors().row(0).transpose();
        return column.cwiseQuotient(scale) / scale[0];
    }

    const TetMesh& tets_;
    double edge_;
    std::vector<Eigen::Vector4d> rows_;
};

/// At every node: 6*n_nodes x m.
Eigen::MatrixXd recovered_stresses(const TetMesh& tets, double edge, double poisson_ratio, const Eigen::MatrixXd& u,
                                   bool large) {
    const Material material{1.0, poisson_ratio};
    const PatchFits fits(tets, edge);
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(2 * u.rows(), u.cols());
    for (Eigen::Index t = 0; t < tets.tetrahedra.cols(); ++t) {
        const Eigen::Vector4i corners = tets.tetrahedra.col(t);
        const Eigen::Matrix3d edges = edges_of(tets, t), inverse = edges.inverse();
        Eigen::Vector4d weights;
        for (int i = 0; i < 4; ++i) weights[i] = fits.weight(t, corners[i], edges.determinant());
        for (Eigen::Index c = 0; c < u.cols(); ++c) {
            Eigen::Matrix3d changes;
            for (int i = 0; i < 3; ++i)
                changes.col(i) = u.col(c).segment<3>(3 * corners[i + 1]) - u.col(c).segment<3>(3 * corners[0]);
            const StressNumbers s = stress_of(changes * inverse, material, large);
            for (int i = 0; i < 4; ++i) sums.col(c).segment<6>(6 * corners[i]) += weights[i] * s;
        }
    }
    return sums;
}

/// A ten-node element with the displacements of its nodes.
class TenNodes {
public:
    TenNodes(const Eigen::Ref<const Eigen::Matrix<int, 10, 1>>& nodes, const Positions& x, const Eigen::MatrixXd& u)
        : nodes_(nodes), u_(u) {
        const Eigen::Matrix3d edges = x(Eigen::all, nodes_.segment<3>(1)).colwise() - x.col(nodes_[0]);
        of_coordinates_.bottomRows<3>() = edges.inverse();
        of_coordinates_.row(0) = -of_coordinates_.bottomRows<3>().colwise().sum();
        volume_ = edges.determinant();
    }

    /// Six times the element's.
    double volume() const { return volume_; }

    /// each(c, gradient of the displacements of column c) at a point of these barycentric coordinates.
    template <class Each>
    void for_each_gradient(const Eigen::Vector4d& coordinates, const Each& each) const {
        const Eigen::Matrix<double, 10, 3> of_shapes = quadratic_slopes(coordinates) * of_coordinates_;
        for (Eigen::Index c = 0; c < u_.cols(); ++c) {
            Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
            for (int i = 0; i < 10; ++i) gradient += u_.col(c).segment<3>(3 * nodes_[i]) * of_shapes.row(i);
            each(c, gradient);
        }
    }

private:
    Eigen::Matrix<int, 10, 1> nodes_;
    const Eigen::MatrixXd& u_;
    Eigen::Matrix<double, 4, 3> of_coordinates_;  ///< gradients of the barycentric coordinates
    double volume_ = 0.0;
};

/// At every node the mean over the ten-node elements around it, by volume: 6*n_nodes x m.
Eigen::MatrixXd averaged_stresses(const Eigen::Matrix<int, 10, Eigen::Dynamic>& elements, const Positions& x,
                                  double poisson_ratio, const Eigen::MatrixXd& u, bool large) {
    const Material material{1.0, poisson_ratio};
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(2 * u.rows(), u.cols());
    Eigen::VectorXd volumes = Eigen::VectorXd::Zero(x.cols());
    for (const auto& element : elements.colwise()) {
        const TenNodes field(element, x, u);
        for (int node = 0; node < 10; ++node) {
            volumes[element[node]] += field.volume();
            field.for_each_gradient(node_coordinates(node), [&](Eigen::Index c, const Eigen::Matrix3d& gradient) {
                sums.col(c).segment<6>(6 * element[node]) += field.volume() * stress_of(gradient, material, large);
            });
        }
    }
    for (Eigen::Index node = 0; node < x.cols(); ++node) sums.middleRows<6>(6 * node) /= volumes[node];
    return sums;
}

double typical_edge(const TetMesh& tets) {
    const Eigen::Vector3d size = tets.vertices.rowwise().maxCoeff() - tets.vertices.rowwise().minCoeff();
    return size.norm() / std::cbrt(static_cast<double>(tets.n_tetrahedra()));
}

double mean_stress(const Eigen::Ref<const Eigen::VectorXd>& numbers) { return numbers.head<3>().mean(); }

/// Puts another pressure into the stresses of ten-node elements: a linear fit to the mean pressures of the elements
/// around each corner, and between corners their mean. Near nu = 1/2 pressure is lambda div u with lambda without
/// bound: elements have the volume right on the average and not at each node.
void recover_pressures(const Eigen::Matrix<int, 10, Eigen::Dynamic>& elements, const Positions& x, double poisson_ratio,
                       const Eigen::MatrixXd& u, bool large, double part, Eigen::MatrixXd& stresses) {
    const Material material{1.0, poisson_ratio};
    const TetMesh corners{x, elements.topRows<4>(), static_cast<int>(x.cols())};
    const PatchFits fits(corners, typical_edge(corners));
    constexpr double kInner = 0.1381966011250105;  // the rule of four points
    Eigen::MatrixXd pressures = Eigen::MatrixXd::Zero(x.cols(), u.cols());
    for (Eigen::Index e = 0; e < elements.cols(); ++e) {
        const auto element = elements.col(e);
        const TenNodes field(element, x, u);
        Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(u.cols());
        for (int point = 0; point < 4; ++point) {
            Eigen::Vector4d coordinates = Eigen::Vector4d::Constant(kInner);
            coordinates[point] = 1.0 - 3.0 * kInner;
            field.for_each_gradient(coordinates, [&](Eigen::Index c, const Eigen::Matrix3d& gradient) {
                mean[c] += 0.25 * mean_stress(stress_of(gradient, material, large));
            });
        }
        for (int i = 0; i < 4; ++i) pressures.row(element[i]) += fits.weight(e, element[i], field.volume()) * mean;
    }
    for (const auto& element : elements.colwise())
        for (int m = 0; m < 6; ++m)
            pressures.row(element[4 + m]) =
                0.5 * (pressures.row(element[kTetEdges[m][0]]) + pressures.row(element[kTetEdges[m][1]]));
    for (Eigen::Index node = 0; node < x.cols(); ++node)
        for (Eigen::Index c = 0; c < u.cols(); ++c) {
            auto numbers = stresses.col(c).segment<6>(6 * node);
            numbers.head<3>().array() += part * (pressures(node, c) - mean_stress(numbers));
        }
}

}  // namespace

NodalField::NodalField(std::shared_ptr<const TetMesh> tets, ElementDegree degree, double poisson_ratio,
                       Eigen::MatrixXd displacements, bool large_deformations)
    : tets_(std::move(tets)),
      elements_(10, 0),
      displacements_(std::move(displacements)),
      edge_(typical_edge(*tets_)),
      boxes_(diagonals_of_boxes(*tets_), all_tetrahedra(*tets_)) {
    assert(displacements_.rows() == 3 * tets_->vertices.cols());
    if (degree == ElementDegree::quadratic) elements_ = rejoined(*tets_);
    if (degree == ElementDegree::linear) {
        stresses_ = recovered_stresses(*tets_, edge_, poisson_ratio, displacements_, large_deformations);
        return;
    }
    stresses_ = averaged_stresses(elements_, tets_->vertices, poisson_ratio, displacements_, large_deformations);
    const double part =
        std::clamp((poisson_ratio - kPressureOfNodes) / (kPressureOfMeans - kPressureOfNodes), 0.0, 1.0);
    if (part > 0.0)
        recover_pressures(elements_, tets_->vertices, poisson_ratio, displacements_, large_deformations, part,
                          stresses_);
}

template <class Each>
void NodalField::for_each_node(const Place& place, const Each& each) const {
    if (elements_.cols() == 0) {
        for (int corner = 0; corner < 4; ++corner)
            each(tets_->tetrahedra(corner, place.tetrahedron), place.weights[corner]);
        return;
    }
    const Eigen::Matrix<double, 10, 1> shapes = quadratic_shapes(in_whole(place.tetrahedron % 8, place.weights));
    for (int i = 0; i < 10; ++i) each(elements_(i, place.tetrahedron / 8), shapes[i]);
}

NodalField::Place NodalField::place_of(const Eigen::Vector3d& point) const {
    Place best;
    double least = -std::numeric_limits<double>::infinity();
    // For a point between the rounded faces of two tetrahedra, or outside: the one that it is least outside of.
    for (double reach = 1e-6 * edge_; best.tetrahedron < 0 && std::isfinite(reach); reach *= 8.0)
        boxes_.for_each_near(
            point, [&](double) { return least >= -kOnFace ? -1.0 : reach; },
            [&](int t) {
                Eigen::Vector4d weights;
                weights.tail<3>() =
                    edges_of(*tets_, t).inverse() * (point - tets_->vertices.col(tets_->tetrahedra(0, t)));
                weights[0] = 1.0 - weights.tail<3>().sum();
                if (best.tetrahedron >= 0 && !(weights.minCoeff() > least)) return;
                least = weights.minCoeff();
                best = {t, weights};
            });
    if (best.tetrahedron < 0) best = {0, Eigen::Vector4d::Ones()};  // farther away than numbers reach
    best.weights = best.weights.cwiseMax(0.0);
    best.weights /= best.weights.sum();
    return best;
}

InteriorValues NodalField::at(const Positions& points, Control& control) const {
    const Eigen::Index m = displacements_.cols();
    InteriorValues values{Eigen::MatrixXd::Zero(3 * points.cols(), m), Eigen::MatrixXd::Zero(6 * points.cols(), m)};
    parallel_blocks(static_cast<int>(points.cols()), 64, control, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            for_each_node(place_of(points.col(i)), [&](int node, double weight) {
                values.displacements.middleRows<3>(3 * i) += weight * displacements_.middleRows<3>(3 * node);
                values.stresses.middleRows<6>(6 * i) += weight * stresses_.middleRows<6>(6 * node);
            });
        }
    });
    return values;
}

}  // namespace elastolab
