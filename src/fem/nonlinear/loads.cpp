#include "fem/nonlinear/loads.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <Eigen/Geometry>

#include "elasticity/rotation.hpp"
#include "fem/load_vectors.hpp"

namespace elastolab {

namespace {

/// A point of a quadrature rule on a triangle of three or six nodes.
struct FacePoint {
    double weight = 0.0;  ///< of the triangle xi, eta >= 0, xi + eta <= 1
    Eigen::Matrix<double, 6, 1> N, N_xi, N_eta;
};

FacePoint face_point(int n_nodes, const Eigen::Vector3d& L, double weight) {
    FacePoint at{weight, Eigen::Matrix<double, 6, 1>::Zero(), {}, {}};
    Eigen::Matrix<double, 6, 3> slopes = Eigen::Matrix<double, 6, 3>::Zero();
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        at.N[i] = n_nodes == 3 ? L[i] : L[i] * (2.0 * L[i] - 1.0);
        slopes(i, i) = n_nodes == 3 ? 1.0 : 4.0 * L[i] - 1.0;
        if (n_nodes == 3) continue;
        at.N[3 + i] = 4.0 * L[i] * L[j];
        slopes(3 + i, i) = 4.0 * L[j];
        slopes(3 + i, j) = 4.0 * L[i];
    }
    at.N_xi = slopes.col(1) - slopes.col(0);
    at.N_eta = slopes.col(2) - slopes.col(0);
    return at;
}

/// Exact for N_a (x_xi cross x_eta): of degree 1 on three nodes, of degree 4 (Dunavant's six points) on six.
std::vector<FacePoint> face_rule(int n_nodes) {
    if (n_nodes == 3) return {face_point(3, Eigen::Vector3d::Constant(1.0 / 3.0), 0.5)};
    constexpr std::array<std::array<double, 2>, 2> kOrbits = {
        {{0.44594849091596488632, 0.22338158967801146570}, {0.09157621350977074346, 0.10995174365532186764}}};
    std::vector<FacePoint> points;
    for (const auto& [side, weight] : kOrbits)
        for (int i = 0; i < 3; ++i) {
            Eigen::Vector3d L = Eigen::Vector3d::Constant(side);
            L[i] = 1.0 - 2.0 * side;
            points.push_back(face_point(6, L, 0.5 * weight));
        }
    return points;
}

const std::vector<FacePoint>& rule_of(std::size_t n_nodes) {
    static const std::vector<FacePoint> of_three = face_rule(3), of_six = face_rule(6);
    return n_nodes == 3 ? of_three : of_six;
}

/// The tangents of a face whose nodes are the columns of x.
Eigen::Matrix<double, 3, 2> tangents(const Eigen::Matrix3Xd& x, const FacePoint& at) {
    Eigen::Matrix<double, 3, 2> both;
    both << x * at.N_xi.head(x.cols()), x * at.N_eta.head(x.cols());
    return both;
}

/// The element of a surface triangle, and the places of these nodes in it.
void find_element(const FiniteElements& elements, PressedFace& face) {
    for (const ElementCorner& corner : elements.around(face.nodes[0])) {
        const Eigen::VectorXi nodes = elements.elements().col(corner.element);
        face.local.clear();
        for (const int node : face.nodes) {
            const auto found = std::find(nodes.begin(), nodes.end(), node);
            if (found == nodes.end()) break;
            face.local.push_back(static_cast<int>(found - nodes.begin()));
        }
        face.element = corner.element;
        if (face.local.size() == face.nodes.size()) return;
    }
    assert(false && "a triangle of the surface is a face of an element");
}

}  // namespace

NonlinearLoads::NonlinearLoads(std::shared_ptr<const FiniteElements> elements, const Triangles& surface,
                               const Triangles& midpoints, std::span<const UnitLoad> loads)
    : elements_(std::move(elements)) {
    std::vector<UnitLoad> dead(loads.begin(), loads.end());
    for (std::size_t i = 0; i < loads.size(); ++i) {
        if (!loads[i].follows) continue;
        for (std::size_t k = 0; k < loads[i].triangles.size(); ++k) {
            PressedFace face{.load = static_cast<int>(i), .nodes = {}, .local = {}};
            const int t = loads[i].triangles[k];
            for (int c = 0; c < 3; ++c) face.nodes.push_back(surface(c, t));
            const Eigen::Matrix3d x = elements_->positions()(Eigen::all, face.nodes);
            const Eigen::Vector3d normal = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).normalized();
            face.pressure = -normal.dot(loads[i].tractions.col(static_cast<Eigen::Index>(k)));
            for (int c = 0; c < 3 && midpoints.cols() > 0; ++c) face.nodes.push_back(midpoints(c, t));
            find_element(*elements_, face);
            faces_.push_back(std::move(face));
        }
        dead[i].tractions.setZero();
    }
    dead_ = load_vectors(elements_->positions(), elements_->elements(), surface, midpoints, dead);
}

Eigen::Matrix3Xd NonlinearLoads::positions_of(const PressedFace& face, const Eigen::VectorXd& u) const {
    Eigen::Matrix3Xd x = elements_->positions()(Eigen::all, face.nodes);
    for (std::size_t a = 0; a < face.nodes.size(); ++a)
        x.col(static_cast<Eigen::Index>(a)) += u.segment<3>(3 * face.nodes[a]);
    return x;
}

