#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

namespace elastolab {

/// Values at the vertices, or in the cells, of a mesh that is written to a file.
struct MeshField {
    std::string name;  ///< a word, such as "displacement": letters, digits and '_'
    /// One column each: n_components x n. 1 component: a scalar; 3: a vector; 6: a symmetric tensor in the order of VTK
    /// and ParaView, xx yy zz xy yz xz.
    Eigen::MatrixXd values;
    std::string unit = {};  ///< in L, the unit of length of the mesh, and F, that of force: "F/L^2"
};

/// What is said of the whole of a file: a word and a number or a text.
struct FileFact {
    std::string name;
    std::variant<double, std::string> value;
};
using FileFacts = std::vector<FileFact>;

/// What a component is called: "displacement_x", "stress_xy"; a scalar has the field's own name.
std::string component_name(const MeshField& field, int component);

}  // namespace elastolab
