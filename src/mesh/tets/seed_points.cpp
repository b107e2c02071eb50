#include "mesh/tets/seed_points.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace elastolab {

namespace {

/// Cells are halved until they are no wider than so many wanted edges.
constexpr double kWidestCell = 2.0;
/// Where edges are wanted so many times as long as those of the surface near by, it is far enough away.
constexpr double kFarAway = 1.6;

struct Cell {
    std::array<double, 3> middle;
    double width;
};

Cell cell_around(const std::vector<double>& vertices) {
    Cell cell{{}, 0.0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double low = vertices[axis], high = low;
        for (std::size_t i = axis; i < vertices.size(); i += 3) {
            low = std::min(low, vertices[i]);
            high = std::max(high, vertices[i]);
        }
        cell.middle[axis] = 0.5 * (low + high);
        cell.width = std::max(cell.width, high - low);
    }
    return cell;
}

}  // namespace

std::vector<double> seed_points(const std::vector<double>& vertices, const SizeField& sizes) {
    std::vector<double> seeds;
    std::vector<Cell> cells = {cell_around(vertices)};
    while (!cells.empty()) {
        const Cell cell = cells.back();
        cells.pop_back();
        if (cell.width <= kWidestCell * sizes.at(cell.middle.data())) {
            if (sizes.grown(cell.middle.data()) >= kFarAway)
                seeds.insert(seeds.end(), cell.middle.begin(), cell.middle.end());
            continue;
        }
        for (int part = 0; part < 8; ++part) {
            Cell child = cell;
            child.width = 0.5 * cell.width;
            for (std::size_t axis = 0; axis < 3; ++axis)
                child.middle[axis] += ((part >> axis) & 1) != 0 ? 0.25 * cell.width : -0.25 * cell.width;
            cells.push_back(child);
        }
    }
    return seeds;
}

}  // namespace elastolab
