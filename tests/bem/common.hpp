#pragma once

#include <numeric>
#include <vector>

#include "bem/boundary.hpp"
#include "elasticity/material.hpp"

namespace elastolab::test {

inline const Material kUnitMaterial{1.0, 0.3};

inline std::vector<int> all_triangles(const Boundary& boundary) {
    std::vector<int> all(static_cast<std::size_t>(boundary.n_triangles()));
    std::iota(all.begin(), all.end(), 0);
    return all;
}

}  // namespace elastolab::test
