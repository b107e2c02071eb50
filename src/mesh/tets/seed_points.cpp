#include "mesh/tets/seed_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace elastolab {

namespace {

/// Cells are halved until they are no wider than so many wanted edges.
constexpr double kWidestCell = 2.0;
/// A point may help where the wanted edges are kGrown times as long as those of the surface near by, if it is
/// kClearance of those lengths away from every part of the surface: TetGen takes none that lies on a facet.
constexpr double kGrown = 1.6, kClearance = 1.7;
/// Cells looked at, for each vertex, before the search for points is given up.
constexpr std::size_t kMostCells = 20;

struct Box {
    std::array<double, 3> low, high;
};
struct Cell {
    std::array<double, 3> middle;
    double width;
};

Box box_of(const std::vector<double>& vertices) {
    Box box{{vertices[0], vertices[1], vertices[2]}, {vertices[0], vertices[1], vertices[2]}};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        box.low[i % 3] = std::min(box.low[i % 3], vertices[i]);
        box.high[i % 3] = std::max(box.high[i % 3], vertices[i]);
    }
    return box;
}

Cell cell_around(const Box& box) {
    Cell cell{{}, 0.0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        cell.middle[axis] = 0.5 * (box.low[axis] + box.high[axis]);
        cell.width = std::max(cell.width, box.high[axis] - box.low[axis]);
    }
    return cell;
}

bool meet(const Cell& cell, const Box& box) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (cell.middle[axis] + 0.5 * cell.width < box.low[axis] ||
            cell.middle[axis] - 0.5 * cell.width > box.high[axis])
            return false;
    return true;
}

Cell part_of(const Cell& cell, int number) {
    Cell part{cell.middle, 0.5 * cell.width};
    for (std::size_t axis = 0; axis < 3; ++axis)
        part.middle[axis] += ((number >> axis) & 1) != 0 ? 0.25 * cell.width : -0.25 * cell.width;
    return part;
}

}  // namespace

std::vector<double> seed_points(const std::vector<double>& vertices, const SizeField& sizes) {
    std::vector<double> seeds;
    if (vertices.empty()) return seeds;
    const Box box = box_of(vertices);
    std::vector<Cell> cells = {cell_around(box)};
    for (std::size_t n_cells = 0; !cells.empty(); ++n_cells) {
        if (seeds.size() > vertices.size() || n_cells > kMostCells * vertices.size() / 3) return {};
        const Cell cell = cells.back();
        cells.pop_back();
        if (!meet(cell, box)) continue;
        const double* middle = cell.middle.data();
        if (cell.width > kWidestCell * sizes.at(middle)) {
            for (int number = 0; number < 8; ++number) cells.push_back(part_of(cell, number));
        } else if (sizes.grown(middle) >= kGrown && sizes.is_clear(middle, kClearance)) {
            seeds.insert(seeds.end(), cell.middle.begin(), cell.middle.end());
        }
    }
    return seeds;
}

}  // namespace elastolab
