#include "app/input/default_support.hpp"

#include "mesh/primitives.hpp"

namespace elastolab {

Selector default_support(const Primitive& primitive) {
    const SurfaceMesh mesh = make_primitive(primitive.name, primitive.resolution, primitive.size);
    const bool at_left = primitive.name == "cube" || primitive.name == "box" || primitive.name == "beam";
    const int axis = at_left ? 0 : 2;
    const double low = mesh.vertices.row(axis).minCoeff(), high = mesh.vertices.row(axis).maxCoeff();
    const bool is_flat = at_left || primitive.name == "cylinder";
    return {PlaneSelector{low * Eigen::Vector3d::Unit(axis), Eigen::Vector3d::Unit(axis),
                          (is_flat ? 1e-6 : 0.12) * (high - low)}};
}

}  // namespace elastolab
