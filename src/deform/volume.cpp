#include "deform/volume.hpp"

#include <Eigen/LU>
#include <optional>
#include <vector>

#include "deform/interior.hpp"
#include "deform/solid_model.hpp"
#include "elasticity/neo_hookean.hpp"

namespace elastolab {

namespace {

/// Adds cells, their vertices renumbered, on the right.
template <class Cells>
void append(const Eigen::MatrixXi& own, const std::vector<int>& vertices, Cells& all) {
    const Eigen::Index before = all.cols();
    if (before == 0) all.resize(own.rows(), 0);
    all.conservativeResize(Eigen::NoChange, before + own.cols());
    for (Eigen::Index c = 0; c < own.cols(); ++c)
        for (Eigen::Index i = 0; i < own.rows(); ++i)
            all(i, before + c) = vertices[static_cast<std::size_t>(own(i, c))];
}

/// Gradients of the barycentric coordinates, one a row.
Eigen::Matrix<double, 4, 3> coordinate_slopes(const Positions& x, const Eigen::Vector4i& corners) {
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i) edges.col(i) = x.col(corners[i + 1]) - x.col(corners[0]);
    Eigen::Matrix<double, 4, 3> slopes;
    slopes.bottomRows<3>() = edges.inverse();
    slopes.row(0) = -slopes.bottomRows<3>().colwise().sum();
    return slopes;
}

/// Of the displacement, in the middle of an element of first degree.
Eigen::Matrix3d linear_gradient(const Eigen::Matrix3Xd& u, const Eigen::VectorXi& element,
                                const Eigen::Matrix<double, 4, 3>& slopes) {
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 4; ++i) gradient += u.col(element[i]) * slopes.row(i);
    return gradient;
}

/// Of second degree: there the shape functions of the corners have no slope, and those of the midpoints the sum of the
/// slopes at both ends.
Eigen::Matrix3d quadratic_gradient(const Eigen::Matrix3Xd& u, const Eigen::VectorXi& element,
                                   const Eigen::Matrix<double, 4, 3>& slopes) {
    constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    for (int e = 0; e < 6; ++e)
        gradient += u.col(element[4 + e]) * (slopes.row(kEdges[e][0]) + slopes.row(kEdges[e][1]));
    return gradient;
}

}  // namespace

std::shared_ptr<const Volume> Volume::of(const std::shared_ptr<const Model>& model, Control& control) {
    std::shared_ptr<Volume> volume(new Volume());
    TetMesh& all = volume->mesh_;
    all.vertices = model->body().surface->vertices;
    all.n_surface_vertices = static_cast<int>(all.vertices.cols());
    for (const Model::Part& part : model->parts()) {
        control.checkpoint();
        const std::optional<Interior> interior = part.solid->interior();
        if (!interior) return nullptr;
        const TetMesh& tets = *interior->tetrahedra;
        const int n_inside = tets.n_vertices() - tets.n_surface_vertices;
        std::vector<int> vertices = part.vertices;
        for (int i = 0; i < n_inside; ++i) vertices.push_back(static_cast<int>(all.vertices.cols()) + i);
        all.vertices.conservativeResize(Eigen::NoChange, all.vertices.cols() + n_inside);
        all.vertices.rightCols(n_inside) = (tets.vertices.rightCols(n_inside) / part.scale).colwise() + part.origin;
        append(tets.tetrahedra, vertices, all.tetrahedra);
        append(interior->elements, vertices, volume->elements_);
    }
    return volume;
}

Eigen::MatrixXd Volume::element_stresses(const Eigen::Matrix3Xd& u, const Material& material,
                                         bool large_deformations) const {
    Eigen::MatrixXd stresses(6, elements_.cols());
    for (Eigen::Index t = 0; t < elements_.cols(); ++t) {
        const Eigen::VectorXi element = elements_.col(t);
        const Eigen::Matrix<double, 4, 3> slopes = coordinate_slopes(mesh_.vertices, element.head<4>());
        const Eigen::Matrix3d gradient =
            element.size() == 10 ? quadratic_gradient(u, element, slopes) : linear_gradient(u, element, slopes);
        stresses.col(t) = stress_of(gradient, material, large_deformations);
    }
    return stresses;
}

}  // namespace elastolab
