#include "scene/proxy/proxy_owners.hpp"

#include <algorithm>

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

/// The vertices of one fixed set, each by itself.
SurfaceMesh fixed_part(const SurfaceMesh& shown, const std::vector<int>& fixed, const ConstraintGroup& set) {
    SurfaceMesh part;
    part.vertices = shown.vertices(Eigen::all, std::vector<int>(fixed.begin() + set.begin, fixed.begin() + set.end));
    part.triangles = Eigen::RowVectorXi::LinSpaced(set.end - set.begin, 0, set.end - set.begin - 1).replicate<3, 1>();
    return part;
}

/// A part that is too small to have a vertex of the proxy gets the corners of the nearest triangle, or the nearest
/// vertex if it is hardly more than a point itself.
void hold_nearest(const SurfaceMesh& surface, const SurfaceMesh& part, const ProxyOwner& owner,
                  std::vector<ProxyOwner>& nearest) {
    const auto is_held = [&](const ProxyOwner& n) { return n.group == owner.group && n.fixed_set == owner.fixed_set; };
    if (std::any_of(nearest.begin(), nearest.end(), is_held)) return;
    const Vector3d middle = part.vertices.rowwise().mean();
    const SurfacePoint place = ClosestPoint(surface)(middle);
    std::vector<int> corners(3);
    Eigen::Vector3i::Map(corners.data()) = surface.triangles.col(place.triangle);
    const auto distance = [&](int v) { return (surface.vertices.col(v) - middle).norm(); };
    std::sort(corners.begin(), corners.end(), [&](int a, int b) { return distance(a) < distance(b); });
    if (part.n_vertices() < 3) corners.resize(1);
    for (const int v : corners) {
        ProxyOwner& present = nearest[static_cast<std::size_t>(v)];
        if (present.group == ProxyOwner::kNobody)
            present = {owner.group, ClosestPoint(part)(surface.vertices.col(v)), owner.fixed_set};
    }
}

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
    for (std::size_t s = 0; s < shown.fixed_sets.size(); ++s)
        hold_nearest(*proxy.surface, fixed_part(*proxy.shown, shown.set.fixed, shown.fixed_sets[s]),
                     {.group = 0, .fixed_set = s}, nearest);
    for (std::size_t g = shown.has_fixed() ? 1 : 0; g < parts.size(); ++g)
        hold_nearest(*proxy.surface, parts[g], {.group = g}, nearest);
    return nearest;
}

}  // namespace elastolab
