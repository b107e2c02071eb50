#include "scene/proxy/proxy.hpp"

#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace {

/// Part of a proxy's vertices from which it is told that they belong to thin walls.
constexpr double kManyThin = 0.05;

std::shared_ptr<const Proxy> embedded(ProxySurface made, const std::shared_ptr<const SurfaceMesh>& shown,
                                      const MeshReport& report, Control& control) {
    auto proxy = std::make_shared<Proxy>();
    // That of equal-sided triangles of the mean area.
    proxy->edge = std::sqrt(4.0 / std::sqrt(3.0) * surface_area(made.surface) / made.surface.n_triangles());
    proxy->kind = made.kind;
    proxy->shown_is_sound = report.usable_for_fem();
    proxy->n_capped_holes = made.n_capped_holes;
    proxy->thin_part = made.thin_part;
    proxy->thickness = made.thickness;
    proxy->surface = std::make_shared<const SurfaceMesh>(std::move(made.surface));
    proxy->shown = shown;
    proxy->places = closest_points(*proxy->surface, shown->vertices, control);
    return proxy;
}

}  // namespace

void require_shape(const MeshReport& report, const std::string& name) {
    for (const Defect& defect : report.defects)
        if (defect.kind == Defect::Kind::no_triangles || defect.kind == Defect::Kind::non_finite)
            throw MeshError(name + ": " + defect.text);
}

std::vector<std::shared_ptr<const Proxy>> make_proxies(const std::string& name,
                                                       const std::shared_ptr<const SurfaceMesh>& shown,
                                                       const MeshReport& report, std::span<const int> sizes,
                                                       Control& control) {
    require_shape(report, name);
    try {
        std::vector<std::shared_ptr<const Proxy>> proxies;
        for (ProxySurface& surface : make_proxy_surfaces(*shown, report, sizes, control))
            proxies.push_back(embedded(std::move(surface), shown, report, control));
        return proxies;
    } catch (const MeshError& error) {
        throw MeshError(name + ": " + error.what());
    }
}

Findings findings_of_proxy(const Proxy& proxy, const std::string& name) {
    Findings findings = {{.kind = proxy.shown_is_sound ? FindingKind::chosen_proxy : FindingKind::proxy,
                          .value = proxy.places.distance.maxCoeff(),
                          .first = proxy.surface->n_vertices(),
                          .object = name}};
    if (proxy.n_capped_holes > 0)
        findings.push_back(
            {.kind = FindingKind::capped_holes, .value = static_cast<double>(proxy.n_capped_holes), .object = name});
    if (proxy.thin_part > kManyThin)
        findings.push_back({.kind = FindingKind::thin_sheets, .value = proxy.thickness, .object = name});
    return findings;
}

}  // namespace elastolab
