#include "scene/proxy/carried_constraints.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>
#include <variant>

#include "base/parallel.hpp"
#include "findings/solution.hpp"
#include "mesh/closest_point.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr int kVerticesAtATime = 4096;
/// Edges of the proxy that a triangle of a filled surface may be from itself: rounding.
constexpr double kSameTriangle = 1e-6;

bool same_set(const Constraints& a, const Constraints& b) {
    if (a.set.fixed != b.set.fixed || a.set.handles != b.set.handles || a.groups.size() != b.groups.size())
        return false;
    if (a.groups != b.groups || a.fixed_sets != b.fixed_sets || a.loads != b.loads) return false;
    // Which of a handle's neighbours follow it depends on whether its motion is defined away from its own vertices.
    return std::equal(a.motions.begin(), a.motions.end(), b.motions.begin(), b.motions.end(),
                      [](const Motion& x, const Motion& y) { return x.index() == y.index(); });
}

}  // namespace

CarriedConstraints::CarriedConstraints(std::shared_ptr<const Proxy> proxy)
    : proxy_(std::move(proxy)), around_(*proxy_->shown) {}

void CarriedConstraints::set(const Constraints& shown) {
    const bool same = chosen_ && same_set(shown, shown_);
    if (same && shown.values == shown_.values && shown.motions == shown_.motions) return;
    shown_ = shown;
    if (!same) {
        choose_vertices();
        find_followers();
        points_ = findings_of_points(*proxy_->shown, shown_.set);
        chosen_ = true;
    }
    carry_values();
}

std::vector<int> CarriedConstraints::vertices_of(const Constraints& constraints, std::size_t group) const {
    const ConstraintGroup& range = constraints.groups[group];
    const auto n_fixed = static_cast<int>(constraints.set.fixed.size());
    const bool in_fixed = range.begin < n_fixed;
    const std::vector<int>& all = in_fixed ? constraints.set.fixed : constraints.set.handles;
    const int shift = in_fixed ? 0 : n_fixed;
    return {all.begin() + (range.begin - shift), all.begin() + (range.end - shift)};
}

std::vector<CarriedConstraints::Part> CarriedConstraints::parts() const {
    const SurfaceMesh& mesh = *proxy_->shown;
    std::vector<std::size_t> group_of(static_cast<std::size_t>(mesh.n_vertices()), kNoGroup);
    std::vector<int> member_of(group_of.size());
    std::vector<Part> parts(shown_.groups.size());
    std::vector<std::vector<Eigen::Vector3i>> triangles(parts.size());
    for (std::size_t g = 0; g < parts.size(); ++g) {
        const std::vector<int> vertices = vertices_of(shown_, g);
        parts[g].surface.vertices = mesh.vertices(Eigen::all, vertices);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            group_of[static_cast<std::size_t>(vertices[i])] = g;
            member_of[static_cast<std::size_t>(vertices[i])] = static_cast<int>(i);
            triangles[g].push_back(Eigen::Vector3i::Constant(static_cast<int>(i)));  // a vertex by itself
        }
    }
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const Eigen::Vector3i v = mesh.triangles.col(t);
        const auto place = [](int vertex) { return static_cast<std::size_t>(vertex); };
        const std::size_t g = group_of[place(v[0])];
        if (g == kNoGroup || group_of[place(v[1])] != g || group_of[place(v[2])] != g) continue;
        triangles[g].emplace_back(member_of[place(v[0])], member_of[place(v[1])], member_of[place(v[2])]);
    }
    for (std::size_t g = 0; g < parts.size(); ++g) {
        parts[g].surface.triangles.resize(3, std::ssize(triangles[g]));
        for (std::size_t i = 0; i < triangles[g].size(); ++i)
            parts[g].surface.triangles.col(static_cast<Index>(i)) = triangles[g][i];
    }
    return parts;
}

