#include "render/scene_frame.hpp"

namespace elastolab {

SceneFrame frame_of(const PositionsView& positions) {
    if (positions.cols() == 0) return {};
    const Eigen::Vector3d low = positions.rowwise().minCoeff(), high = positions.rowwise().maxCoeff();
    const double radius = 0.5 * (high - low).norm();
    return {0.5 * (low + high), radius > 0.0 ? radius : 1.0};
}

SceneFrame united(const SceneFrame& a, const SceneFrame& b) {
    const double distance = (b.center - a.center).norm();
    if (distance + b.radius <= a.radius) return a;
    if (distance + a.radius <= b.radius) return b;
    const double radius = 0.5 * (a.radius + distance + b.radius);
    return {a.center + (b.center - a.center) * ((radius - a.radius) / distance), radius};
}

}  // namespace elastolab
