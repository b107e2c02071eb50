#pragma once

#include <vector>

namespace elastolab {

/// Edge length wanted inside a body: that of the surface near by, growing with the distance from it,
///   h(x) = min over surface vertices v of  h_v + growth |x - v|,
/// h_v the mean length of the edges at v, but never less than that of all edges: fine detail on the surface shall not
/// refine what is behind it more than it must.
/// For the helper program that runs TetGen: plain arrays, no other library.
class SizeField {
public:
    /// vertices    x y z of each
    /// triangles   three vertices each
    SizeField(const std::vector<double>& vertices, const std::vector<int>& triangles, double growth);

    double at(const double* point) const { return nearest(point).wanted; }
    /// The wanted length over h_v of the vertex v at which the minimum is attained.
    double grown(const double* point) const;
    /// Whether every vertex v is farther away than lengths * h_v.
    bool is_clear(const double* point, double lengths) const { return is_clear(point, lengths, 0); }
    /// The least h_v.
    double least() const { return nodes_.front().least; }

private:
    /// A vertex and the box of those below it in the tree.
    struct Node {
        double point[3], size, least, most;
        double low[3], high[3];
    };
    struct Sample {
        double point[3], size;
    };
    /// The length wanted at a point, and h_v of the vertex at which the minimum is attained.
    struct Nearest {
        double wanted, own;
    };
    Nearest nearest(const double* point) const;
    void build(std::vector<Sample>& samples, std::size_t begin, std::size_t end, std::size_t node);
    void search(const double* point, std::size_t node, Nearest& best) const;
    double bound(const double* point, const Node& node) const;
    bool is_clear(const double* point, double lengths, std::size_t node) const;

    double growth_;
    std::vector<Node> nodes_;  ///< a balanced tree, children of i at 2 i + 1 and 2 i + 2
};

}  // namespace elastolab