void NonlinearLoads::press(const PressedFace& face, const Eigen::VectorXd& u, double factor,
                           Eigen::VectorXd& forces) const {
    const Eigen::Matrix3Xd x = positions_of(face, u);
    for (const FacePoint& at : rule_of(face.nodes.size())) {
        const auto t = tangents(x, at);
        const Eigen::Vector3d force = -factor * face.pressure * at.weight * t.col(0).cross(t.col(1));
        for (std::size_t a = 0; a < face.nodes.size(); ++a)
            forces.segment<3>(3 * face.nodes[a]) += at.N[static_cast<Eigen::Index>(a)] * force;
    }
}

Eigen::VectorXd NonlinearLoads::forces(const Eigen::VectorXd& u, const Eigen::VectorXd& factors) const {
    if (size() == 0) return Eigen::VectorXd::Zero(u.size());
    Eigen::VectorXd sum = dead_ * factors;
    for (const PressedFace& face : faces_) press(face, u, factors[face.load], sum);
    return sum;
}

Eigen::VectorXd NonlinearLoads::force_change(const Eigen::VectorXd& u, const Eigen::VectorXd& factors,
                                             const Eigen::VectorXd& motion,
                                             const Eigen::VectorXd& factor_change) const {
    Eigen::VectorXd sum = forces(u, factor_change);
    for (const PressedFace& face : faces_) {
        const Eigen::Matrix3Xd x = positions_of(face, u);
        Eigen::Matrix3Xd change(3, x.cols());
        for (std::size_t a = 0; a < face.nodes.size(); ++a)
            change.col(static_cast<Eigen::Index>(a)) = motion.segment<3>(3 * face.nodes[a]);
        for (const FacePoint& at : rule_of(face.nodes.size())) {
            const auto t = tangents(x, at), d = tangents(change, at);
            const Eigen::Vector3d force =
                -factors[face.load] * face.pressure * at.weight * (d.col(0).cross(t.col(1)) + t.col(0).cross(d.col(1)));
            for (std::size_t a = 0; a < face.nodes.size(); ++a)
                sum.segment<3>(3 * face.nodes[a]) += at.N[static_cast<Eigen::Index>(a)] * force;
        }
    }
    return sum;
}

void NonlinearLoads::add_tangent(const Eigen::VectorXd& u, const Eigen::VectorXd& factors, ElementWork& work) const {
    const int numbers = 9 * block_count(elements_ ? elements_->nodes_per_element() : 0);
    for (const PressedFace& face : faces_) {
        const auto n = static_cast<Eigen::Index>(face.nodes.size());
        const Eigen::Matrix3Xd x = positions_of(face, u);
        Eigen::MatrixXd D = Eigen::MatrixXd::Zero(3 * n, 3 * n);  // of the forces
        for (const FacePoint& at : rule_of(face.nodes.size())) {
            const auto t = tangents(x, at);
            const Eigen::Matrix3d xi = cross_matrix(t.col(0)), eta = cross_matrix(t.col(1));
            const double size = -factors[face.load] * face.pressure * at.weight;
            for (Eigen::Index a = 0; a < n; ++a)
                for (Eigen::Index b = 0; b < n; ++b)
                    D.block<3, 3>(3 * a, 3 * b) += size * at.N[a] * (at.N_eta[b] * xi - at.N_xi[b] * eta);
        }
        const Eigen::MatrixXd symmetric = 0.5 * (D + D.transpose());
        double* blocks = work.stiffness.data() + static_cast<std::ptrdiff_t>(numbers) * face.element;
        for (Eigen::Index a = 0; a < n; ++a)
            for (Eigen::Index b = 0; b < n; ++b) {
                const int row = face.local[static_cast<std::size_t>(a)],
                          column = face.local[static_cast<std::size_t>(b)];
                if (row < column) continue;
                Eigen::Map<Eigen::Matrix3d>(blocks + 9 * block_index(row, column)) -=
                    symmetric.block<3, 3>(3 * a, 3 * b);
            }
    }
}

/// Forces are of second degree along the way, so that Simpson's rule is exact.
double NonlinearLoads::work(const Eigen::VectorXd& u, const Eigen::VectorXd& motion,
                            const Eigen::VectorXd& factors) const {
    if (size() == 0) return 0.0;
    if (!follow()) return factors.dot(dead_.transpose() * motion);
    return (forces(u, factors).dot(motion) + 4.0 * forces(u + 0.5 * motion, factors).dot(motion) +
            forces(u + motion, factors).dot(motion)) /
           6.0;
}

Eigen::MatrixXd NonlinearLoads::resultants(const Eigen::VectorXd& u, const Eigen::VectorXd& factors) const {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(6, size());
    for (int load = 0; load < size(); ++load) {
        const Eigen::VectorXd f = forces(u, factors[load] * Eigen::VectorXd::Unit(size(), load));
        for (int node = 0; node < elements_->n_nodes(); ++node) {
            const Eigen::Vector3d x = elements_->positions().col(node) + u.segment<3>(3 * node);
            sums.col(load).head<3>() += f.segment<3>(3 * node);
            sums.col(load).tail<3>() += x.cross(f.segment<3>(3 * node));
        }
    }
    return sums;
}

}  // namespace elastolab
