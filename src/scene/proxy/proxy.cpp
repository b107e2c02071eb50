#include "scene/proxy/proxy.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "mesh/measures.hpp"
#include "mesh/wrap/filled_surface.hpp"

namespace elastolab {

namespace {

/// Share of a proxy's vertices on thin walls above which that is reported.
constexpr double kManyThin = 0.05;
/// Distances up to this, in edges of the proxy, count as zero.
constexpr double kNoDistance = 1e-9;

/// A shown vertex that `surface` also has is at a corner of a triangle; the others are at their closest points.
SurfacePlaces own_places(const SurfaceMesh& surface, const Positions& shown, const std::vector<int>& own,
                         Control& control) {
    SurfacePlaces places = closest_points(surface, shown, control);
    std::vector<Eigen::Vector3i> corners(static_cast<std::size_t>(surface.n_vertices()));
    for (const auto& triangle : surface.triangles.colwise())
        for (int k = 0; k < 3; ++k)
            corners[static_cast<std::size_t>(triangle[k])] << triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3];
    for (Eigen::Index v = 0; v < shown.cols(); ++v) {
        const int number = own[static_cast<std::size_t>(v)];
        if (number < 0) continue;
        places.nodes.col(v) = corners[static_cast<std::size_t>(number)];
        places.weights.col(v) = Eigen::Vector3d::UnitX();
        places.distance[v] = 0.0;
    }
    return places;
}

std::shared_ptr<Proxy> embedded(ProxySurface made, const std::shared_ptr<const SurfaceMesh>& shown,
                                const MeshReport& report, Control& control, const std::vector<int>& own = {}) {
    control.begin_stage("proxy: attach");
    auto proxy = std::make_shared<Proxy>();
    // That of equilateral triangles of the mean area.
    proxy->edge = std::sqrt(4.0 / std::sqrt(3.0) * surface_area(made.surface) / made.surface.n_triangles());
    proxy->kind = made.kind;
    proxy->shown_is_sound = report.usable_for_fem();
    proxy->n_closed_holes = made.n_capped_holes;
    proxy->n_open_holes = made.n_open_holes;
    proxy->thin_part = made.thin_part;
    proxy->thickness = made.thickness;
    proxy->surface = std::make_shared<const SurfaceMesh>(std::move(made.surface));
    proxy->shown = shown;
    proxy->places = own.empty() ? closest_points(*proxy->surface, shown->vertices, control)
                                : own_places(*proxy->surface, shown->vertices, own, control);
    return proxy;
}

}  // namespace

void require_shape(const MeshReport& report, const std::string& name) {
    for (const Defect& defect : report.defects)
        if (defect.kind == Defect::Kind::no_triangles || defect.kind == Defect::Kind::too_small)
            throw MeshError(name + ": " + defect.text);
}

std::vector<std::shared_ptr<const Proxy>> make_proxies(const std::string& name,
                                                       const std::shared_ptr<const SurfaceMesh>& shown,
                                                       const MeshReport& report, std::span<const int> sizes,
                                                       Control& control, OpenSurface taken_for) {
    require_shape(report, name);
    try {
        std::vector<std::shared_ptr<const Proxy>> proxies;
        for (ProxySurface& surface : make_proxy_surfaces(*shown, report, sizes, control, taken_for)) {
            const auto proxy = embedded(std::move(surface), shown, report, control);
            proxy->taken_for = taken_for;
            proxies.push_back(proxy);
        }
        return proxies;
    } catch (const MeshError& error) {
        throw MeshError(name + ": " + error.what());
    }
}

std::shared_ptr<const Proxy> make_proxy(const std::string& name, const std::shared_ptr<const SurfaceMesh>& shown,
                                        const MeshReport& report, const ProxyChoice& choice, Control& control) {
    const std::array sizes = {choice.n_vertices};
    if (choice.use != ProxyUse::fill)
        return make_proxies(name, shown, report, sizes, control, choice.taken_for).front();
    require_shape(report, name);
    try {
        FilledSurface filled = fill_holes(*shown, control);
        return embedded({.surface = std::move(filled.surface),
                         .kind = ProxySurface::Kind::filled,
                         .n_capped_holes = filled.n_holes},
                        shown, report, control, filled.own);
    } catch (const MeshError& error) {
        throw MeshError(name + ": " + error.what());
    }
}

std::shared_ptr<const Proxy> make_coarser_proxy(const std::string& name, const Proxy& fine, int n_vertices,
                                                Control& control) {
    const MeshReport report = check_and_repair(*fine.surface, control).report;
    try {
        auto surfaces = make_proxy_surfaces(*fine.surface, report, std::span(&n_vertices, 1), control);
        return embedded(std::move(surfaces.front()), fine.shown, report, control);
    } catch (const MeshError& error) {
        throw MeshError(name + ": " + error.what());
    }
}

Findings findings_of_proxy(const Proxy& proxy, const std::string& name) {
    if (proxy.is_filled())
        return {{.kind = FindingKind::filled_holes,
                 .value = static_cast<double>(proxy.n_closed_holes),
                 .first = proxy.surface->n_triangles() - proxy.shown->n_triangles(),
                 .object = name}};
    const double largest = proxy.places.distance.maxCoeff();
    Findings findings = {{.kind = proxy.shown_is_sound ? FindingKind::chosen_proxy : FindingKind::proxy,
                          .value = largest > kNoDistance * proxy.edge ? largest : 0.0,
                          .first = proxy.surface->n_vertices(),
                          .object = name}};
    if (proxy.n_closed_holes > 0)
        findings.push_back(
            {.kind = FindingKind::capped_holes, .value = static_cast<double>(proxy.n_closed_holes), .object = name});
    if (proxy.thin_part > kManyThin)
        findings.push_back(
            {.kind = FindingKind::thin_sheets, .value = proxy.thickness, .first = proxy.n_open_holes, .object = name});
    else if (proxy.taken_for == OpenSurface::sheet && proxy.n_open_holes > 0)
        findings.push_back(
            {.kind = FindingKind::narrow_openings, .value = static_cast<double>(proxy.n_open_holes), .object = name});
    return findings;
}

}  // namespace elastolab
