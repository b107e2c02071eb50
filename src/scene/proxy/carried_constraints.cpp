#include "scene/proxy/carried_constraints.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <variant>

#include "base/parallel.hpp"
#include "findings/solution.hpp"
#include "scene/proxy/carried_loads.hpp"
#include "scene/proxy/proxy_owners.hpp"

namespace elastolab {

namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr int kVerticesAtATime = 4096;

bool same_set(const Constraints& a, const Constraints& b) {
    if (a.set.fixed != b.set.fixed || a.set.handles != b.set.handles || a.groups.size() != b.groups.size())
        return false;
    if (a.groups != b.groups || a.fixed_sets != b.fixed_sets || a.loads != b.loads) return false;
    // Which of a handle's neighbours follow it depends on whether its motion is defined away from its own vertices.
    return std::equal(a.motions.begin(), a.motions.end(), b.motions.begin(), b.motions.end(),
                      [](const Motion& x, const Motion& y) { return x.index() == y.index(); });
}

/// Rest positions of a handle's vertices.
Positions patch_of(const Constraints& constraints, std::size_t handle, const SurfaceMesh& surface) {
    const auto [begin, end] = constraints.range_of(handle);
    const std::vector<int>& all = constraints.set.handles;
    return surface.vertices(Eigen::all, std::vector<int>(all.begin() + begin, all.begin() + end));
}

/// Whether no turn about the middle leaves all of them where they are.
bool bears_moments(const Positions& patch, const Vector3d& middle) {
    std::vector<int> all(static_cast<std::size_t>(patch.cols()));
    std::iota(all.begin(), all.end(), 0);
    const double size = (patch.colwise() - middle).colwise().norm().maxCoeff();
    return size > 0.0 && free_rigid_motions(patch, all, middle, size).cols() == 0;
}

}  // namespace

CarriedConstraints::CarriedConstraints(std::shared_ptr<const Proxy> proxy)
    : proxy_(std::move(proxy)), around_(*proxy_->shown) {}

void CarriedConstraints::set(const Constraints& shown) {
    const bool same = chosen_ && same_set(shown, shown_);
    if (same && shown.values == shown_.values && shown.motions == shown_.motions && shown.forces == shown_.forces)
        return;
    shown_ = shown;
    if (!same) {
        choose_vertices();
        followers_ = find_followers(*proxy_, around_, shown_);
        chosen_ = true;
    }
    carry_values();
}

void CarriedConstraints::choose_vertices() {
    const std::vector<SurfaceMesh> parts = constrained_parts(*proxy_->shown, shown_);
    const std::vector<ProxyOwner> owners = proxy_owners(*proxy_, shown_, parts);
    own_findings_ = findings_of_points(*proxy_->shown, shown_.set);
    carried_ = {};
    carried_.groups = shown_.groups;
    carried_.fixed_sets = shown_.fixed_sets;
    const std::size_t first_handle = shown_.has_fixed() ? 1 : 0;
    for (std::size_t s = 0; s < shown_.fixed_sets.size(); ++s) {
        carried_.fixed_sets[s].begin = static_cast<int>(carried_.set.fixed.size());
        for (std::size_t v = 0; v < owners.size(); ++v)
            if (first_handle == 1 && owners[v].group == 0 && owners[v].fixed_set == s)
                carried_.set.fixed.push_back(static_cast<int>(v));
        carried_.fixed_sets[s].end = static_cast<int>(carried_.set.fixed.size());
    }
    auto end = static_cast<int>(carried_.set.fixed.size());
    if (first_handle == 1) carried_.groups[0] = {shown_.groups[0].name, 0, end};
    origins_.clear();
    origin_weights_.clear();
    for (std::size_t g = first_handle; g < parts.size(); ++g) {
        carried_.groups[g].begin = end;
        for (std::size_t v = 0; v < owners.size(); ++v) {
            if (owners[v].group != g) continue;
            ++end;
            carried_.set.handles.push_back(static_cast<int>(v));
            origins_.push_back(parts[g].triangles.col(owners[v].point.triangle));
            origin_weights_.push_back(owners[v].point.weights);
        }
        carried_.groups[g].end = end;
        if (carried_.groups[g].begin == end)
            own_findings_.push_back({.kind = FindingKind::idle_handle, .object = shown_.groups[g].name});
    }
    carried_.loads = carried_loads(*proxy_, shown_.loads, carried_.set);
    for (const AppliedLoad& load : carried_.loads) {
        const std::vector<UnitLoad> units =
            carried_units(*proxy_, load, std::span(shown_.set.loads).subspan(static_cast<std::size_t>(load.first)));
        carried_.set.loads.insert(carried_.set.loads.end(), units.begin(), units.end());
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
        if (affine == nullptr) carried_.motions[h] = std::move(carried_motion);
    }
    carry_forces();
}

/// They act where they do on the shown surface: a force about another middle has a moment there.
void CarriedConstraints::carry_forces() {
    for (const std::size_t h : carried_.gripped()) {
        const Positions shown = patch_of(shown_, h, *proxy_->shown), own = patch_of(carried_, h, *proxy_->surface);
        const Vector3d middle = own.rowwise().mean(), arm = shown.rowwise().mean() - middle;
        if (!bears_moments(own, middle)) continue;
        GripForce& force = *carried_.forces[h];
        force.moment += arm.cross(force.force);
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
    const Eigen::VectorXd proxied = places(of_proxy);
    Eigen::VectorXd u = proxied;
    const auto at = [](const Follower& follower) { return 3 * Index{follower.vertex}; };
    for (const Follower& follower : followers_) {
        const Follower& source = followers_[follower.source];
        if (follower.member >= 0)
            u.segment<3>(at(follower)) = value_of(follower);
        else
            u.segment<3>(at(follower)) += follower.share * (value_of(source) - proxied.segment<3>(at(source)));
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
    of_proxy.insert(of_proxy.end(), own_findings_.begin(), own_findings_.end());
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
