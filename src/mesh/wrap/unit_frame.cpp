#include "mesh/wrap/unit_frame.hpp"

#include <Eigen/Geometry>

#include "base/error.hpp"

namespace elastolab {

UnitFrame to_unit_size(SurfaceMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const int v : mesh.triangles.reshaped()) box.extend(mesh.vertices.col(v));
    const double size = box.isEmpty() ? 0.0 : box.diagonal().stableNorm();
    if (!(size > 0.0))
        throw MeshError("it has no three vertices that are not on a line. Choose a file with a surface.");
    UnitFrame frame{box.min() + 0.5 * box.diagonal(), size};
    mesh.vertices = (mesh.vertices.colwise() - frame.centre) / size;
    return frame;
}

}  // namespace elastolab
