#include "scene/proxy/proxy_owners.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

namespace elastolab {

namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// For every proxy vertex, the nearest constrained part within reach.
std::vector<ProxyOwner> nearest_parts(const Proxy& proxy, const std::vector<SurfaceMesh>& parts) {
    const Positions& vertices = proxy.surface->vertices;
    std::vector<ProxyOwner> nearest(static_cast<std::size_t>(vertices.cols()));
    const double reach = ProxyOwner::kReach * proxy.edge;
    for (std::size_t g = 0; g < parts.size(); ++g) {
        const ClosestPoint closest(parts[g]);
        int near = 0;
        for (Index v = 0; v < vertices.cols(); ++v) {
            const SurfacePoint found = closest(vertices.col(v), near);
            near = found.triangle;
            ProxyOwner& present = nearest[static_cast<std::size_t>(v)];
            if (found.distance <= reach && found.distance < present.point.distance) present = {g, found, 0};
        }
    }
    return nearest;
}

/// Where the proxy has the shown vertices themselves: those that are constrained.
std::vector<ProxyOwner> same_vertices(const Proxy& proxy, const Constraints& shown) {
    const SurfacePlaces& places = proxy.places;
    std::vector<ProxyOwner> nearest(static_cast<std::size_t>(proxy.surface->n_vertices()));
    for (std::size_t g = 0; g < shown.groups.size(); ++g) {
        const std::vector<int> vertices = vertices_of(shown, g);
        for (std::size_t i = 0; i < vertices.size(); ++i)
            if (const int v = vertices[i]; places.distance[v] == 0.0 && places.weights(0, v) == 1.0) {
                const SurfacePoint by_itself{static_cast<int>(i), Vector3d::UnitX(), 0.0};  // as in constrained_parts()
                nearest[static_cast<std::size_t>(places.nodes(0, v))] = {g, by_itself, 0};
            }
    }
    return nearest;
}

/// How far the body follows a vertex without a whole triangle depends on the mesh: of a part that has whole
/// triangles, only their corners are kept.
void leave_out_lone_vertices(const SurfaceMesh& surface, std::size_t n_groups, std::vector<ProxyOwner>& nearest) {
    std::vector<bool> in_triangle(nearest.size(), false);
    std::vector<bool> has_triangle(n_groups, false);
    const auto group = [&](int v) { return nearest[static_cast<std::size_t>(v)].group; };
    for (const auto& v : surface.triangles.colwise()) {
        if (group(v[0]) == ProxyOwner::kNobody || group(v[0]) != group(v[1]) || group(v[1]) != group(v[2])) continue;
        has_triangle[group(v[0])] = true;
        for (const int corner : v) in_triangle[static_cast<std::size_t>(corner)] = true;
    }
    for (std::size_t v = 0; v < nearest.size(); ++v)
        if (nearest[v].group != ProxyOwner::kNobody && has_triangle[nearest[v].group] && !in_triangle[v])
            nearest[v].group = ProxyOwner::kNobody;
}

/// A vertex of the proxy belongs to the fixed set of the shown vertex that it is nearest to.
void divide_fixed(const SurfaceMesh& fixed, const std::vector<ConstraintGroup>& sets,
                  std::vector<ProxyOwner>& nearest) {
    for (ProxyOwner& of : nearest) {
        if (of.group != 0) continue;
        Index corner = 0;
        of.point.weights.maxCoeff(&corner);
        const int member = fixed.triangles(corner, of.point.triangle);
        while (sets[of.fixed_set].end <= member) ++of.fixed_set;
    }
}

/// Vertices of one group and one fixed set that edges of the shown surface join: members of the group, ascending.
struct Piece {
    std::size_t group = 0, fixed_set = 0;
    std::vector<int> members;
};

/// For each shown vertex the first one of its piece, or -1; sets: number of the group or fixed set of each, or -1.
std::vector<int> joined_by_edges(const SurfaceMesh& shown, const std::vector<int>& sets) {
    std::vector<int> first(sets.size());
    std::iota(first.begin(), first.end(), 0);
    const auto root = [&](int v) {
        while (first[static_cast<std::size_t>(v)] != v) {
            int& above = first[static_cast<std::size_t>(v)];
            v = above = first[static_cast<std::size_t>(above)];
        }
        return v;
    };
    for (const auto& v : shown.triangles.colwise())
        for (int k = 0; k < 3; ++k) {
            const int a = v[k], b = v[(k + 1) % 3], set = sets[static_cast<std::size_t>(a)];
            if (set >= 0 && sets[static_cast<std::size_t>(b)] == set)
                first[static_cast<std::size_t>(std::max(root(a), root(b)))] = std::min(root(a), root(b));
        }
    for (std::size_t v = 0; v < sets.size(); ++v) first[v] = sets[v] < 0 ? -1 : root(static_cast<int>(v));
    return first;
}

std::vector<Piece> pieces_of(const SurfaceMesh& shown, const Constraints& constraints) {
    struct Member {
        std::size_t group, fixed_set;
        int number;
    };
    std::vector<int> sets(static_cast<std::size_t>(shown.n_vertices()), -1), constrained;
    std::vector<Member> members;
    for (std::size_t g = 0, set = 0; g < constraints.groups.size(); ++g, ++set) {
        const bool fixed = g == 0 && constraints.has_fixed();
        const std::vector<int> vertices = vertices_of(constraints, g);
        std::size_t fixed_set = 0;
        for (int i = 0; i < std::ssize(vertices); ++i) {
            while (fixed && constraints.fixed_sets[fixed_set].end <= i) ++fixed_set, ++set;
            sets[static_cast<std::size_t>(vertices[static_cast<std::size_t>(i)])] = static_cast<int>(set);
            constrained.push_back(vertices[static_cast<std::size_t>(i)]);
            members.push_back({g, fixed_set, i});
        }
    }
    const std::vector<int> first = joined_by_edges(shown, sets);
    std::vector<int> number(first.size(), -1);
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < constrained.size(); ++i) {
        int& piece = number[static_cast<std::size_t>(first[static_cast<std::size_t>(constrained[i])])];
        if (piece < 0) {
            piece = static_cast<int>(pieces.size());
            pieces.push_back({members[i].group, members[i].fixed_set, {}});
        }
        pieces[static_cast<std::size_t>(piece)].members.push_back(members[i].number);
    }
    return pieces;
}