/// For every proxy vertex, the nearest constrained part within reach.
std::vector<CarriedConstraints::Nearest> CarriedConstraints::nearest_parts(const std::vector<Part>& parts) const {
    const Positions& vertices = proxy_->surface->vertices;
    std::vector<Nearest> nearest(static_cast<std::size_t>(vertices.cols()));
    const double reach = kReach * proxy_->edge;
    for (std::size_t g = 0; g < parts.size(); ++g) {
        const ClosestPoint closest(parts[g].surface);
        int near = 0;
        for (Index v = 0; v < vertices.cols(); ++v) {
            const SurfacePoint found = closest(vertices.col(v), near);
            near = found.triangle;
            Nearest& present = nearest[static_cast<std::size_t>(v)];
            if (found.distance <= reach && found.distance < present.point.distance) present = {g, found, 0};
        }
    }
    return nearest;
}

/// Where the proxy has the shown vertices themselves: those that are constrained.
std::vector<CarriedConstraints::Nearest> CarriedConstraints::same_vertices() const {
    const SurfacePlaces& places = proxy_->places;
    std::vector<Nearest> nearest(static_cast<std::size_t>(proxy_->surface->n_vertices()));
    for (std::size_t g = 0; g < shown_.groups.size(); ++g) {
        const std::vector<int> vertices = vertices_of(shown_, g);
        for (std::size_t i = 0; i < vertices.size(); ++i)
            if (const int v = vertices[i]; places.distance[v] == 0.0 && places.weights(0, v) == 1.0)
                nearest[static_cast<std::size_t>(places.nodes(0, v))] = {
                    g, {static_cast<int>(i), Vector3d::UnitX(), 0.0}, 0};  // the vertex by itself: see parts()
    }
    return nearest;
}

/// How far the body follows a vertex without a whole triangle depends on the mesh: of a part that has whole
/// triangles, only their corners are kept.
void CarriedConstraints::leave_out_lone_vertices(std::vector<Nearest>& nearest) const {
    std::vector<bool> in_triangle(nearest.size(), false);
    std::vector<bool> has_triangle(shown_.groups.size(), false);
    const auto group = [&](int v) { return nearest[static_cast<std::size_t>(v)].group; };
    for (const auto& v : proxy_->surface->triangles.colwise()) {
        if (group(v[0]) == kNoGroup || group(v[0]) != group(v[1]) || group(v[1]) != group(v[2])) continue;
        has_triangle[group(v[0])] = true;
        for (const int corner : v) in_triangle[static_cast<std::size_t>(corner)] = true;
    }
    for (std::size_t v = 0; v < nearest.size(); ++v)
        if (nearest[v].group != kNoGroup && has_triangle[nearest[v].group] && !in_triangle[v])
            nearest[v].group = kNoGroup;
}

/// A vertex of the proxy belongs to the fixed set of the shown vertex that it is nearest to.
void CarriedConstraints::divide_fixed(const Part& fixed, std::vector<Nearest>& nearest) const {
    for (Nearest& of : nearest) {
        if (of.group != 0) continue;
        Index corner = 0;
        of.point.weights.maxCoeff(&corner);
        const int member = fixed.surface.triangles(corner, of.point.triangle);
        while (shown_.fixed_sets[of.fixed_set].end <= member) ++of.fixed_set;
    }
}

/// The vertices of one fixed set, each by itself.
CarriedConstraints::Part CarriedConstraints::fixed_part(const ConstraintGroup& set) const {
    const auto fixed = shown_.set.fixed.begin();
    Part part;
    part.surface.vertices = proxy_->shown->vertices(Eigen::all, std::vector<int>(fixed + set.begin, fixed + set.end));
    part.surface.triangles =
        Eigen::RowVectorXi::LinSpaced(set.end - set.begin, 0, set.end - set.begin - 1).replicate<3, 1>();
    return part;
}

