#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "deform/finding.hpp"
#include "mesh/closest_point.hpp"
#include "mesh/wrap/proxy_surface.hpp"
#include "scene/document.hpp"

namespace elastolab {

/// A closed surface that is simulated in place of the shown one, and how the shown one is attached to it. A filled one
/// is the shown surface with its holes closed: it has every shown vertex that belongs to a triangle.
struct Proxy {
    std::shared_ptr<const SurfaceMesh> shown, surface;
    SurfacePlaces places;  ///< of the shown vertices on `surface`: they move with these points
    double edge = 0.0;     ///< mean edge of `surface` [L]
    ProxySurface::Kind kind = ProxySurface::Kind::wrapped;
    bool shown_is_sound = false;  ///< every method could simulate it itself
    int n_closed_holes = 0;       ///< filled, or capped before it was made (see ProxySurface)
    int n_open_holes = 0;         ///< left open, since their part of the surface was taken for a sheet
    OpenSurface taken_for = OpenSurface::automatic;  ///< what was asked for
    double thin_part = 0.0, thickness = 0.0;

    bool is_filled() const { return kind == ProxySurface::Kind::filled; }
};

/// Makes proxies of about each of these numbers of vertices (mesh/wrap/proxy_surface.hpp) and embeds the shown
/// vertices. `name` is for messages. Throws MeshError also when no triangle has finite points; Cancelled.
std::vector<std::shared_ptr<const Proxy>> make_proxies(const std::string& name,
                                                       const std::shared_ptr<const SurfaceMesh>& shown,
                                                       const MeshReport& report, std::span<const int> sizes,
                                                       Control& control,
                                                       OpenSurface taken_for = OpenSurface::automatic);

/// The one that a scene's choice asks for: with about its number of vertices, or the surface with its holes filled.
/// Throws as make_proxies, and MeshError when the filled surface is no solid.
std::shared_ptr<const Proxy> make_proxy(const std::string& name, const std::shared_ptr<const SurfaceMesh>& shown,
                                        const MeshReport& report, const ProxyChoice& choice, Control& control);

/// One of about `n_vertices` vertices, of what `fine` simulates, for the same shown vertices. Throws as make_proxies.
std::shared_ptr<const Proxy> make_coarser_proxy(const std::string& name, const Proxy& fine, int n_vertices,
                                                Control& control);

/// Throws MeshError with `name` where no proxy can help: no triangle of finite points, or all of them far too small.
void require_shape(const MeshReport& report, const std::string& name);

/// What the person should know of it; `name` is that of the mesh that is shown.
Findings findings_of_proxy(const Proxy& proxy, const std::string& name);

}  // namespace elastolab
