#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A load of size one on a body, of which a factor is given later: either a body force everywhere inside, or tractions
/// on some triangles of the surface. With the body force along axis k of length 1, the factor is density times gravity
/// along k; with tractions -n, it is a pressure; with tractions d / (area of the triangles), a total force along d.
/// Loads are dead: they keep their size and direction while the body moves (linear methods know nothing else). Under
/// large deformations a pressure follows the surface instead.
struct UnitLoad {
    Eigen::Vector3d body_force = Eigen::Vector3d::Zero();  ///< [force / L^3], per unit of the factor
    std::vector<int> triangles = {};                       ///< loaded ones, all different
    Eigen::Matrix3Xd tractions = {};                       ///< 3 x triangles.size(), constant on each [force / L^2]
    /// A pressure: under large deformations -p n on the present surface, p that of the tractions along the rest normal.
    bool follows = false;

    bool is_body_force() const { return triangles.empty(); }
    bool operator==(const UnitLoad& other) const;
};

/// Identifies a load among those of one solid, for caches: begins with -1, which no vertex or kind of column does.
std::vector<int> load_key(const UnitLoad& load);

/// Body force along an axis (0, 1, 2).
UnitLoad body_force_along(int axis);
/// The same traction on each of these triangles; a pressure of one, which presses into the body; a total force, spread
/// evenly over their area (which is not zero).
UnitLoad unit_traction(std::vector<int> triangles, const Eigen::Vector3d& traction);
UnitLoad unit_pressure(const SurfaceMesh& surface, std::vector<int> triangles);
UnitLoad unit_force(const SurfaceMesh& surface, std::vector<int> triangles, const Eigen::Vector3d& force);

/// Total force and moment about the origin of a load of size one.
struct Resultant {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [force]
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< [force * L]
};
/// surface: closed, one solid or several.
Resultant resultant(const SurfaceMesh& surface, const UnitLoad& load);

/// Sizes of all forces of a load of size one, added up [force]: more than its resultant where they balance each other.
double gross_force(const SurfaceMesh& surface, const UnitLoad& load);
/// The same of all loads, of these sizes (one a load).
double gross_force(const SurfaceMesh& surface, std::span<const UnitLoad> loads, const Eigen::VectorXd& factors);

/// Rigid motions a + omega x (p - centre) that vanish at these vertices: a over omega * size, orthonormal columns, 6 x
/// n. `size` makes both parts lengths; about a millionth of it counts as no distance. With no vertices: all six.
Eigen::MatrixXd free_rigid_motions(const Positions& positions, std::span<const int> vertices,
                                   const Eigen::Vector3d& centre, double size);

/// The work that a body's loads of size one do in the rigid motions that its constraints leave free, and how large it
/// would be if nothing cancelled: without both small, nothing holds the body against a sum of the loads.
class FreeWork {
public:
    FreeWork() = default;
    FreeWork(const SurfaceMesh& surface, std::span<const int> constrained, std::span<const UnitLoad> loads);
    /// Whether loads of these sizes (one a load) balance but for rounding: to a millionth of the largest of them.
    bool balanced(const Eigen::VectorXd& factors) const;

private:
    Eigen::MatrixXd work_;     ///< n_motions x n_loads
    Eigen::RowVectorXd size_;  ///< of each load
};

}  // namespace elastolab