/// A part that is too small to have a vertex of the proxy gets the corners of the nearest triangle, or the nearest
/// vertex if it is hardly more than a point itself.
void CarriedConstraints::hold_nearest(const Part& part, const Nearest& owner, std::vector<Nearest>& nearest) const {
    const auto is_held = [&](const Nearest& n) { return n.group == owner.group && n.fixed_set == owner.fixed_set; };
    if (std::any_of(nearest.begin(), nearest.end(), is_held)) return;
    const SurfaceMesh& surface = *proxy_->surface;
    const Vector3d middle = part.surface.vertices.rowwise().mean();
    const SurfacePoint place = ClosestPoint(surface)(middle);
    std::vector<int> corners(3);
    Eigen::Vector3i::Map(corners.data()) = surface.triangles.col(place.triangle);
    const auto distance = [&](int v) { return (surface.vertices.col(v) - middle).norm(); };
    std::sort(corners.begin(), corners.end(), [&](int a, int b) { return distance(a) < distance(b); });
    if (part.surface.n_vertices() < 3) corners.resize(1);
    for (const int v : corners) {
        Nearest& present = nearest[static_cast<std::size_t>(v)];
        if (present.group == kNoGroup)
            present = {owner.group, ClosestPoint(part.surface)(surface.vertices.col(v)), owner.fixed_set};
    }
}

/// For every proxy vertex, what it belongs to.
std::vector<CarriedConstraints::Nearest> CarriedConstraints::owners(const std::vector<Part>& constrained) const {
    const bool fills = proxy_->is_filled();
    std::vector<Nearest> nearest = fills ? same_vertices() : nearest_parts(constrained);
    if (!fills) leave_out_lone_vertices(nearest);
    if (shown_.has_fixed()) divide_fixed(constrained.front(), nearest);
    if (fills) return nearest;
    for (std::size_t s = 0; s < shown_.fixed_sets.size(); ++s)
        hold_nearest(fixed_part(shown_.fixed_sets[s]), {.group = 0, .fixed_set = s}, nearest);
    for (std::size_t g = shown_.has_fixed() ? 1 : 0; g < constrained.size(); ++g)
        hold_nearest(constrained[g], {.group = g}, nearest);
    return nearest;
}

void CarriedConstraints::choose_vertices() {
    const std::vector<Part> constrained = parts();
    const std::vector<Nearest> nearest = owners(constrained);
    carried_ = {};
    carried_.groups = shown_.groups;
    carried_.fixed_sets = shown_.fixed_sets;
    const std::size_t first_handle = shown_.has_fixed() ? 1 : 0;
    for (std::size_t s = 0; s < shown_.fixed_sets.size(); ++s) {
        carried_.fixed_sets[s].begin = static_cast<int>(carried_.set.fixed.size());
        for (std::size_t v = 0; v < nearest.size(); ++v)
            if (first_handle == 1 && nearest[v].group == 0 && nearest[v].fixed_set == s)
                carried_.set.fixed.push_back(static_cast<int>(v));
        carried_.fixed_sets[s].end = static_cast<int>(carried_.set.fixed.size());
    }
    auto end = static_cast<int>(carried_.set.fixed.size());
    if (first_handle == 1) carried_.groups[0] = {shown_.groups[0].name, 0, end};
    origins_.clear();
    origin_weights_.clear();
    for (std::size_t g = first_handle; g < constrained.size(); ++g) {
        carried_.groups[g].begin = end;
        for (std::size_t v = 0; v < nearest.size(); ++v) {
            if (nearest[v].group != g) continue;
            ++end;
            carried_.set.handles.push_back(static_cast<int>(v));
            origins_.push_back(constrained[g].surface.triangles.col(nearest[v].point.triangle));
            origin_weights_.push_back(nearest[v].point.weights);
        }
        carried_.groups[g].end = end;
    }
    carry_loads();
}

