#pragma once

#include <Eigen/Core>

namespace elastolab {

/// Implemented by an Interior whose elements are of second degree: its tetrahedra are parts of them, on the same nodes.
class TenNodeElements {
public:
    virtual ~TenNodeElements() = default;

    /// 10 x n: the corners, then the midpoints of the edges 01 02 03 12 13 23.
    virtual Eigen::MatrixXi ten_node_elements() const = 0;
};

}  // namespace elastolab
