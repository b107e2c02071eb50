#include "render/scene_frame.hpp"

namespace elastolab {

SceneFrame frame_of(const PositionsView& positions) {
    if (positions.cols() == 0) return {};
    const Eigen::Vector3d low = positions.rowwise().minCoeff(), high = positions.rowwise().maxCoeff();
    const double radius = 0.5 * (high - low).norm();
    return {0.5 * (low + high), radius > 0.0 ? radius : 1.0};
}

}  // namespace elastolab
