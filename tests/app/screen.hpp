#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "app/input/gizmo.hpp"
#include "app/viewer_state.hpp"

namespace elastolab::test {

/// What the program shows at its start in a window of this size: its own camera and layout, computed here.
class Screen {
public:
    explicit Screen(const std::filesystem::path& scene, const Eigen::Vector2i& window = {1000, 700});

    const SurfaceMesh& mesh() const { return state_.scene().mesh(); }
    /// The part of the window that shows the scene, and places in the window [pixels].
    const Viewport& place() const { return place_; }
    Eigen::Vector2d pixel(const Eigen::Vector3d& point) const { return state_.camera.project(point, place_).pixel; }

    Gizmo gizmo(int handle) const { return handle_gizmo(state_.scene(), handle, mesh().vertices, GizmoAxes::world); }
    /// Of the cut that the panel begins with.
    Gizmo plane_gizmo() const { return elastolab::plane_gizmo(mesh().vertices, state_.display); }
    std::vector<Eigen::Vector2d> outline(const Gizmo& gizmo, const GizmoPart& part) const {
        return elastolab::outline(gizmo, part, state_.camera, place_);
    }
    /// Whether a press here takes hold of this part.
    bool takes(const Gizmo& gizmo, const GizmoPart& part, const Eigen::Vector2d& cursor) const {
        return part_at(gizmo, state_.camera, place_, cursor) == part;
    }
    double dragged(const Gizmo& gizmo, const GizmoPart& part, const Eigen::Vector2d& from,
                   const Eigen::Vector2d& to) const {
        return elastolab::dragged(gizmo, part, state_.camera, place_, from, to);
    }

private:
    ViewerState state_{[] {}};
    Viewport place_;
};

}  // namespace elastolab::test
