#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "bem/boundary.hpp"

namespace elastolab {

/// Collocation points whose equations are integrated at once: enough for BLAS-3, few beside the matrix.
constexpr int kPointsAtOnce = 192;

/// Calls use(first, strip) for strips of all these collocation points.
template <class Use>
void for_point_strips(const CollocationPoints& points, const Use& use, int at_once = kPointsAtOnce) {
    for (int first = 0; first < points.size(); first += at_once) {
        std::vector<int> numbers(static_cast<std::size_t>(std::min(at_once, points.size() - first)));
        std::iota(numbers.begin(), numbers.end(), first);
        use(first, points.subset(numbers));
    }
}

}  // namespace elastolab
