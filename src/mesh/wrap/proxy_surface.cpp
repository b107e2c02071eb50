#include "mesh/wrap/proxy_surface.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "mesh/checks/defects.hpp"
#include "mesh/closest_point.hpp"
#include "mesh/measures.hpp"
#include "mesh/numbering.hpp"
#include "mesh/solids.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/tets/tetrahedralize.hpp"
#include "mesh/wrap/hole_caps.hpp"
#include "mesh/wrap/unit_frame.hpp"
#include "mesh/wrap/wrap_process.hpp"

namespace elastolab {

namespace {

/// A wall of a wrap is thin where its other side is closer than so many offsets: around an open sheet it is two. A
/// rough wrap has to be surer: what is thin beside its offset need not be beside that of a finer one.
constexpr double kThinWall = 3.0, kThinRoughWall = 2.3;
constexpr int kMostRepairs = 8;
/// Fraction of a wrap's vertices on thin walls above which it is taken for one of open sheets.
constexpr double kMostThin = 0.3;

using CornerKey = std::array<std::array<double, 3>, 3>;

/// The corners of a triangle in an order that does not depend on where it begins and which side it shows.
CornerKey sorted_corners(const TrianglePoints& p) {
    CornerKey corners;
    const Eigen::Vector3d* points[3] = {&p.a, &p.b, &p.c};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = {points[i]->x(), points[i]->y(), points[i]->z()};
    std::sort(corners.begin(), corners.end());
    return corners;
}

std::size_t hash_of(const CornerKey& corners) {
    std::size_t hash = 0;
    for (const auto& corner : corners)
        for (const double x : corner) hash = 31 * hash + std::hash<double>()(x);
    return hash;
}

/// The triangles that can be wrapped: each once, since a search tree finds no way among thousands in one place. Without
/// vertices that belong to none.
SurfaceMesh solid_triangles(const SurfaceMesh& shown) {
    std::vector<std::pair<std::size_t, int>> by_hash;
    for (int t = 0; t < shown.n_triangles(); ++t)
        by_hash.emplace_back(hash_of(sorted_corners(triangle_points(shown, t))), t);
    std::sort(by_hash.begin(), by_hash.end());
    std::vector<int> kept;
    for (std::size_t i = 0; i < by_hash.size(); ++i) {
        const bool repeats = i > 0 && by_hash[i].first == by_hash[i - 1].first &&
                             sorted_corners(triangle_points(shown, by_hash[i].second)) ==
                                 sorted_corners(triangle_points(shown, by_hash[i - 1].second));
        if (!repeats) kept.push_back(by_hash[i].second);
    }
    std::sort(kept.begin(), kept.end());
    return without_unused({shown.vertices, shown.triangles(Eigen::all, kept)});
}

/// Vertices of a wrap whose other side is closer than this.
std::vector<bool> thin_walls(const SurfaceMesh& wrap, double thickness, Control& control) {
    std::vector<bool> thin;
    for (const double wall : wall_thickness(wrap, 1.5 * thickness, control)) thin.push_back(wall < thickness);
    return thin;
}

double part_of(const std::vector<bool>& chosen) {
    return static_cast<double>(std::count(chosen.begin(), chosen.end(), true)) / static_cast<double>(chosen.size());
}

/// Moves the vertices of a wrap onto the surface that it was made around.
class Settling {
public:
    Settling(const SurfaceMesh& wrap, double offset, const SurfaceMesh& around, Control& control)
        : wrap_(wrap), offset_(offset), control_(control), moved_(wrap) {
        const SurfacePlaces places = closest_points(around, wrap.vertices, control);
        find_thin(control);
        for (int v = 0; v < wrap.n_vertices(); ++v)
            if (!thin_[static_cast<std::size_t>(v)])
                moved_.vertices.col(v) = around.vertices(Eigen::all, places.nodes.col(v)) * places.weights.col(v);
    }

