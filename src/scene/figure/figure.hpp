#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "deform/deformer.hpp"
#include "scene/constraints.hpp"
#include "scene/field_export.hpp"

namespace elastolab {

/// How the body answers to one handle: columns for a shift along x, y, z and a turn about x, y, z through `centre`,
/// that is u = p_1 e_x + p_2 e_y + p_3 e_z + (p_4, p_5, p_6) x (x - centre) at the handle's vertices.
struct FigureHandle {
    std::string name;
    std::vector<int> vertices;
    Eigen::Vector3d centre;        ///< mean of the vertices that are simulated [L]
    Eigen::MatrixXd displacement;  ///< 3*n_vertices x 6
    Eigen::MatrixXd stress;        ///< 6*n_vertices x 6, StressNumbers of the surface (deform/surface_stress.hpp)
};

/// A solved body that can be pulled on: as answers are linear, it is exact.
struct Figure {
    std::string title, method;
    std::shared_ptr<const SurfaceMesh> surface;  ///< that of the scene, to whose vertices all numbers belong
    Eigen::Vector3d vertical;                    ///< the axis that points up
    std::vector<int> fixed;                      ///< vertices
    Eigen::VectorXd displacement;                ///< of the scene as it is, 3*n_vertices [L]
    Eigen::VectorXd stress;                      ///< likewise, 6*n_vertices [force / L^2]
    std::vector<FigureHandle> handles;
};

/// The handles among the groups of a set (Constraints::groups) that have vertices on what is simulated.
std::vector<ConstraintGroup> pulled_handles(const ConstrainedSet& set, const std::vector<ConstraintGroup>& groups);

/// What a figure is for: to be pulled; or to be shown as it is, and pulled where there is a handle.
enum class FigureUse { pull, show };

/// Why no figure can be made by this method, with a way forward; empty when one can. n_causes: handles, and loads where
/// it is to be shown.
std::string figure_refusal(MethodKind method, std::size_t n_causes);

/// groups: those of the deformer's set (Constraints::groups). Six solves for each handle. On a proxy, shown vertices
/// follow their places on it. Throws Error where none can be made (figure_refusal), where the file would be
/// beyond kLargestFigure, or numbers beyond single precision; SolveError, Cancelled.
Figure make_figure(const SolvedBody& solved, const std::vector<ConstraintGroup>& groups,
                   const Eigen::Vector3d& vertical, FigureUse use, Control& control);
inline constexpr double kLargestFigure = 200e6;  ///< bytes

/// Where the origin of a file in single precision is to be: that of the scene or, of a body that is far from it beside
/// its size, its middle, since vertices would fall together.
Eigen::Vector3d single_precision_origin(const Positions& positions);

/// One HTML file that needs no network: the body can be pulled, turned and looked at in a browser, coloured by
/// displacement or von Mises stress. Numbers are in single precision.
void write_figure(std::ostream& out, const Figure& figure);

/// Whether a file is called like a figure (.html).
bool is_figure_file(const std::filesystem::path& file);

}  // namespace elastolab
