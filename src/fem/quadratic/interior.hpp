#pragma once

#include "deform/ten_node_elements.hpp"
#include "fem/interior.hpp"

namespace elastolab {

/// The inside of a solid of ten-node tetrahedra, which are split in eight.
class QuadraticFemInterior : public FemInterior, public TenNodeElements {
public:
    using FemInterior::FemInterior;
    Eigen::MatrixXi ten_node_elements() const override;
};

}  // namespace elastolab
