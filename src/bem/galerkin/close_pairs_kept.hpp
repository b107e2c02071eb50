#pragma once

#include <array>
#include <vector>

#include "base/control.hpp"
#include "bem/hierarchical/cluster_tree.hpp"
#include "elasticity/pair_integrals.hpp"

namespace elastolab {

/// The tensor numbers (elasticity/close_pairs.hpp) of every pair of triangles that is too close for a rule of points,
/// integrated once: they cost most of the near field, and triangles at the rim of a cluster are asked for several
/// times.
class KeptClosePairs {
public:
    using Numbers = std::array<double, kPairTensorNumbers>;

    /// tree: of all triangles. Throws Cancelled.
    KeptClosePairs(const PairIntegrals& integrals, std::span<const TriangleGeometry> triangles, const ClusterTree& tree,
                   Control& control);

    /// The numbers of two triangles for which PairIntegrals::is_close.
    const Numbers& of(int t, int s) const;

private:
    struct Pair {
        int later;  ///< position of the later triangle
        Numbers numbers;
    };
    std::vector<int> positions_;
    std::vector<std::vector<Pair>> pairs_;  ///< by position of the earlier triangle, ascending
};

}  // namespace elastolab
