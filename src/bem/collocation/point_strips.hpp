#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "bem/boundary.hpp"

namespace elastolab {

/// Sources whose equations are integrated at once: enough for BLAS-3, few beside the matrix.
constexpr int kSourcesAtOnce = 192;

/// Calls use(first, strip) for strips of all these sources.
template <class Use>
void for_source_strips(const Sources& sources, const Use& use, int at_once = kSourcesAtOnce) {
    for (int first = 0; first < sources.size(); first += at_once) {
        std::vector<int> numbers(static_cast<std::size_t>(std::min(at_once, sources.size() - first)));
        std::iota(numbers.begin(), numbers.end(), first);
        use(first, sources.subset(numbers));
    }
}

}  // namespace elastolab
