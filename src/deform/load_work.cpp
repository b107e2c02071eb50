#include "deform/load_work.hpp"

#include <Eigen/Geometry>

#include "mesh/measures.hpp"

namespace elastolab {

namespace {

using Eigen::Vector3d;

/// The integral of a product of two functions that are linear on a triangle: A/12 (a . b + (sum a) . (sum b)).
double product_integral(double area, const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    return area / 12.0 * ((a.array() * b.array()).sum() + a.rowwise().sum().dot(b.rowwise().sum()));
}

/// The field of a body force b that it needs no volume for.
struct Particular {
    Vector3d b, middle;
    double factor;  ///< (1 - 2 nu) / E
    Vector3d operator()(const Vector3d& at) const {
        const Vector3d x = at - middle;
        return -factor * (b.dot(x) * x - 0.5 * x.squaredNorm() * b);
    }
};

/// int b . u' dV = -factor int [(b . x)^2 - |x|^2 |b|^2 / 2] dV: second moments, by tetrahedra from the middle.
double own_work(const SurfaceMesh& mesh, const Particular& field) {
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(mesh, t);
        const Vector3d a = p.a - field.middle, b = p.b - field.middle, c = p.c - field.middle, sum = a + b + c;
        const double volume = a.dot(b.cross(c)) / 6.0;
        second += volume / 20.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
    return -field.factor * (field.b.dot(second * field.b) - 0.5 * second.trace() * field.b.squaredNorm());
}

}  // namespace

double work_of_loads(const Model& model, const ConstrainedSet& set, const Eigen::VectorXd& values,
                     const Deformer::Answer& answer) {
    const SurfaceMesh& mesh = *model.body().surface;
    const Material& material = model.body().material;
    const Eigen::VectorXd factors = values.tail(std::ssize(set.loads));
    Vector3d b = Vector3d::Zero();
    Eigen::Matrix3Xd g = Eigen::Matrix3Xd::Zero(3, mesh.n_triangles());
    for (std::size_t i = 0; i < set.loads.size(); ++i) {
        const UnitLoad& load = set.loads[i];
        const double factor = factors[static_cast<Eigen::Index>(i)];
        if (load.is_body_force()) b += factor * load.body_force;
        for (std::size_t k = 0; k < load.triangles.size(); ++k)
            g.col(load.triangles[k]) += factor * load.tractions.col(static_cast<Eigen::Index>(k));
    }
    const Particular field{b, mesh.vertices.rowwise().mean(),
                           (1.0 - 2.0 * material.poisson_ratio) / material.young_modulus};
    double work = b.isZero(0.0) ? 0.0 : own_work(mesh, field);
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const Vector3d normal_area = 0.5 * area_vector(triangle_points(mesh, t)), n = normal_area.normalized();
        Eigen::Matrix3d u, potential_n, particular;
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.triangles(k, t);
            u.col(k) = answer.displacements.segment<3>(3 * v);
            particular.col(k) = field(mesh.vertices.col(v));
            potential_n.col(k) = b.dot(mesh.vertices.col(v) - field.middle) * n;
        }
        const double area = normal_area.norm();
        work += area / 3.0 * g.col(t).dot(u.rowwise().sum());
        if (!b.isZero(0.0))
            work += product_integral(area, u, potential_n) + area / 3.0 * g.col(t).dot(particular.rowwise().sum());
    }
    if (b.isZero(0.0)) return work;
    for (std::size_t i = 0; i < set.fixed.size() + set.handles.size(); ++i) {
        const int v = i < set.fixed.size() ? set.fixed[i] : set.handles[i - set.fixed.size()];
        work += answer.reactions.forces.col(static_cast<Eigen::Index>(i)).dot(field(mesh.vertices.col(v)));
    }
    return work;
}

}  // namespace elastolab
