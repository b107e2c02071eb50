#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "deform/method.hpp"
#include "methods/registry.hpp"
#include "render/geometry/picking.hpp"
#include "scene/live/simulation.hpp"

namespace elastolab {

enum class Tool { pull, brush, box };
enum class Release { pin, spring_back };

struct ToolSettings {
    Tool tool = Tool::pull;
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
    bool flat = false;
    bool wireframe = true;
    bool feature_edges = true;
    bool rest_shape = false;  ///< wireframe of the body at rest
    bool constraints = true;  ///< points at fixed vertices and handles
    bool arrows = false;      ///< reaction forces
    bool grid = true;
    double deformation_scale = 1.0;
    bool section = false;
    int section_axis = 0;
    double section_turn = 0.0, section_tilt = 0.0;  ///< of the plane, from the axis [degree]
    double section_place = 0.5;                     ///< 0 to 1 along its normal, through the body
    bool section_flip = false;
    bool dark = true;
    float ui_scale = 1.0f;

    bool operator==(const DisplaySettings&) const = default;
};

}  // namespace elastolab
