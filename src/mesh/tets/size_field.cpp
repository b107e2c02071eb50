#include "mesh/tets/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace elastolab {

namespace {

double distance(const double* a, const double* b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

double distance_to_box(const double* point, const double* low, const double* high) {
    double nearest[3];
    for (std::size_t axis = 0; axis < 3; ++axis) nearest[axis] = std::clamp(point[axis], low[axis], high[axis]);
    return distance(point, nearest);
}

/// Mean length of the edges at each vertex, or of all edges where that is more. Edges are counted by triangles: those
/// of a closed surface twice.
std::vector<double> sizes_at_vertices(const std::vector<double>& vertices, const std::vector<int>& triangles) {
    std::vector<double> sum(vertices.size() / 3, 0.0);
    std::vector<int> count(sum.size(), 0);
    const auto index = [](int i) { return static_cast<std::size_t>(i); };
    for (std::size_t t = 0; t < triangles.size(); t += 3)
        for (std::size_t i = 0; i < 3; ++i) {
            const int a = triangles[t + i], b = triangles[t + (i + 1) % 3];
            const double length = distance(&vertices[3 * index(a)], &vertices[3 * index(b)]);
            for (const int v : {a, b}) {
                sum[index(v)] += length;
                ++count[index(v)];
            }
        }
    const double all = std::accumulate(sum.begin(), sum.end(), 0.0) / 2.0 / static_cast<double>(triangles.size());
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] = std::max(sum[v] / std::max(count[v], 1), all);
    return sum;
}

}  // namespace

SizeField::SizeField(const std::vector<double>& vertices, const std::vector<int>& triangles, double growth)
    : growth_(growth), nodes_(vertices.size() / 3) {
    const std::vector<double> sizes = sizes_at_vertices(vertices, triangles);
    std::vector<Sample> samples(sizes.size());
    for (std::size_t v = 0; v < sizes.size(); ++v) {
        std::copy_n(&vertices[3 * v], 3, samples[v].point);
        samples[v].size = sizes[v];
    }
    build(samples, 0, samples.size(), 0);
}

void SizeField::build(std::vector<Sample>& samples, std::size_t begin, std::size_t end, std::size_t node) {
    if (begin == end) return;
    Node& n = nodes_[node];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        n.low[axis] = n.high[axis] = samples[begin].point[axis];
        for (std::size_t i = begin; i < end; ++i) {
            n.low[axis] = std::min(n.low[axis], samples[i].point[axis]);
            n.high[axis] = std::max(n.high[axis], samples[i].point[axis]);
        }
    }
    n.least = std::numeric_limits<double>::max();
    n.most = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
        n.least = std::min(n.least, samples[i].size);
        n.most = std::max(n.most, samples[i].size);
    }
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (n.high[axis] - n.low[axis] > n.high[longest] - n.low[longest]) longest = axis;
    // As many to the left as make the tree complete, so that its nodes fill the array.
    const std::size_t count = end - begin;
    std::size_t full = 1;
    while (2 * full <= count) full *= 2;
    const std::size_t left = full == 1 ? 0 : std::min(full - 1, count - full / 2);
    const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(begin + left);
    std::nth_element(samples.begin() + static_cast<std::ptrdiff_t>(begin), middle,
                     samples.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](const Sample& a, const Sample& b) { return a.point[longest] < b.point[longest]; });
    std::copy_n(middle->point, 3, n.point);
    n.size = middle->size;
    build(samples, begin, begin + left, 2 * node + 1);
    build(samples, begin + left + 1, end, 2 * node + 2);
}

double SizeField::bound(const double* point, const Node& node) const {
    return node.least + growth_ * distance_to_box(point, node.low, node.high);
}

bool SizeField::is_clear(const double* point, double lengths, std::size_t node) const {
    if (node >= nodes_.size()) return true;
    const Node& n = nodes_[node];
    if (distance_to_box(point, n.low, n.high) > lengths * n.most) return true;
    return distance(point, n.point) > lengths * n.size && is_clear(point, lengths, 2 * node + 1) &&
           is_clear(point, lengths, 2 * node + 2);
}

void SizeField::search(const double* point, std::size_t node, Nearest& best) const {
    const Node& n = nodes_[node];
    if (const double wanted = n.size + growth_ * distance(point, n.point); wanted < best.wanted)
        best = {wanted, n.size};
    std::size_t first = 2 * node + 1, second = first + 1;
    if (first >= nodes_.size()) return;
    double first_bound = bound(point, nodes_[first]);
    double second_bound = second < nodes_.size() ? bound(point, nodes_[second]) : std::numeric_limits<double>::max();
    if (second_bound < first_bound) {
        std::swap(first, second);
        std::swap(first_bound, second_bound);
    }
    if (first_bound < best.wanted) search(point, first, best);
    if (second_bound < best.wanted) search(point, second, best);
}

SizeField::Nearest SizeField::nearest(const double* point) const {
    Nearest best{std::numeric_limits<double>::max(), 1.0};
    search(point, 0, best);
    return best;
}

double SizeField::grown(const double* point) const {
    const Nearest found = nearest(point);
    return found.wanted / found.own;
}

}  // namespace elastolab
