#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "bem/boundary.hpp"
#include "deform/interior_field.hpp"

namespace elastolab {

/// Tractions of m solutions, linear on each of some triangles and zero on all others.
class SurfaceTractions {
public:
    explicit SurfaceTractions(Eigen::Index n_solutions) : n_solutions_(n_solutions) {}
    /// Adds a sum of shape functions: coefficients, 3 * elements.n_slots x m [force / L^2].
    void add(const Elements& elements, const Eigen::MatrixXd& coefficients);

    struct Loaded {
        int triangle;
        Eigen::MatrixXd corners;  ///< 9 x m, corner after corner
    };
    const std::vector<Loaded>& triangles() const { return triangles_; }
    Eigen::Index n_solutions() const { return n_solutions_; }

private:
    Eigen::Index n_solutions_;
    std::vector<Loaded> triangles_;
};

/// The inside of a solid of unit Young's modulus by Somigliana's identity, from displacements that are linear on the
/// triangles of its surface, and tractions:
///   u(x) = int U(x, y) t(y) dS - int T(x, y) u(y) dS
/// by the closed forms of both layers near x and by Gauss rules far from it. Its derivatives, and with them the
/// stresses, are central differences over a thousandth of the distance d from the surface: the layers are analytic
/// there, rounding of the closed forms (1e-14) leaves eleven digits and the step six. Hooke's lambda div u is not taken
/// from the gradient, whose error lambda would multiply close to nu = 1/2, but is the divergence of
///   nu / (4 pi (1 - nu)) [ int t / r dS + 2 mu int u (e . n) / r^2 dS ],
/// whose layers are there already; at nu = 1/2 it is the negative pressure. Nearer to the surface than
/// kNearest of an edge length, the stress is that of the nearest point at that distance, and displacements are
/// extrapolated linearly. Source: docs/formulation.md section 11.
class BoundaryField : public InteriorField {
public:
    static constexpr double kNearest = 0.05;

    /// displacements: of the vertices, 3*n_vertices x m [L].
    BoundaryField(std::shared_ptr<const Boundary> boundary, double poisson_ratio, Eigen::MatrixXd displacements,
                  SurfaceTractions tractions);

    InteriorValues at(const Positions& points, Control& control) const override;

private:
    class PointIntegrator;
    /// Where the identity is evaluated for a point, and how far that is from the surface.
    struct Place {
        Eigen::Vector3d x;
        double distance;
        int vertex;  ///< near it
    };
    Place place_of(const Eigen::Vector3d& point) const;

    std::shared_ptr<const Boundary> boundary_;
    double poisson_ratio_;
    Eigen::MatrixXd displacements_;
    SurfaceTractions tractions_;
    ClosestPoint closest_;
};

}  // namespace elastolab
