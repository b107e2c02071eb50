#include "petsc/share.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "fem/quadratic_mesh.hpp"

namespace elastolab {

namespace {

/// Orders nodes [begin, end) so that parts [first, first + count) of equal size follow each other.
void bisect(const Positions& positions, std::span<int> nodes, int count, std::vector<int>& sizes) {
    if (count == 1) {
        std::sort(nodes.begin(), nodes.end());
        sizes.push_back(static_cast<int>(nodes.size()));
        return;
    }
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
    for (const int node : nodes) {
        low = low.cwiseMin(positions.col(node));
        high = high.cwiseMax(positions.col(node));
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const std::size_t n_first = nodes.size() * static_cast<std::size_t>(count / 2) / static_cast<std::size_t>(count);
    const auto before = [&](int a, int b) {
        const double x = positions(axis, a), y = positions(axis, b);
        return x < y || (x == y && a < b);
    };
    std::nth_element(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(n_first), nodes.end(), before);
    bisect(positions, nodes.first(n_first), count / 2, sizes);
    bisect(positions, nodes.subspan(n_first), count - count / 2, sizes);
}

/// Places of new numbers in a sorted list of them.
int place_of(const std::vector<int>& nodes, int number) {
    return static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), number) - nodes.begin());
}

/// The six tetrahedra of a cell around its diagonal, as paths from one end of it to the other along the axes.
constexpr std::array<std::array<int, 3>, 6> kPaths = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

/// Corners of a tetrahedron of the cell at this place, positively oriented.
std::array<Eigen::Vector3i, 4> corners_of(const Eigen::Vector3i& cell, std::size_t path) {
    std::array<Eigen::Vector3i, 4> corners = {cell, cell, cell, cell};
    for (std::size_t i = 1; i < 4; ++i) {
        corners[i] = corners[i - 1];
        ++corners[i][kPaths[path][i - 1]];
    }
    if (path >= 3) std::swap(corners[1], corners[2]);
    return corners;
}

}  // namespace

Partition partition_nodes(const Positions& positions, int n_processes) {
    Partition partition;
    partition.order.resize(static_cast<std::size_t>(positions.cols()));
    std::iota(partition.order.begin(), partition.order.end(), 0);
    std::vector<int> sizes;
    bisect(positions, partition.order, n_processes, sizes);
    partition.number.resize(partition.order.size());
    for (std::size_t i = 0; i < partition.order.size(); ++i)
        partition.number[static_cast<std::size_t>(partition.order[i])] = static_cast<int>(i);
    partition.begin.push_back(0);
    for (const int size : sizes) partition.begin.push_back(partition.begin.back() + size);
    return partition;
}

Share share_of(int process, const Partition& partition, const Positions& positions,
               const Eigen::Ref<const Eigen::MatrixXi>& elements, double poisson_ratio) {
    const auto p = static_cast<std::size_t>(process);
    const int first = partition.begin[p], end = partition.begin[p + 1];
    const auto number = [&](int node) { return partition.number[static_cast<std::size_t>(node)]; };
    std::vector<int> mine;
    std::vector<char> needed(partition.order.size(), 0);
    for (int i = first; i < end; ++i) needed[static_cast<std::size_t>(i)] = 1;
    for (int t = 0; t < static_cast<int>(elements.cols()); ++t) {
        const auto nodes = elements.col(t);
        if (std::none_of(nodes.begin(), nodes.end(), [&](int v) { return number(v) >= first && number(v) < end; }))
            continue;
        mine.push_back(t);
        for (const int v : nodes) needed[static_cast<std::size_t>(number(v))] = 1;
    }
    Share share{.poisson_ratio = poisson_ratio,
                .n_all = static_cast<int>(partition.order.size()),
                .first = first,
                .n_own = end - first,
                .nodes = {},
                .positions = {},
                .elements = {},
                .own_counts = {}};
    for (std::size_t i = 0; i < needed.size(); ++i)
        if (needed[i] != 0) share.nodes.push_back(static_cast<int>(i));
    share.positions.resize(3, std::ssize(share.nodes));
    for (std::size_t i = 0; i < share.nodes.size(); ++i)
        share.positions.col(static_cast<Eigen::Index>(i)) =
            positions.col(partition.order[static_cast<std::size_t>(share.nodes[i])]);
    share.elements.resize(elements.rows(), std::ssize(mine));
    for (std::size_t t = 0; t < mine.size(); ++t)
        for (Eigen::Index a = 0; a < elements.rows(); ++a)
            share.elements(a, static_cast<Eigen::Index>(t)) = place_of(share.nodes, number(elements(a, mine[t])));
    return share;
}

Share share_of_grid(int process, int n_processes, int cells, ElementDegree degree, double poisson_ratio) {
    const int step = degree == ElementDegree::quadratic ? 2 : 1, n = step * cells + 1, n_corners = 4;
    const auto layer_of = [&](int p) { return static_cast<int>(static_cast<std::int64_t>(n) * p / n_processes); };
    const int from = layer_of(process), to = layer_of(process + 1);  // layers of nodes
    Share share;
    share.poisson_ratio = poisson_ratio;
    share.n_all = n * n * n;
    share.first = n * n * from;
    share.n_own = n * n * (to - from);
    for (int p = 0; p < n_processes; ++p) share.own_counts.push_back(n * n * (layer_of(p + 1) - layer_of(p)));
    // Cells that touch these layers, and the layers that these cells touch.
    const int low = std::max(0, (from - 1) / step), high = std::min(cells, (to - 1) / step + 1);
    const int bottom = step * low, top = step * high;
    if (from == to) return share;
    share.positions.resize(3, static_cast<Eigen::Index>(n) * n * (top - bottom + 1));
    for (int z = bottom, i = 0; z <= top; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x, ++i) {
                share.nodes.push_back(x + n * (y + n * z));
                share.positions.col(i) = Eigen::Vector3d(x, y, z) / (n - 1);
            }
    const auto place = [&](const Eigen::Vector3i& at) { return at[0] + n * (at[1] + n * (at[2] - bottom)); };
    share.elements.resize(step == 2 ? 10 : 4, 6 * static_cast<Eigen::Index>(cells) * cells * (high - low));
    Eigen::Index t = 0;
    for (int z = low; z < high; ++z)
        for (int y = 0; y < cells; ++y)
            for (int x = 0; x < cells; ++x)
                for (std::size_t path = 0; path < kPaths.size(); ++path, ++t) {
                    const std::array<Eigen::Vector3i, 4> corners = corners_of({x, y, z}, path);
                    for (int a = 0; a < n_corners; ++a)
                        share.elements(a, t) = place(step * corners[static_cast<std::size_t>(a)]);
                    for (int e = 0; e < (step == 2 ? 6 : 0); ++e)
                        share.elements(4 + e, t) = place(corners[static_cast<std::size_t>(kTetEdges[e][0])] +
                                                         corners[static_cast<std::size_t>(kTetEdges[e][1])]);
                }
    return share;
}

}  // namespace elastolab