    /// As far as the surface stays sound.
    SurfaceMesh settle() {
        for (int repair = 0; repair < kMostRepairs; ++repair)
            if (!take_back_damaged()) return moved_;
        return wrap_;
    }
    double thin_part() const { return part_of(thin_); }

private:
    /// Where the other side is near, both would come down on the same sheet.
    void find_thin(Control& control) { thin_ = thin_walls(wrap_, kThinWall * offset_, control); }

    bool take_back_damaged() {
        std::vector<int> damaged;
        for (int t = 0; t < wrap_.n_triangles(); ++t) {
            const Eigen::Vector3d before = area_vector(triangle_points(wrap_, t));
            const Eigen::Vector3d after = area_vector(triangle_points(moved_, t));
            if (!(after.dot(before) > 0.3 * before.norm() * after.norm()) || after.norm() < 0.05 * before.norm())
                damaged.push_back(t);
        }
        if (damaged.empty())
            for (const auto& [a, b] : find_crossing_pairs(moved_, CrossingSearch::all, control_).pairs)
                damaged.insert(damaged.end(), {a, b});
        for (const int t : damaged)
            for (const int v : wrap_.triangles.col(t)) moved_.vertices.col(v) = wrap_.vertices.col(v);
        return !damaged.empty();
    }

    const SurfaceMesh& wrap_;
    double offset_;
    Control& control_;
    SurfaceMesh moved_;
    std::vector<bool> thin_;
};

bool is_sound(const SurfaceMesh& surface, Control& control) {
    return check_and_repair(surface, control).report.usable_for_fem();
}

/// Whether TetGen fills every solid of a sound surface.
bool can_be_filled(const SurfaceMesh& sound, Control& control) {
    try {
        for (const Solid& solid : split_solids(sound)) tetrahedralize(solid.surface, "", {}, control);
        return true;
    } catch (const MeshError&) {
        return false;
    }
}

/// Whether every method can use the surface, which is repaired where it is inside out.
bool serves_every_method(SurfaceMesh& surface, Control& control) {
    CheckedMesh checked = check_and_repair(surface, control);
    if (!checked.report.usable_for_fem() || !can_be_filled(checked.mesh, control)) return false;
    surface = std::move(checked.mesh);
    return true;
}

/// Whether the surface may be sound once its holes are closed. Where two holes meet in a vertex, it is a hinge;
/// vertices that belong to no triangle are left out anyway.
bool is_sound_but_for_holes(const MeshReport& report) {
    const auto is_of_holes = [](Defect::Kind kind) {
        return kind == Defect::Kind::open_edges || kind == Defect::Kind::non_manifold_vertices ||
               kind == Defect::Kind::unreferenced_vertices;
    };
    return std::all_of(report.defects.begin(), report.defects.end(), [&](const Defect& d) {
        return d.repaired || is_of_holes(d.kind) || !(d.fatal || d.fatal_for_fem);
    });
}

/// Parts of a collapsed surface may cross where it is thin; with somewhat other triangles they mostly do not. Nothing
/// when none of these is sound.
std::optional<SurfaceMesh> collapsed(const SurfaceMesh& sound, int n_vertices, Control& control) {
    for (const double part : {1.0, 1.15, 0.9, 1.35, 1.6}) {
        WrapResult result = collapse_edges(sound, static_cast<int>(part * n_vertices), control);
        if (result.failure.empty() && serves_every_method(result.surface, control)) return std::move(result.surface);
    }
    return std::nullopt;
}

/// A wrap of so many vertices rounds what is finer than its triangles and bridges gaps of their size; one of this many
/// times the vertices, with its edges collapsed, is far closer to the body and takes hardly longer.
constexpr int kFinerWrap = 4;
/// Factors by which wraps may miss the number of vertices wanted: another attempt takes as long as the wrap.
constexpr double kFinerWithin = 2.0, kWithin = 1.33;
/// The cube around a body of size 1 has no fewer.
constexpr int kFewestOfAWrap = 8;

/// Surfaces of more vertices are wrapped even where they are sound: to collapse their edges takes several times longer.
constexpr int kMostCollapsed = 100000;
/// So are those with more triangles around one vertex, as in the cap of a finely divided cylinder: to collapse its
/// edges takes a time that grows with the third power of their number, two seconds for 500.
constexpr int kMostAroundVertex = 700;

bool is_quick_to_collapse(const SurfaceMesh& surface) {
    if (surface.n_vertices() > kMostCollapsed) return false;
    std::vector<int> around(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const int v : surface.triangles.reshaped()) ++around[static_cast<std::size_t>(v)];
    return around.empty() || std::ranges::max(around) <= kMostAroundVertex;
}

WrapResult succeeded(WrapResult wrap) {
    if (wrap.failure.empty()) return wrap;
    throw MeshError("no closed surface could be made around it (" + wrap.failure +
                    "). Mend the file, or choose another.");
}

/// The settled wrap, or the wrap itself where the settled one does not satisfy `serves`; whether one does. `known`: a
/// rough one.
template <class Serves>
std::pair<ProxySurface, bool> settled_wrap(const SurfaceMesh& closed, int n_vertices, double within,
                                           const WrapResult& known, Control& control, const Serves& serves) {
    control.begin_stage("proxy: wrap");
    WrapResult wrap = succeeded(alpha_wrap(closed, n_vertices, within, known, control));
    control.begin_stage("proxy: settle");
    Settling settling(wrap.surface, wrap.offset, closed, control);
    ProxySurface proxy{.surface = settling.settle(), .kind = ProxySurface::Kind::wrapped};
    proxy.thin_part = settling.thin_part();
    proxy.thickness = 2.0 * wrap.offset;
    if (serves(proxy.surface)) return {std::move(proxy), true};
    proxy.surface = std::move(wrap.surface);
    const bool serving = serves(proxy.surface);
    return {std::move(proxy), serving};
}

/// A wrap that every method can use. TetGen finds no proper tetrahedra in some sharp corners; a rougher or finer wrap
/// has others. Where none of these serves, the first, which boundary elements can use.
ProxySurface wrapped_to(const SurfaceMesh& closed, int n_vertices, const WrapResult& known, Control& control) {
    std::optional<ProxySurface> first;
    for (const double part : {1.0, 0.8, 1.2, 0.6}) {
        auto [proxy, serves] =
            settled_wrap(closed, std::max(static_cast<int>(part * n_vertices), kFewestOfAWrap), kWithin, known, control,
                         [&](SurfaceMesh& surface) { return serves_every_method(surface, control); });
        if (serves) return std::move(proxy);
        if (!first) first = std::move(proxy);
    }
    return std::move(*first);
}

/// make(size) for each size, beside each other: most of it is work of helper processes.
template <class Make>
std::vector<ProxySurface> of_each(std::span<const int> sizes, Control& control, const Make& make) {
    std::vector<ProxySurface> proxies(sizes.size());
    parallel_blocks(static_cast<int>(sizes.size()), 1, control, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
            proxies[i] = make(sizes[i]);
    });
    return proxies;
}

/// Of the body's diagonal, which is 1: a wrap of some hundred vertices, for a tenth of what one for a proxy takes.
constexpr double kRoughAlpha = 1.0 / 12.0;

bool is_thin(const ProxySurface& proxy) { return proxy.thin_part > kMostThin; }

/// Whether these triangles with holes are sheets, of which no fine wrap is needed: thin beside a wrap of the wanted
/// size. `rough`: one that is known.
bool are_sheets(const HoleCaps& capped, int n_vertices, const WrapResult& rough, Control& control) {
    if (part_of(thin_walls(rough.surface, kThinRoughWall * rough.offset, control)) > kMostThin) return true;
    if (capped.n_left_open == 0) return false;  // a plate has a thickness of its own
    return is_thin(
        settled_wrap(capped.closed, n_vertices, kFinerWithin, rough, control, [](const auto&) { return true; }).first);
}

/// Open sheets are as thick as the wrap is coarse, and have to be: a finer one would make them too thin for its own
/// triangles.
std::vector<ProxySurface> wrapped(const HoleCaps& capped, std::span<const int> sizes, Control& control) {
    control.begin_stage("proxy: rough wrap");
    const SurfaceMesh& closed = capped.closed;
    const WrapResult rough = succeeded(alpha_wrap(closed, kRoughAlpha, control));
    const int largest = std::ranges::max(sizes);
    std::optional<ProxySurface> fine;
    if (!are_sheets(capped, largest, rough, control))
        fine =
            settled_wrap(closed, kFinerWrap * largest, kFinerWithin, rough, control, [&](const SurfaceMesh& surface) {
                return is_sound(surface, control);
            }).first;
    const bool collapses = fine && !is_thin(*fine);
    return of_each(sizes, control, [&](int n_vertices) {
        auto coarse = collapses ? collapsed(fine->surface, n_vertices, control) : std::nullopt;
        if (!coarse) return wrapped_to(closed, n_vertices, rough, control);
        ProxySurface proxy = *fine;
        proxy.surface = std::move(*coarse);
        return proxy;
    });
}

/// Nothing when some could not be made.
std::vector<ProxySurface> collapsed_to(const SurfaceMesh& sound, std::span<const int> sizes, Control& control) {
    std::atomic<bool> failed{false};
    auto proxies = of_each(sizes, control, [&](int n_vertices) {
        std::optional<SurfaceMesh> surface;
        if (sound.n_vertices() > n_vertices)
            surface = collapsed(sound, n_vertices, control);
        else if (SurfaceMesh itself = sound; serves_every_method(itself, control))
            surface = std::move(itself);
        if (!surface) failed = true;
        return ProxySurface{.surface = surface ? std::move(*surface) : SurfaceMesh{},
                            .kind = ProxySurface::Kind::collapsed};
    });
    return failed ? std::vector<ProxySurface>{} : proxies;
}

/// The surface itself, or with its holes closed, when that makes it sound: small ones smoothly if possible, else by
/// flat caps (half a ball would go on to the whole one).
std::optional<SurfaceMesh> sound_surface(const SurfaceMesh& surface, const HoleCaps& capped, const MeshReport& report,
                                         Control& control) {
    if (report.usable_for_fem()) return surface;
    if (capped.n_left_open > 0 || !is_sound_but_for_holes(report)) return std::nullopt;
    std::vector<SurfaceMesh> candidates;
    if (cap_holes(surface).n_left_open == 0)
        if (WrapResult filled = fill_holes(surface, HoleFilling::smooth, control); filled.failure.empty())
            candidates.push_back(std::move(filled.surface));
    candidates.push_back(capped.closed);
    for (SurfaceMesh& candidate : candidates) {
        CheckedMesh checked = check_and_repair(std::move(candidate), control);
        if (checked.report.usable_for_fem()) return std::move(checked.mesh);
    }
    return std::nullopt;
}

}  // namespace

std::vector<ProxySurface> make_proxy_surfaces(const SurfaceMesh& shown, const MeshReport& report,
                                              std::span<const int> sizes, Control& control, OpenSurface taken_for) {
    control.begin_stage("proxy");
    SurfaceMesh triangles = solid_triangles(shown);
    const UnitFrame frame = to_unit_size(triangles);
    const HoleCaps capped = cap_holes(triangles, taken_for);
    std::vector<ProxySurface> proxies;
    if (is_quick_to_collapse(triangles))
        if (const auto sound = sound_surface(triangles, capped, report, control))
            proxies = collapsed_to(*sound, sizes, control);
    if (proxies.empty()) proxies = wrapped(capped, sizes, control);
    for (ProxySurface& proxy : proxies) {
        proxy.n_capped_holes = capped.n_holes;
        proxy.n_open_holes = capped.n_left_open;
        proxy.surface.vertices = (proxy.surface.vertices * frame.scale).colwise() + frame.centre;
        proxy.thickness *= frame.scale;
    }
    return proxies;
}

}  // namespace elastolab
