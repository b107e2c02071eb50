#include "study/error/study_bar.hpp"

#include "mesh/primitives.hpp"

namespace elastolab {

SurfaceMesh study_bar(int cells, bool irregular) {
    constexpr double kOnFace = 1e-9;
    const Eigen::Vector3d size(2.0, 1.0, 1.0);
    SurfaceMesh mesh = make_box(cells, size);
    Jitter jitter;
    for (auto x : mesh.vertices.colwise())
        for (int axis = 0; irregular && axis < 3; ++axis)
            if (x[axis] > kOnFace && x[axis] < size[axis] - kOnFace) x[axis] += kJitter / cells * jitter();
    return mesh;
}

}  // namespace elastolab