/// A triangle of the proxy carries what the shown triangle that its middle is nearest to carries, unless all its
/// vertices are constrained. A total force stays the same, whatever the area.
void CarriedConstraints::carry_loads() {
    carried_.loads = shown_.loads;
    if (shown_.loads.empty()) return;
    const SurfaceMesh& surface = *proxy_->surface;
    std::vector<char> is_held(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const std::vector<int>* held : {&carried_.set.fixed, &carried_.set.handles})
        for (const int v : *held) is_held[static_cast<std::size_t>(v)] = 1;
    std::vector<int> nearest(static_cast<std::size_t>(surface.n_triangles()), -1);
    const ClosestPoint closest(*proxy_->shown);
    for (int t = 0; t < surface.n_triangles(); ++t) {
        const Eigen::Vector3i v = surface.triangles.col(t);
        if (is_held[static_cast<std::size_t>(v[0])] && is_held[static_cast<std::size_t>(v[1])] &&
            is_held[static_cast<std::size_t>(v[2])])
            continue;
        const SurfacePoint found = closest(centroid(surface, t));
        if (!proxy_->is_filled() || found.distance <= kSameTriangle * proxy_->edge)
            nearest[static_cast<std::size_t>(t)] = found.triangle;
    }
    for (AppliedLoad& load : carried_.loads) {
        if (load.kind != AppliedLoad::Kind::gravity) {
            std::vector<char> loaded(static_cast<std::size_t>(proxy_->shown->n_triangles()), 0);
            for (const int t : load.triangles) loaded[static_cast<std::size_t>(t)] = 1;
            Eigen::Vector3d middle = Eigen::Vector3d::Zero();
            for (const int t : load.triangles)
                middle += centroid(*proxy_->shown, t) / static_cast<double>(load.triangles.size());
            load.triangles.clear();
            for (int t = 0; t < surface.n_triangles(); ++t)
                if (const int own = nearest[static_cast<std::size_t>(t)];
                    own >= 0 && loaded[static_cast<std::size_t>(own)])
                    load.triangles.push_back(t);
            if (load.triangles.empty()) load.triangles.push_back(ClosestPoint(surface)(middle).triangle);
        }
        const std::vector<UnitLoad> units = unit_loads(load.kind, surface, load.triangles);
        carried_.set.loads.insert(carried_.set.loads.end(), units.begin(), units.end());
    }
}

/// A walk over the shown surface, outwards from what is constrained.
void CarriedConstraints::find_followers() {
    const SurfaceMesh& mesh = *proxy_->shown;
    followers_.clear();
    std::unordered_map<int, std::size_t> source_of;  // the follower that a seen vertex is nearest to, so far
    for (std::size_t g = 0; g < shown_.groups.size(); ++g) {
        const std::vector<int> vertices = vertices_of(shown_, g);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            source_of[vertices[i]] = followers_.size();
            followers_.push_back({vertices[i], g, static_cast<int>(i), 1.0});
        }
    }
    const std::size_t n_constrained = followers_.size();
    std::vector<std::pair<int, std::size_t>> front;  // a vertex, and where it was reached from
    for (std::size_t i = 0; i < n_constrained; ++i) front.emplace_back(followers_[i].vertex, i);
    const double reach = proxy_->is_filled() ? 0.0 : proxy_->edge;
    std::unordered_map<int, double> distances;
    while (!front.empty()) {
        std::vector<std::pair<int, std::size_t>> next;
        for (const auto& [vertex, source] : front)
            for (const int t : around_[vertex])
                for (const int w : mesh.triangles.col(t)) {
                    const auto known = source_of.find(w);
                    if (known != source_of.end() && known->second < n_constrained && !distances.contains(w)) continue;
                    const double d = (mesh.vertices.col(w) - mesh.vertices.col(followers_[source].vertex)).norm();
                    const auto before = distances.find(w);
                    if (d >= reach || (before != distances.end() && before->second <= d)) continue;
                    distances[w] = d;
                    source_of[w] = source;
                    next.emplace_back(w, source);
                }
        front = std::move(next);
    }
    for (const auto& [vertex, d] : distances) {
        const std::size_t group = followers_[source_of[vertex]].group;
        const std::size_t first_handle = shown_.has_fixed() ? 1 : 0;
        const bool is_vertexwise =
            group >= first_handle && std::holds_alternative<VertexMotion>(shown_.motions[group - first_handle]);
        const double fade = 1.0 - d / reach;
        if (!is_vertexwise) followers_.push_back({vertex, group, -1, fade * fade});
    }
}

