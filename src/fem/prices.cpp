#include "fem/prices.hpp"

#include <algorithm>

#include "fem/forward_elimination.hpp"

namespace elastolab {

namespace {

/// Time of a flop in units of one of the factorisation: the block's and the LU's are alike, a substitution waits for
/// memory.
constexpr double kBlock = 1.0, kLu = 1.0, kSubstitution = 4.0;
/// What a factorisation spends on copying and adding up, in flops for an entry of the factor.
constexpr double kEntry = 300.0;

}  // namespace

FemPrices fem_prices(const SupernodalView& pattern) {
    double entries = 0.0;
    for (int s = 0; s < pattern.n_supernodes(); ++s) {
        const auto i = static_cast<std::size_t>(s);
        const double columns = pattern.super[i + 1] - pattern.super[i],
                     rows = pattern.first_row[i + 1] - pattern.first_row[i];
        entries += columns * (rows - 0.5 * columns);
    }
    return {factorisation_flops(pattern) + kEntry * entries, kSubstitution * 4.0 * entries};
}

BlockPrice block_price(const SupernodalView& pattern, std::span<const int> nodes) {
    const double n = 3.0 * static_cast<double>(nodes.size());
    const CompressedInverseCost block = compressed_inverse_cost(pattern, nodes);
    // The block, the capacitance system and its factor; while the block is made, Y.
    return {kBlock * block.flops + kLu * 2.0 / 3.0 * n * n * n,
            static_cast<std::uint64_t>(16.0 * n * n) + std::max(block.bytes, static_cast<std::uint64_t>(8.0 * n * n))};
}

}  // namespace elastolab
