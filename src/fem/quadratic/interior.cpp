#include "fem/quadratic/interior.hpp"

#include "fem/quadratic_mesh.hpp"

namespace elastolab {

Eigen::MatrixXi QuadraticFemInterior::ten_node_elements() const { return rejoined(tetrahedra()); }

}  // namespace elastolab
