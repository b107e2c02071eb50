#include "app/picture/patch_areas.hpp"

#include <algorithm>
#include <utility>

#include "mesh/numbering.hpp"
#include "render/gl/arrays.hpp"

namespace elastolab {

namespace {

constexpr float kOutlineWidth = 2.2f;

/// The triangles all of whose corners are marked.
Triangles triangles_within(const SurfaceMesh& mesh, const std::vector<char>& marked) {
    std::vector<int> found;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const auto corners = mesh.triangles.col(t);
        if (std::all_of(corners.begin(), corners.end(),
                        [&](int v) { return marked[static_cast<std::size_t>(v)] != 0; }))
            found.push_back(t);
    }
    return mesh.triangles(Eigen::all, found);
}

}  // namespace

/// Null where it has no triangle.
std::unique_ptr<PatchAreas::Area> PatchAreas::make(const SurfaceMesh& mesh, std::span<const int> vertices) {
    std::vector<char> marked(static_cast<std::size_t>(mesh.n_vertices()), 0);
    for (const int v : vertices) marked[static_cast<std::size_t>(v)] = 1;
    Triangles triangles = triangles_within(mesh, marked);
    if (triangles.cols() == 0) return nullptr;
    auto area = std::make_unique<Area>();
    area->vertices.assign(vertices.begin(), vertices.end());
    area->corners = used_vertices(triangles);
    renumber(triangles, area->corners);
    area->surface = std::make_unique<SurfaceDrawing>(Positions(mesh.vertices(Eigen::all, area->corners)), triangles);
    if (const Edges rim = unpaired_edges(triangles); rim.cols() > 0)
        area->outline = std::make_unique<LinesDrawing>(rim);
    return area;
}

std::vector<char> PatchAreas::update(const SurfaceMesh& mesh, const Positions& positions, const SceneFrame& frame,
                                     std::span<const Patch> patches, bool moved) {
    std::vector<std::unique_ptr<Area>> before = std::exchange(areas_, {});
    std::vector<char> is_area;
    for (const Patch& patch : patches) {
        is_area.push_back(0);
        if (patch.vertices.size() <= kMostDots) continue;
        const auto known = std::find_if(before.begin(), before.end(), [&](const std::unique_ptr<Area>& area) {
            return area && std::equal(patch.vertices.begin(), patch.vertices.end(), area->vertices.begin(),
                                      area->vertices.end());
        });
        const bool is_new = known == before.end();
        std::unique_ptr<Area> area = is_new ? make(mesh, patch.vertices) : std::move(*known);
        if (!area) continue;
        area->colour = patch.colour;
        area->tint = patch.tint;
        if (is_new || moved) {
            const Positions places = positions(Eigen::all, area->corners);
            area->surface->update(places, frame);
            if (area->outline) area->outline->update(places, frame);
        }
        areas_.push_back(std::move(area));
        is_area.back() = 1;
    }
    return is_area;
}

void PatchAreas::draw(const SceneView& view) {
    for (const std::unique_ptr<Area>& area : areas_) {
        SurfaceStyle style;
        style.colour = style.inside = area->colour;
        style.opacity = area->tint;
        style.overlay = style.plain = true;
        if (area->tint > 0.0f) area->surface->draw(view, style);
        if (area->outline) area->outline->draw(view, {.colour = area->colour, .width = kOutlineWidth});
    }
}

}  // namespace elastolab
