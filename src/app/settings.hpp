#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/input/navigation.hpp"
#include "app/unit_names.hpp"
#include "deform/method.hpp"
#include "methods/registry.hpp"
#include "render/colour_map.hpp"
#include "render/geometry/picking.hpp"
#include "render/surface_material.hpp"
#include "scene/live/simulation.hpp"
#include "scene/shown.hpp"

namespace elastolab {

enum class Tool { pull, brush, box, probe, force, pressure };
enum class Release { pin, spring_back };

/// How the cursor moves what is pulled: in the plane of the screen, along a direction, or otherwise. Through a spring:
/// a patch that is grabbed anew, or is under a force already, gives way as a real body does.
enum class PullMode { plane, normal, axis_x, axis_y, axis_z, turn, scale, spring };

/// The axes by which a handle's gizmo moves and turns it: those of the world, those of the surface there (the third is
/// its normal), or the world's turned as the handle was.
enum class GizmoAxes { world, surface, own };

struct ToolSettings {
    Tool tool = Tool::pull;
    PullMode pull_mode = PullMode::plane;  ///< where no key asks for another
    Navigation navigation = Navigation::standard;
    bool gizmo = true;  ///< arrows and rings at the selected handle
    GizmoAxes gizmo_axes = GizmoAxes::world;
    bool snap = false;  ///< pulls go in round steps
    Release release = Release::pin;
    double patch_radius = 0.0;   ///< [L]; 0: a single vertex
    double pressure = 0.0;       ///< that the brush puts on [force / L^2]
    double spring = 0.0;         ///< stiffness of the spring that pulls [force / L]
    double brush_pixels = 24.0;  ///< radius on the screen
    Reach box_reach = Reach::visible;
};

/// What a film shows: one turn around the body, or the pull, from rest to where it is and back.
enum class FilmKind { turn, pull };

enum class CompareMode { off, side_by_side, ghosts };

struct CompareSettings {
    CompareMode mode = CompareMode::off;
    std::vector<MethodKind> kinds{compared_methods().begin(), compared_methods().end()};  ///< shown when comparing
    bool chosen = false;                      ///< by hand, so that they stay
    MethodKind reference = default_method();  ///< differences are to this one
};

struct DisplaySettings {
    Field field = Field::none;
    std::string colour_map = "lagoon", signed_colour_map = "balance";  ///< the second where is_signed(field)
    double range_part = 1.0;   ///< of the data in the automatic range; what is more extreme has the colour of its end
    bool hold_range = false;   ///< while something is pulled
    bool logarithmic = false;  ///< colours, where !is_signed(field)
    /// Lowest and highest value, in the unit of the field; of a field that is not among them the range is automatic.
    std::map<Field, std::pair<double, double>> typed_ranges;
    bool bands = false;
    bool extremes = false;  ///< marks where the field is largest and, of either sign, smallest
    bool flat = false;
    SurfaceMaterial material = SurfaceMaterial::studio;
    bool wireframe = true;
    bool feature_edges = true;
    bool rest_shape = true;   ///< a ghost of the body at rest, where it was deformed
    bool constraints = true;  ///< points at fixed vertices and handles
    bool arrows = false;      ///< reaction forces
    bool grid = true;
    bool defects = true;       ///< where the surface is not closed
    bool soft_shadows = true;  ///< ambient occlusion, and a shadow on the ground
    double deformation_scale = 1.0;
    bool section = false;  ///< the body is opened by `cut`
    Cut cut = {};
    bool section_gizmo = true;  ///< the plane can be moved and turned with the mouse
    bool dark = true;
    float ui_scale = 1.0f;
    UnitNames units = {};
    bool panel = true;         ///< the panel at the side is seen
    double panel_width = 0.0;  ///< [logical pixels of scale 1]; 0: by the window's width

    bool operator==(const DisplaySettings&) const = default;
};

/// What of it belongs to the scene, and the other way round: everything else stays.
Shown shown_by(const DisplaySettings& display);
void show(const Shown& shown, DisplaySettings& display);

/// The colours of the field that is shown.
const ColourMap& shown_colour_map(const DisplaySettings& display);

}  // namespace elastolab
