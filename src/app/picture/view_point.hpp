#pragma once

#include "render/camera.hpp"
#include "scene/document.hpp"

namespace elastolab {

/// The camera as a scene file has it, and back. There and back again changes it by rounding only.
ViewPoint view_point_of(const Camera& camera);
void look_from(const ViewPoint& view, Camera& camera);
/// Whether a camera there is within the distances to this ball that Camera::zoom_to allows.
bool can_see(const ViewPoint& view, const SceneFrame& scene);

}  // namespace elastolab
