#include "render/gl/arrays.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

namespace elastolab {

namespace {

struct EdgeUse {
    int low, high;
    bool ascending;
    bool operator<(const EdgeUse& other) const {
        return std::tie(low, high, ascending) < std::tie(other.low, other.high, other.ascending);
    }
};

}  // namespace

Edges unpaired_edges(const TrianglesView& triangles) {
    std::vector<EdgeUse> sides;
    sides.reserve(static_cast<std::size_t>(3 * triangles.cols()));
    for (Eigen::Index t = 0; t < triangles.cols(); ++t)
        for (int i = 0; i < 3; ++i) {
            const int a = triangles(i, t), b = triangles((i + 1) % 3, t);
            sides.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    std::sort(sides.begin(), sides.end());
    std::vector<EdgeUse> unpaired;
    for (auto side = sides.begin(), next = side; side != sides.end(); side = next) {
        while (next != sides.end() && next->low == side->low && next->high == side->high) ++next;
        if (next - side != 2 || side[0].ascending == side[1].ascending) unpaired.push_back(*side);
    }
    Edges result(2, static_cast<Eigen::Index>(unpaired.size()));
    for (Eigen::Index i = 0; i < result.cols(); ++i) {
        const EdgeUse& side = unpaired[static_cast<std::size_t>(i)];
        result.col(i) << side.low, side.high;
    }
    return result;
}

}  // namespace elastolab
