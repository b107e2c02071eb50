#include "app/picture/view_point.hpp"

namespace elastolab {

namespace {

constexpr double kNearest = 0.99e-4, kFarthest = 1.01e3;  ///< distance / scene radius

}  // namespace

/// The eye as in perspective, so that a view is one for every projection.
ViewPoint view_point_of(const Camera& camera) {
    const CameraPose& pose = camera.pose();
    return {.eye = pose.target + pose.distance * camera.backward(),
            .target = pose.target,
            .up = camera.up(),
            .vertical = camera.up_axis()};
}

bool can_see(const ViewPoint& view, const SceneFrame& scene) {
    const double distance = (view.eye - view.target).stableNorm(), off = (view.target - scene.center).stableNorm();
    return distance >= kNearest * scene.radius && distance <= kFarthest * scene.radius &&
           off <= kFarthest * scene.radius;
}

void look_from(const ViewPoint& view, Camera& camera) {
    const Eigen::Vector3d backward = view.eye - view.target;
    camera.set_up_axis(view.vertical.stableNormalized());
    camera.set_pose({.target = view.target, .distance = backward.stableNorm()});
    camera.look_from(backward.stableNormalized(), view.up.stableNormalized());
}

}  // namespace elastolab
