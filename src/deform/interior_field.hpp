#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/control.hpp"
#include "elasticity/stress.hpp"
#include "mesh/closest_point.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Displacements and stresses at n points, for m solutions.
struct InteriorValues {
    Eigen::MatrixXd displacements;  ///< 3n x m [L]
    Eigen::MatrixXd stresses;       ///< 6n x m [force / L^2]: StressNumbers of the points one below the other
};

/// Displacements and stresses inside a body, for m solutions at once: of linear methods linear in the prescribed
/// values, so that those of a drag are a sum over its columns. Others have Cauchy stresses. Immutable; any thread may
/// use it.
class InteriorField {
public:
    virtual ~InteriorField() = default;

    /// points: inside or on the surface, 3 x n [L]. Points outside, by however little, have finite values: those of a
    /// point nearby that is inside. On all threads. Throws Cancelled.
    virtual InteriorValues at(const Positions& points, Control& control) const = 0;
};

/// The fields of several solids as that of one body.
class BodyField : public InteriorField {
public:
    struct Part {
        std::shared_ptr<const InteriorField> field;  ///< of unit Young's modulus; null: the solid rests
        Eigen::Vector3d origin;                      ///< as in Model::Part
        double scale = 1.0;
        /// The field has displacements in its own coordinates, not in those of the body.
        bool scaled_displacements = false;
    };
    /// part_of_triangle: for each triangle of the body's surface, the number of its solid.
    BodyField(std::shared_ptr<const SurfaceMesh> surface, std::vector<int> part_of_triangle, std::vector<Part> parts,
              double young_modulus, Eigen::Index n_solutions);

    InteriorValues at(const Positions& points, Control& control) const override;

private:
    /// The point belongs to the solid whose surface is nearest.
    std::vector<std::vector<Eigen::Index>> by_part(const Positions& points, Control& control) const;

    std::shared_ptr<const SurfaceMesh> surface_;
    std::vector<int> part_of_triangle_;
    std::vector<Part> parts_;
    double young_modulus_;
    Eigen::Index n_solutions_;
};

}  // namespace elastolab
