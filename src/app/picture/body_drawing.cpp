#include "app/picture/body_drawing.hpp"

#include "mesh/numbering.hpp"

namespace elastolab {

namespace {

void update_surface(const Positions& positions, const std::vector<float>& values, const SceneFrame& frame,
                    SurfaceDrawing& target) {
    target.update(positions, frame);
    if (values.empty())
        target.clear_scalars();
    else
        target.set_vertex_scalars(values);
}

}  // namespace

SurfaceRim rim_of(const Triangles& triangles) {
    SurfaceRim rim{unpaired_edges(triangles), {}};
    rim.vertices = used_vertices(rim.edges);
    renumber(rim.edges, rim.vertices);
    return rim;
}

BodyDrawing::BodyDrawing(const SurfaceMesh& mesh, const SurfaceRim& rim_of_surface)
    : surface(mesh.vertices, mesh.triangles) {
    if (rim_of_surface.edges.cols() > 0) rim.emplace(rim_of_surface.edges);
}

void BodyDrawing::update(const ShownBody& body, const SurfaceRim& rim_of_surface, const SceneFrame& frame) {
    if (revision_ == body.revision()) return;
    revision_ = body.revision();
    update_surface(body.positions(), body.values(), frame, surface);
    if (rim) rim->update(Positions(body.positions()(Eigen::all, rim_of_surface.vertices)), frame);
    update_section(body, frame);
    update_filling(body, frame);
}

void BodyDrawing::update_section(const ShownBody& body, const SceneFrame& frame) {
    if (!body.section()) return section.reset();
    const ShownSection& shown = *body.section();
    if (!section || section_shape_ != shown.shape) {
        section.emplace(shown.shape->rest(), shown.shape->triangles());
        section_shape_ = shown.shape;
    }
    update_surface(shown.positions, shown.values, frame, *section);
}

/// Where the body is cut open, what is left of it there.
void BodyDrawing::update_filling(const ShownBody& body, const SceneFrame& frame) {
    if (!body.filling()) return filling.reset();
    const std::optional<ShownSection>& cut = body.section();
    const ShownFilling& whole = *body.filling();
    const Triangles& triangles = cut ? cut->shape->filling() : whole.shape->triangles();
    if (triangles.cols() == 0) return filling.reset();
    const std::shared_ptr<const void> shape = cut ? std::shared_ptr<const void>(cut->shape) : whole.shape;
    if (!filling || filling_shape_ != shape) {
        filling.emplace(cut ? cut->shape->rest() : whole.shape->rest(), triangles);
        filling_shape_ = shape;
    }
    if (cut)
        update_surface(cut->positions, cut->values, frame, *filling);
    else
        update_surface(whole.positions, whole.values, frame, *filling);
}

}  // namespace elastolab
