#pragma once

#include <cstdint>
#include <span>

#include "fem/sparse_cholesky.hpp"

namespace elastolab {

/// What a constrained set costs on demand, in flops of a sparse factorisation; steps that are faster or slower count
/// accordingly. By this arithmetic alone, not by the clock: the same set is treated alike everywhere.
struct FemPrices {
    double factorisation = 0.0;  ///< of K with some nodes eliminated, or grounded
    double solve = 0.0;          ///< one column for all nodes
};
FemPrices fem_prices(const SupernodalView& pattern);

/// The block of the compliance between these nodes, and the factorisation of a dense system of their size.
struct BlockPrice {
    double price = 0.0;
    std::uint64_t bytes = 0;  ///< at its peak
};
BlockPrice block_price(const SupernodalView& pattern, std::span<const int> nodes);

/// Columns are computed and kept where they cost at most this: then a solve is a product with them, which costs next to
/// nothing, and the next set reuses those of the vertices that it shares with the last. Dearer ones are not kept: the
/// block between the vertices and one substitution for each solve cost less.
inline constexpr double kColumnsWorthKeeping = 1e9;

}  // namespace elastolab
