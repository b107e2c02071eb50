#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "deform/method.hpp"
#include "methods/registry.hpp"
#include "render/geometry/picking.hpp"
#include "scene/live/simulation.hpp"

namespace elastolab {

enum class Tool { pull, brush, box, probe };
enum class Release { pin, spring_back };

/// How the cursor moves what is pulled: in the plane of the screen, along a direction, or otherwise.
enum class PullMode { plane, normal, axis_x, axis_y, axis_z, turn, scale };

struct ToolSettings {
    Tool tool = Tool::pull;
    PullMode pull_mode = PullMode::plane;  ///< where no key asks for another
    Release release = Release::pin;
    double patch_radius = 0.0;   ///< [L]; 0: a single vertex
    double brush_pixels = 24.0;  ///< radius on the screen
    Reach box_reach = Reach::visible;
};

enum class CompareMode { off, side_by_side, ghosts };

struct CompareSettings {
    CompareMode mode = CompareMode::off;
    std::vector<MethodKind> kinds{kFem, kConstantBem, kLinearBem};  ///< shown when comparing
    MethodKind reference = default_method();                        ///< differences are to this one
};

enum class Field { none, displacement, difference, traction, von_mises };

struct DisplaySettings {
    Field field = Field::none;
    std::string colour_map = "lagoon";
    bool auto_range = true;
    double range_low = 0.0, range_high = 1.0;  ///< when not automatic, in the unit of the field
    bool bands = false;
    bool extremes = false;  ///< a mark where the field is largest
    bool flat = false;
    bool wireframe = true;
    bool feature_edges = true;
    bool rest_shape = true;   ///< a ghost of the body at rest, where it was deformed
    bool constraints = true;  ///< points at fixed vertices and handles
    bool arrows = false;      ///< reaction forces
    bool grid = true;
    bool defects = true;       ///< where the surface is not closed
    bool soft_shadows = true;  ///< ambient occlusion, and a shadow on the ground
    double deformation_scale = 1.0;
    bool section = false;
    int section_axis = 0;
    double section_turn = 0.0, section_tilt = 0.0;  ///< of the plane, from the axis [degree]
    double section_place = 0.5;                     ///< 0 to 1 along its normal, through the body
    bool section_flip = false;
    bool dark = true;
    float ui_scale = 1.0f;
    bool panel = true;         ///< the panel at the side is seen
    double panel_width = 0.0;  ///< [logical pixels of scale 1]; 0: by the window's width

    bool operator==(const DisplaySettings&) const = default;
};

}  // namespace elastolab
