#include "mesh/rims.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace elastolab {

namespace {

/// Fields that grow with the root of the distance from the rim need rows graded by more than the second power. With one
/// row 2.5 leaves a fifth less of the error than 2, and 3 as much as 2.5, by thinner triangles.
constexpr double kGrading = 2.5;

/// The rim between a region of coarse triangles and the others.
class Rim {
public:
    Rim(const RefinedSurface& surface, const std::vector<char>& in_region) : surface_(surface) {
        for (auto& seen : sees_) seen.resize(static_cast<std::size_t>(surface.mesh.n_vertices()), 0);
        for (int t = 0; t < surface.mesh.n_triangles(); ++t) {
            const bool inside =
                in_region[static_cast<std::size_t>(surface.coarse_triangle[static_cast<std::size_t>(t)])];
            for (int i = 0; i < 3; ++i) {
                sees_[inside][static_cast<std::size_t>(corner(t, i))] = 1;
                beside_[edge(t, i)][inside] = true;
            }
        }
    }
    /// A vertex at the rim has triangles of both kinds around it.
    bool has(int v) const { return sees_[0][static_cast<std::size_t>(v)] && sees_[1][static_cast<std::size_t>(v)]; }
    bool has_all_edges(int t) const { return has_edge(edge(t, 0)) && has_edge(edge(t, 1)) && has_edge(edge(t, 2)); }

    /// The edges of triangles that all lie on the rim, halved.
    std::vector<EdgeCut> halves_of_triangles_in_it(const MayBeCut& may_be_cut) const {
        return cuts(may_be_cut, 0.5, [&](int t, const Edge& e) { return has_edge(e) && has_all_edges(t); });
    }
    /// The edges from rim to rim that do not lie on it, halved.
    std::vector<EdgeCut> halves_of_chords(const MayBeCut& may_be_cut) const {
        return cuts(may_be_cut, 0.5, [&](int, const Edge& e) { return has(e.first) && has(e.second) && !has_edge(e); });
    }
    /// The edges that lead away from the rim, cut at this share of their length.
    std::vector<EdgeCut> cuts_near_it(const MayBeCut& may_be_cut, double share) const {
        return cuts(may_be_cut, share, [&](int, const Edge& e) { return has(e.first) != has(e.second); });
    }

private:
    using Edge = std::pair<int, int>;

    int corner(int t, int i) const { return surface_.mesh.triangles(i % 3, t); }
    Edge edge(int t, int i) const { return std::minmax({corner(t, i), corner(t, i + 1)}); }
    bool has_edge(const Edge& e) const { return beside_.at(e)[0] && beside_.at(e)[1]; }

    template <class Chosen>
    std::vector<EdgeCut> cuts(const MayBeCut& may_be_cut, double share, const Chosen& is_chosen) const {
        std::map<Edge, double> cut;
        for (int t = 0; t < surface_.mesh.n_triangles(); ++t) {
            if (!has(corner(t, 0)) && !has(corner(t, 1)) && !has(corner(t, 2))) continue;
            if (!may_be_cut(surface_.mesh, t, share)) continue;
            for (int i = 0; i < 3; ++i)
                if (const Edge e = edge(t, i); is_chosen(t, e)) cut[e] = has(e.first) ? share : 1.0 - share;
        }
        std::vector<EdgeCut> result;
        for (const auto& [e, at] : cut) result.push_back({{e.first, e.second}, at});
        return result;
    }

    const RefinedSurface& surface_;
    std::array<std::vector<char>, 2> sees_;  ///< by vertex: has a triangle outside, inside
    std::map<Edge, std::array<bool, 2>> beside_;
};

}  // namespace

std::vector<char> around_rim(const RefinedSurface& surface, const std::vector<char>& in_region) {
    const Rim rim(surface, in_region);
    std::vector<char> marked;
    for (const auto& triangle : surface.mesh.triangles.colwise())
        marked.push_back(rim.has(triangle[0]) || rim.has(triangle[1]) || rim.has(triangle[2]) ? 1 : 0);
    return marked;
}

RefinedSurface add_rows_along_rim(const RefinedSurface& given, const std::vector<char>& in_region, int rows,
                                  const MayBeCut& may_be_cut) {
    RefinedSurface surface = cut_edges(given, Rim(given, in_region).halves_of_triangles_in_it(may_be_cut));
    surface = cut_edges(surface, Rim(surface, in_region).halves_of_chords(may_be_cut));
    for (int row = rows; row > 0; --row) {
        const double share = std::pow(row / (row + 1.0), kGrading);
        surface = cut_edges(surface, Rim(surface, in_region).cuts_near_it(may_be_cut, share));
    }
    return surface;
}

}  // namespace elastolab
