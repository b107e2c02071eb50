#pragma once

#include "mesh/primitives.hpp"

namespace elastolab::test {

/// One long, in five cells.
inline SurfaceMesh bar_of_section(double width, double height) {
    SurfaceMesh bar = make_box(1, {5, 1, 1});
    bar.vertices = Eigen::Vector3d(0.2, width, height).asDiagonal() * bar.vertices;
    return bar;
}

}  // namespace elastolab::test
