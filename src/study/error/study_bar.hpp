#pragma once

#include <random>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Uniform in [-1, 1], the same on every machine.
class Jitter {
public:
    double operator()() {
        return 2.0 * static_cast<double>(random_()) / static_cast<double>(std::mt19937::max()) - 1.0;
    }

private:
    std::mt19937 random_{31};
};

inline constexpr double kJitter = 0.25;  ///< how far vertices are moved at random, of a cell

/// A bar of 2 x 1 x 1 from the origin. irregular: vertices moved at random in their faces.
SurfaceMesh study_bar(int cells, bool irregular);

}  // namespace elastolab
