#pragma once

#include <Eigen/Core>
#include <string>

namespace elastolab {

/// Values at the vertices, or in the cells, of a mesh that is written to a file.
struct MeshField {
    std::string name;  ///< a word, such as "displacement": letters, digits and '_'
    /// One column each: n_components x n. 1 component: a scalar; 3: a vector; 6: a symmetric tensor in the order of VTK
    /// and ParaView, xx yy zz xy yz xz.
    Eigen::MatrixXd values;
};

/// What a component is called: "displacement_x", "stress_xy"; a scalar has the field's own name.
std::string component_name(const MeshField& field, int component);

}  // namespace elastolab
