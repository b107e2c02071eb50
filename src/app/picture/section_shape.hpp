#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "app/settings.hpp"
#include "mesh/section/cap.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The plane by which the body is to be cut open; what its normal points away from is kept.
Plane section_plane(const Positions& rest, const DisplaySettings& display);
/// The axes, of unit length, that its turn and its tilt go about.
Eigen::Matrix<double, 3, 2> section_hinges(const DisplaySettings& display);

/// A body at rest, cut open and closed by a cap. Vertices are, in this order: those of the whole surface (some of no
/// triangle any more), those on cut edges and on the cap's rim, and those inside the body. Skin and cap share none.
/// Where the surface is closed by what fills its holes, those triangles come last and stay apart.
class SectionShape {
public:
    /// The last `n_filling` triangles of the surface fill its holes.
    SectionShape(std::shared_ptr<const SurfaceMesh> surface, const Plane& plane, int n_filling = 0);

    const Plane& plane() const { return plane_; }
    const std::shared_ptr<const SurfaceMesh>& surface() const { return surface_; }
    const Triangles& triangles() const { return triangles_; }  ///< of skin and cap
    const Triangles& filling() const { return filling_; }      ///< what is left of the filling; of the same vertices
    const Positions& rest() const { return rest_; }
    /// The vertices inside, 3 x n.
    const Positions& inside() const { return inside_; }
    Eigen::Index n_inside() const { return inside_.cols(); }
    bool is_empty() const { return triangles_.cols() == 0; }

    /// Values of all vertices from those of the surface's (rows x n_vertices) and those inside (rows x n_inside).
    Eigen::MatrixXd joined(const Eigen::Ref<const Eigen::MatrixXd>& of_surface,
                           const Eigen::Ref<const Eigen::MatrixXd>& inside) const;
    /// Values inside that follow smoothly from those of the surface.
    Eigen::MatrixXd spread_from_rim(const Eigen::Ref<const Eigen::MatrixXd>& of_surface) const;
    /// Fills the columns of values inside (rows x n_inside) that are not known yet from those that are, one at least.
    void fill(const std::vector<char>& known, Eigen::MatrixXd& inside) const;

private:
    /// of_cap: columns for the vertices of the cap, of which some are known.
    void relax(std::vector<char> known, Eigen::MatrixXd& of_cap) const;

    std::shared_ptr<const SurfaceMesh> surface_;
    Plane plane_;
    Anchors between_;  ///< vertices on cut edges, then those on the rim
    Eigen::Index n_rim_ = 0;
    Positions inside_, rest_;
    Triangles triangles_, filling_;
    std::vector<std::vector<int>> around_;  ///< for each vertex of the cap those next to it; rim first
};

}  // namespace elastolab