void CarriedConstraints::carry_values() {
    const SurfaceMesh& surface = *proxy_->surface;
    carried_.motions = shown_.motions;
    carried_.forces = shown_.forces;
    maps_.resize(shown_.motions.size());
    carried_.values.resize(carried_.set.n_values());
    carried_.values.tail(std::ssize(carried_.set.loads)) = shown_.values.tail(std::ssize(shown_.set.loads));
    const std::size_t first_handle = shown_.has_fixed() ? 1 : 0;
    const auto n_fixed = static_cast<int>(carried_.set.fixed.size());
    for (std::size_t h = 0; h < carried_.motions.size(); ++h) {
        const ConstraintGroup& group = carried_.groups[h + first_handle];
        const auto* affine = std::get_if<AffineMotion>(&shown_.motions[h]);
        AffineMap& map = maps_[h] = affine ? map_of(*affine) : AffineMap{};
        VertexMotion carried_motion;
        for (int i = group.begin - n_fixed; i < group.end - n_fixed; ++i) {
            const auto place = static_cast<std::size_t>(i);
            Vector3d u = Vector3d::Zero();
            if (affine) {
                u = map.displacement(surface.vertices.col(carried_.set.handles[place]));
            } else {
                const auto& each = std::get<VertexMotion>(shown_.motions[h]).displacements;
                for (int k = 0; k < 3; ++k)
                    u += origin_weights_[place][k] * each[static_cast<std::size_t>(origins_[place][k])];
                carried_motion.displacements.push_back(u);
            }
            carried_.values.segment<3>(3 * Index{i}) = u;
        }
        if (!carried_motion.displacements.empty()) carried_.motions[h] = std::move(carried_motion);
    }
}

Vector3d CarriedConstraints::value_of(const Follower& follower) const {
    const std::size_t first_handle = shown_.has_fixed() ? 1 : 0;
    if (follower.group < first_handle) return Vector3d::Zero();
    const std::size_t handle = follower.group - first_handle;
    if (const auto* single = std::get_if<VertexMotion>(&shown_.motions[handle]))
        return single->displacements[static_cast<std::size_t>(follower.member)];
    return maps_[handle].displacement(proxy_->shown->vertices.col(follower.vertex));
}

Eigen::VectorXd CarriedConstraints::displacement(const Eigen::VectorXd& of_proxy) const {
    Eigen::VectorXd u = places(of_proxy);
    for (const Follower& follower : followers_) {
        auto own = u.segment<3>(3 * Index{follower.vertex});
        own += follower.share * (value_of(follower) - own);
    }
    return u;
}

Eigen::VectorXd CarriedConstraints::places(const Eigen::VectorXd& of_proxy) const {
    const SurfacePlaces& places = proxy_->places;
    Eigen::VectorXd u(3 * places.nodes.cols());
    Control control;
    parallel_blocks(static_cast<int>(places.nodes.cols()), kVerticesAtATime, control, [&](int begin, int end) {
        for (Index v = begin; v < end; ++v) {
            Vector3d sum = Vector3d::Zero();
            for (int k = 0; k < 3; ++k)
                sum += places.weights(k, v) * of_proxy.segment<3>(3 * Index{places.nodes(k, v)});
            u.segment<3>(3 * v) = sum;
        }
    });
    return u;
}

Findings CarriedConstraints::as_shown(Findings of_proxy) const {
    std::erase_if(of_proxy, [](const Finding& finding) { return finding.kind == FindingKind::point_constraint; });
    of_proxy.insert(of_proxy.end(), points_.begin(), points_.end());
    return of_proxy;
}

Eigen::VectorXd carried_values(const Proxy& proxy, const Eigen::VectorXd& of_proxy) {
    const SurfacePlaces& places = proxy.places;
    Eigen::VectorXd values(places.nodes.cols());
    for (Index v = 0; v < values.size(); ++v) {
        values[v] = 0.0;
        for (int k = 0; k < 3; ++k) values[v] += places.weights(k, v) * of_proxy[places.nodes(k, v)];
    }
    return values;
}

}  // namespace elastolab
