#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <memory>
#include <numbers>
#include <vector>

#include "fem/nonlinear/elements.hpp"
#include "fem/nonlinear/solver.hpp"
#include "fem/quadratic_mesh.hpp"
#include "support/tet_box.hpp"

namespace elastolab::test {

/// Neo-Hookean elements on a box [0, size] of 6 tetrahedra a cell.
inline std::shared_ptr<const FiniteElements> elements_of_box(const Eigen::Vector3i& cells, const Eigen::Vector3d& size,
                                                             ElementDegree degree, double jitter = 0.0) {
    const TetMesh mesh = make_tet_box(cells, size, jitter);
    if (degree == ElementDegree::linear) return std::make_shared<FiniteElements>(mesh.vertices, mesh.tetrahedra);
    const QuadraticMesh quadratic(mesh);
    return std::make_shared<FiniteElements>(quadratic.positions, quadratic.elements);
}

inline std::vector<int> nodes_where(const FiniteElements& elements, const auto& predicate) {
    return vertices_where(elements.positions(), elements.n_nodes(), predicate);
}

/// Displacements of all nodes by x -> F x + t.
inline Eigen::VectorXd affine(const FiniteElements& elements, const Eigen::Matrix3d& F,
                              const Eigen::Vector3d& t = Eigen::Vector3d::Zero()) {
    const Eigen::Matrix3Xd u = ((F - Eigen::Matrix3d::Identity()) * elements.positions()).colwise() + t;
    return u.reshaped();
}

/// Displacements at the nodes of `others`, all of which are nodes of `elements` as well.
inline Eigen::VectorXd at_nodes(const FiniteElements& elements, const Eigen::VectorXd& u,
                                const FiniteElements& others) {
    Eigen::VectorXd result(3 * others.n_nodes());
    for (int node = 0; node < others.n_nodes(); ++node) {
        Eigen::Index nearest = 0;
        (elements.positions().colwise() - others.positions().col(node)).colwise().squaredNorm().minCoeff(&nearest);
        result.segment<3>(3 * node) = u.segment<3>(3 * nearest);
    }
    return result;
}

inline Eigen::Matrix3d rotation(const Eigen::Vector3d& axis, double degrees) {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.normalized()).toRotationMatrix();
}

/// A bar along x whose left end is held and whose right end moves.
struct HeldBar {
    HeldBar(const Eigen::Vector3i& cells, ElementDegree degree, double nu = 0.3, double length = 4.0)
        : elements(elements_of_box(cells, {length, 1.0, 1.0}, degree)), material{1.0, nu} {
        left = nodes_where(*elements, [](const auto& p) { return p[0] == 0.0; });
        right = nodes_where(*elements, [&](const auto& p) { return p[0] == length; });
        PrescribedNodes prescribed{left, static_cast<int>(left.size()), true};
        prescribed.nodes.insert(prescribed.nodes.end(), right.begin(), right.end());
        Control control;
        solver = std::make_unique<NonlinearSolver>(elements, material, prescribed, control);
    }

    /// Prescribed displacements that move the right end by x -> center + R (x - center) + shift.
    Eigen::VectorXd moved(const Eigen::Matrix3d& R, const Eigen::Vector3d& center,
                          const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) const {
        Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * std::ssize(left) + 3 * std::ssize(right));
        for (std::size_t i = 0; i < right.size(); ++i) {
            const Eigen::Vector3d x = elements->positions().col(right[i]);
            values.segment<3>(3 * static_cast<Eigen::Index>(left.size() + i)) = center + R * (x - center) + shift - x;
        }
        return values;
    }
    Eigen::VectorXd twisted(double degrees) const {
        return moved(rotation(Eigen::Vector3d::UnitX(), degrees), {0.0, 0.5, 0.5});
    }
    /// The end turns about z and follows the arc of a bar of constant curvature.
    Eigen::VectorXd bent(double degrees) const {
        if (degrees == 0.0) return twisted(0.0);
        const double angle = degrees * std::numbers::pi / 180.0, radius = 4.0 / angle;
        const Eigen::Vector3d middle(4.0, 0.5, 0.5),
            end(radius * std::sin(angle), 0.5 + radius * (1.0 - std::cos(angle)), 0.5);
        return moved(rotation(Eigen::Vector3d::UnitZ(), degrees), middle, end - middle);
    }
    NodeSolution solve(const Eigen::VectorXd& values, const NodeState* start = nullptr, double tolerance = 1e-8) const {
        Control control;
        return solver->solve_task({.prescribed = values, .start = start, .want_loads = true}, tolerance, control);
    }

    std::shared_ptr<const FiniteElements> elements;
    Material material;
    std::vector<int> left, right;
    std::unique_ptr<NonlinearSolver> solver;
};

}  // namespace elastolab::test
