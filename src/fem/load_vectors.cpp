#include "fem/load_vectors.hpp"

#include <Eigen/Geometry>

#include "fem/solvers.hpp"

namespace elastolab {

namespace {

/// What loads act on: nodes of elements (4 or 10) and of the surface's triangles (corners, midpoints or none).
struct Loaded {
    const Positions& positions;
    Eigen::MatrixXi elements;
    const Triangles& triangles;
    Triangles midpoints;

    Eigen::Vector3d at(int node) const { return positions.col(node); }

    void add_body_force(const Eigen::Vector3d& density, Eigen::Ref<Eigen::VectorXd> f) const {
        const bool quadratic = elements.rows() == 10;
        for (const auto& nodes : elements.colwise()) {
            const Eigen::Vector3d a = at(nodes[0]);
            const double volume = (at(nodes[1]) - a).cross(at(nodes[2]) - a).dot(at(nodes[3]) - a) / 6.0;
            for (Eigen::Index i = 0; i < nodes.size(); ++i)
                f.segment<3>(3 * nodes[i]) += volume * (!quadratic ? 0.25 : i < 4 ? -0.05 : 0.2) * density;
        }
    }
    void add_traction(int t, const Eigen::Vector3d& traction, Eigen::Ref<Eigen::VectorXd> f) const {
        const Eigen::Vector3d a = at(triangles(0, t));
        const double area = 0.5 * (at(triangles(1, t)) - a).cross(at(triangles(2, t)) - a).norm();
        const Triangles& nodes = midpoints.cols() > 0 ? midpoints : triangles;
        for (int i = 0; i < 3; ++i) f.segment<3>(3 * nodes(i, t)) += area / 3.0 * traction;
    }

    Eigen::MatrixXd vectors(std::span<const UnitLoad> loads) const {
        Eigen::MatrixXd f = Eigen::MatrixXd::Zero(positions.size(), std::ssize(loads));
        for (Eigen::Index i = 0; i < std::ssize(loads); ++i) {
            const UnitLoad& load = loads[static_cast<std::size_t>(i)];
            if (load.is_body_force()) add_body_force(load.body_force, f.col(i));
            for (std::size_t k = 0; k < load.triangles.size(); ++k)
                add_traction(load.triangles[k], load.tractions.col(static_cast<Eigen::Index>(k)), f.col(i));
        }
        return f;
    }
};

}  // namespace

Triangles midpoints_of(const Triangles& triangles, const QuadraticMesh& mesh) {
    Triangles midpoints(3, triangles.cols());
    for (Eigen::Index t = 0; t < triangles.cols(); ++t)
        for (int i = 0; i < 3; ++i) midpoints(i, t) = mesh.midpoint(triangles(i, t), triangles((i + 1) % 3, t));
    return midpoints;
}

Eigen::MatrixXd load_vectors(const FemMesh& mesh, std::span<const UnitLoad> loads) {
    return Loaded{mesh.tets.vertices, mesh.elements(), mesh.surface, mesh.surface_midpoints}.vectors(loads);
}

Eigen::MatrixXd load_vectors(const QuadraticMesh& mesh, const FemMesh& linear, std::span<const UnitLoad> loads) {
    return load_vectors(mesh, linear.surface, loads);
}

Eigen::MatrixXd load_vectors(const QuadraticMesh& mesh, const Triangles& surface, std::span<const UnitLoad> loads) {
    return Loaded{mesh.positions, mesh.elements, surface, midpoints_of(surface, mesh)}.vectors(loads);
}

Eigen::MatrixXd load_vectors(const Positions& positions, const Eigen::MatrixXi& elements, const Triangles& surface,
                             const Triangles& midpoints, std::span<const UnitLoad> loads) {
    return Loaded{positions, elements, surface, midpoints}.vectors(loads);
}

}  // namespace elastolab
