#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <functional>
#include <span>

#include "base/control.hpp"
#include "deform/columns.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

/// Bytes that a cache of columns of loads alone may keep: two hundred loads of a surface of 14 000 vertices, or of 4700
/// where there are rows of triangles too.
inline constexpr std::uint64_t kLoadColumnBytes = 64ull << 20;

/// One column for each of these loads, of n_rows rows, from a cache: those that it lacks are computed together, a
/// column each. Waits and throws as ColumnCache::get.
Columns load_columns(ColumnCache& cache, std::span<const UnitLoad> loads, Eigen::Index n_rows,
                     const std::function<Eigen::MatrixXd(std::span<const UnitLoad>)>& compute, const Control& control);

}  // namespace elastolab