/// Pieces that have no vertex of the proxy nearby, as they are smaller than its triangles, get the corners of the
/// nearest triangle, or the nearest vertex if they are hardly more than a point.
class NearestHolder {
public:
    NearestHolder(const Proxy& proxy, const std::vector<SurfaceMesh>& parts, std::vector<ProxyOwner>& nearest)
        : surface_(*proxy.surface), edge_(proxy.edge), parts_(parts), nearest_(nearest), of_parts_(parts.size()) {
        for (const SurfaceMesh& part : parts)
            has_vertex_.emplace_back(static_cast<std::size_t>(part.n_vertices()), false);
        for (const ProxyOwner& owner : nearest) note(owner);
    }

    void hold(const Piece& piece) {
        const std::vector<bool>& has_vertex = has_vertex_[piece.group];
        if (std::any_of(piece.members.begin(), piece.members.end(),
                        [&](int member) { return has_vertex[static_cast<std::size_t>(member)]; }))
            return;
        const Positions places = parts_[piece.group].vertices(Eigen::all, piece.members);
        const Vector3d middle = middle_of(places);
        std::vector<int> corners(3);
        Eigen::Vector3i::Map(corners.data()) = surface_.triangles.col(made(closest_, surface_)(middle).triangle);
        if (std::any_of(corners.begin(), corners.end(), [&](int v) {
                const ProxyOwner& owner = nearest_[static_cast<std::size_t>(v)];
                return owner.group == piece.group && owner.fixed_set == piece.fixed_set;
            }))
            return;
        const auto distance = [&](int v) { return (surface_.vertices.col(v) - middle).norm(); };
        std::sort(corners.begin(), corners.end(), [&](int a, int b) { return distance(a) < distance(b); });
        if (places.cols() < 3) corners.resize(1);
        for (const int v : corners) {
            ProxyOwner& present = nearest_[static_cast<std::size_t>(v)];
            if (present.group != ProxyOwner::kNobody) continue;
            const ClosestPoint& of_part = made(of_parts_[piece.group], parts_[piece.group]);
            present = {piece.group, of_part(surface_.vertices.col(v)), piece.fixed_set};
            note(present);
        }
    }

private:
    /// Their mean, or the nearest of them where that is far from all, as from a ring.
    Vector3d middle_of(const Positions& places) const {
        Vector3d mean = places.rowwise().mean();
        Index nearest = 0;
        if ((places.colwise() - mean).colwise().norm().minCoeff(&nearest) <= edge_) return mean;
        return places.col(nearest);
    }
    /// Made when it is needed first, as it seldom is.
    static const ClosestPoint& made(std::optional<ClosestPoint>& closest, const SurfaceMesh& mesh) {
        if (!closest) closest.emplace(mesh);
        return *closest;
    }
    /// The member that a vertex of the proxy is nearest to has one.
    void note(const ProxyOwner& owner) {
        if (owner.group == ProxyOwner::kNobody) return;
        Index corner = 0;
        owner.point.weights.maxCoeff(&corner);
        const int member = parts_[owner.group].triangles(corner, owner.point.triangle);
        has_vertex_[owner.group][static_cast<std::size_t>(member)] = true;
    }

