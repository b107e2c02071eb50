#include "fem/constrained_nodes.hpp"

#include <algorithm>

namespace elastolab {

namespace {

/// A prescribed midpoint, and the constrained vertices (by their place in the list) that it lies between.
struct Midpoint {
    int node = 0, a = 0, b = 0;
    bool operator<(const Midpoint& other) const { return node < other.node; }
    bool operator==(const Midpoint& other) const { return node == other.node; }
};

/// Midpoints of the triangles whose vertices all have a place below n; ascending, each once.
std::vector<Midpoint> prescribed_midpoints(const SurfaceMidpoints& surface, const std::vector<int>& place, int n) {
    std::vector<Midpoint> found;
    for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
        Eigen::Vector3i at;
        for (int i = 0; i < 3; ++i) at[i] = place[static_cast<std::size_t>(surface.triangles(i, t))];
        if (at.minCoeff() < 0 || at.maxCoeff() >= n) continue;
        for (int i = 0; i < 3; ++i) found.push_back({surface.midpoints(i, t), at[i], at[(i + 1) % 3]});
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

class Builder {
public:
    Builder(const Positions& positions, std::vector<int> vertices)
        : positions_(positions), vertices_(std::move(vertices)) {}

    void add_vertices(int begin, int end) {
        for (int i = begin; i < end; ++i) add(vertices_[static_cast<std::size_t>(i)], {i}, 1.0);
    }
    void add_midpoints(const std::vector<Midpoint>& midpoints) {
        for (const Midpoint& m : midpoints) add(m.node, {m.a, m.b}, 0.5);
    }
    int n_nodes() const { return static_cast<int>(result_.prescribed.nodes.size()); }
    ConstrainedFemNodes finish() && {
        result_.prescribed.prescribe.resize(3 * n_nodes(), 3 * std::ssize(vertices_));
        result_.prescribed.prescribe.setFromTriplets(entries_.begin(), entries_.end());
        result_.vertices = std::move(vertices_);
        return std::move(result_);
    }

private:
    void add(int node, std::initializer_list<int> places, double weight) {
        const int slot = n_nodes();
        result_.prescribed.nodes.push_back(node);
        for (const int place : places) {
            const Eigen::Vector3d at = positions_.col(vertices_[static_cast<std::size_t>(place)]);
            result_.shares.push_back({slot, place, weight, weight * at});
            for (int i = 0; i < 3; ++i) entries_.emplace_back(3 * slot + i, 3 * place + i, weight);
        }
    }

    const Positions& positions_;
    std::vector<int> vertices_;
    std::vector<Eigen::Triplet<double>> entries_;
    ConstrainedFemNodes result_;
};

}  // namespace

ConstrainedFemNodes constrain_nodes(const Positions& positions, const SurfaceMidpoints& surface,
                                    std::span<const int> fixed, std::span<const int> handles) {
    std::vector<int> vertices = joined(fixed, handles);
    const int n_fixed = static_cast<int>(fixed.size()), n = static_cast<int>(vertices.size());
    std::vector<int> place(static_cast<std::size_t>(positions.cols()), -1);
    for (int i = 0; i < n; ++i) place[static_cast<std::size_t>(vertices[static_cast<std::size_t>(i)])] = i;

    const std::vector<Midpoint> of_fixed = prescribed_midpoints(surface, place, n_fixed);
    const std::vector<Midpoint> all = prescribed_midpoints(surface, place, n);
    std::vector<Midpoint> others;
    std::set_difference(all.begin(), all.end(), of_fixed.begin(), of_fixed.end(), std::back_inserter(others));

    Builder builder(positions, std::move(vertices));
    builder.add_vertices(0, n_fixed);
    builder.add_midpoints(of_fixed);
    const int n_fixed_nodes = builder.n_nodes();
    builder.add_vertices(n_fixed, n);
    builder.add_midpoints(others);
    ConstrainedFemNodes result = std::move(builder).finish();
    result.n_fixed = n_fixed_nodes;
    return result;
}

}  // namespace elastolab
