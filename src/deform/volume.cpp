#include "deform/volume.hpp"

#include "deform/solid_model.hpp"

namespace elastolab {

std::shared_ptr<const Volume> Volume::of(const std::shared_ptr<const Model>& model, Control& control) {
    std::shared_ptr<Volume> volume(new Volume());
    TetMesh& all = volume->mesh_;
    all.vertices = model->body().surface->vertices;
    all.n_surface_vertices = static_cast<int>(all.vertices.cols());
    for (const Model::Part& part : model->parts()) {
        control.checkpoint();
        std::shared_ptr<const Interior> interior = part.solid->interior(control);
        if (!interior) return nullptr;
        const TetMesh* tets = &interior->tetrahedra();
        const int n_inside = tets->n_vertices() - tets->n_surface_vertices;
        std::vector<int> vertices = part.vertices;
        for (int i = 0; i < n_inside; ++i) vertices.push_back(static_cast<int>(all.vertices.cols()) + i);
        all.vertices.conservativeResize(Eigen::NoChange, all.vertices.cols() + n_inside);
        all.vertices.rightCols(n_inside) = (tets->vertices.rightCols(n_inside) / part.scale).colwise() + part.origin;
        const Eigen::Index before = all.tetrahedra.cols();
        all.tetrahedra.conservativeResize(Eigen::NoChange, before + tets->n_tetrahedra());
        for (Eigen::Index t = 0; t < tets->tetrahedra.cols(); ++t)
            for (int corner = 0; corner < 4; ++corner)
                all.tetrahedra(corner, before + t) = vertices[static_cast<std::size_t>(tets->tetrahedra(corner, t))];
        volume->parts_.push_back({std::move(vertices), tets->n_surface_vertices,
                                  model->method().kind->linear ? 1.0 : part.scale, std::move(interior)});
    }
    return volume;
}

Eigen::VectorXd Volume::displace(const Eigen::VectorXd& surface) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(3 * mesh_.vertices.cols());
    for (const Part& part : parts_) {
        Eigen::VectorXd own(3 * part.n_surface);
        for (int i = 0; i < part.n_surface; ++i)
            own.segment<3>(3 * i) = surface.segment<3>(3 * part.vertices[static_cast<std::size_t>(i)]);
        const Eigen::VectorXd extended = part.interior->extend(part.unit * own) / part.unit;
        for (std::size_t i = 0; i < part.vertices.size(); ++i)
            all.segment<3>(3 * part.vertices[i]) = extended.segment<3>(3 * static_cast<Eigen::Index>(i));
    }
    return all;
}

}  // namespace elastolab