    const SurfaceMesh& surface_;
    double edge_;
    const std::vector<SurfaceMesh>& parts_;
    std::vector<ProxyOwner>& nearest_;
    std::optional<ClosestPoint> closest_;  ///< of the surface
    std::vector<std::optional<ClosestPoint>> of_parts_;
    std::vector<std::vector<bool>> has_vertex_;  ///< of each part's vertices
};

}  // namespace

std::vector<int> vertices_of(const Constraints& constraints, std::size_t group) {
    const ConstraintGroup& range = constraints.groups[group];
    const auto n_fixed = static_cast<int>(constraints.set.fixed.size());
    const bool in_fixed = range.begin < n_fixed;
    const std::vector<int>& all = in_fixed ? constraints.set.fixed : constraints.set.handles;
    const int shift = in_fixed ? 0 : n_fixed;
    return {all.begin() + (range.begin - shift), all.begin() + (range.end - shift)};
}

std::vector<SurfaceMesh> constrained_parts(const SurfaceMesh& shown, const Constraints& constraints) {
    std::vector<std::size_t> group_of(static_cast<std::size_t>(shown.n_vertices()), ProxyOwner::kNobody);
    std::vector<int> member_of(group_of.size());
    std::vector<SurfaceMesh> parts(constraints.groups.size());
    std::vector<std::vector<Eigen::Vector3i>> triangles(parts.size());
    for (std::size_t g = 0; g < parts.size(); ++g) {
        const std::vector<int> vertices = vertices_of(constraints, g);
        parts[g].vertices = shown.vertices(Eigen::all, vertices);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            group_of[static_cast<std::size_t>(vertices[i])] = g;
            member_of[static_cast<std::size_t>(vertices[i])] = static_cast<int>(i);
            triangles[g].push_back(Eigen::Vector3i::Constant(static_cast<int>(i)));  // a vertex by itself
        }
    }
    for (int t = 0; t < shown.n_triangles(); ++t) {
        const Eigen::Vector3i v = shown.triangles.col(t);
        const auto place = [](int vertex) { return static_cast<std::size_t>(vertex); };
        const std::size_t g = group_of[place(v[0])];
        if (g == ProxyOwner::kNobody || group_of[place(v[1])] != g || group_of[place(v[2])] != g) continue;
        triangles[g].emplace_back(member_of[place(v[0])], member_of[place(v[1])], member_of[place(v[2])]);
    }
    for (std::size_t g = 0; g < parts.size(); ++g) {
        parts[g].triangles.resize(3, std::ssize(triangles[g]));
        for (std::size_t i = 0; i < triangles[g].size(); ++i)
            parts[g].triangles.col(static_cast<Index>(i)) = triangles[g][i];
    }
    return parts;
}

std::vector<ProxyOwner> proxy_owners(const Proxy& proxy, const Constraints& shown,
                                     const std::vector<SurfaceMesh>& parts) {
    const bool fills = proxy.is_filled();
    std::vector<ProxyOwner> nearest = fills ? same_vertices(proxy, shown) : nearest_parts(proxy, parts);
    if (!fills) leave_out_lone_vertices(*proxy.surface, parts.size(), nearest);
    if (shown.has_fixed()) divide_fixed(parts.front(), shown.fixed_sets, nearest);
    if (fills) return nearest;
    NearestHolder holder(proxy, parts, nearest);
    for (const Piece& piece : pieces_of(*proxy.shown, shown)) holder.hold(piece);
    return nearest;
}

}  // namespace elastolab
