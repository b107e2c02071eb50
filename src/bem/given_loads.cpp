#include "bem/given_loads.hpp"

#include <algorithm>
#include <utility>

namespace elastolab {

namespace {

GivenTractions constant_tractions(std::span<const UnitLoad> loads) {
    std::vector<int> triangles;
    for (const UnitLoad& load : loads) triangles.insert(triangles.end(), load.triangles.begin(), load.triangles.end());
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    GivenTractions given{
        constant_elements(triangles), Eigen::MatrixXd::Zero(3 * std::ssize(triangles), std::ssize(loads)), {}};
    for (std::size_t i = 0; i < loads.size(); ++i)
        for (std::size_t k = 0; k < loads[i].triangles.size(); ++k) {
            const auto slot =
                std::lower_bound(triangles.begin(), triangles.end(), loads[i].triangles[k]) - triangles.begin();
            given.coefficients.block<3, 1>(3 * slot, static_cast<Eigen::Index>(i)) +=
                loads[i].tractions.col(static_cast<Eigen::Index>(k));
        }
    return given;
}

/// (b . x) n, linear on every triangle.
GivenTractions tractions_of_body_forces(const Boundary& boundary, std::span<const UnitLoad> loads) {
    const SurfaceMesh& mesh = boundary.mesh();
    const BodyForceField field(mesh, 0.0);
    GivenTractions given;
    given.elements.order = Elements::Order::linear;
    given.elements.n_slots = 3 * boundary.n_triangles();
    given.coefficients.setZero(3 * given.elements.n_slots, std::ssize(loads));
    for (int t = 0; t < boundary.n_triangles(); ++t) {
        given.elements.elements.push_back({t, {3 * t, 3 * t + 1, 3 * t + 2}});
        const Eigen::Vector3d normal = Eigen::Map<const Eigen::Vector3d>(boundary.triangle(t).n);
        for (int corner = 0; corner < 3; ++corner)
            for (std::size_t i = 0; i < loads.size(); ++i)
                given.coefficients.block<3, 1>(3 * (3 * t + corner), static_cast<Eigen::Index>(i)) =
                    field.potential(mesh.vertices.col(mesh.triangles(corner, t)), loads[i].body_force) * normal;
    }
    return given;
}

/// u_h's inside with u_p and sigma_p on top.
class WithBodyForces : public InteriorField {
public:
    WithBodyForces(std::shared_ptr<const InteriorField> field, const BodyForceField& particular,
                   Eigen::Matrix3Xd body_forces)
        : field_(std::move(field)), particular_(particular), body_forces_(std::move(body_forces)) {}

    InteriorValues at(const Positions& points, Control& control) const override {
        InteriorValues values = field_->at(points, control);
        for (Eigen::Index c = 0; c < body_forces_.cols(); ++c)
            for (Eigen::Index i = 0; i < points.cols(); ++i) {
                const Eigen::Vector3d x = points.col(i), b = body_forces_.col(c);
                values.displacements.col(c).segment<3>(3 * i) += particular_.displacement(x, b);
                values.stresses.col(c).segment<3>(6 * i).array() -= particular_.potential(x, b);
            }
        return values;
    }

private:
    std::shared_ptr<const InteriorField> field_;
    BodyForceField particular_;
    Eigen::Matrix3Xd body_forces_;  ///< of each solution
};

bool has_body_force(std::span<const UnitLoad> loads) {
    return std::any_of(loads.begin(), loads.end(), [](const UnitLoad& load) { return load.is_body_force(); });
}

}  // namespace

BodyForceField::BodyForceField(const SurfaceMesh& mesh, double nu)
    : middle(mesh.vertices.rowwise().mean()), poisson_ratio(nu) {}

Eigen::Vector3d BodyForceField::displacement(const Eigen::Vector3d& at, const Eigen::Vector3d& b) const {
    const Eigen::Vector3d x = at - middle;
    return -(1.0 - 2.0 * poisson_ratio) * (b.dot(x) * x - 0.5 * x.squaredNorm() * b);
}

double BodyForceField::potential(const Eigen::Vector3d& at, const Eigen::Vector3d& b) const {
    return b.dot(at - middle);
}

ParticularField particular_field(const SurfaceMesh& mesh, double poisson_ratio, const Positions& prescribed,
                                 std::span<const UnitLoad> loads) {
    if (!has_body_force(loads) || poisson_ratio == 0.5) return {};
    const BodyForceField field(mesh, poisson_ratio);
    const auto at = [&](const Positions& points) {
        Eigen::MatrixXd u = Eigen::MatrixXd::Zero(points.size(), std::ssize(loads));
        for (std::size_t i = 0; i < loads.size(); ++i)
            for (Eigen::Index k = 0; k < points.cols() && loads[i].is_body_force(); ++k)
                u.col(static_cast<Eigen::Index>(i)).segment<3>(3 * k) =
                    field.displacement(points.col(k), loads[i].body_force);
        return u;
    };
    return {at(prescribed), at(mesh.vertices)};
}

std::vector<GivenTractions> given_tractions(const Boundary& boundary, std::span<const UnitLoad> loads) {
    std::vector<GivenTractions> kinds;
    for (const bool body : {true, false}) {
        std::vector<UnitLoad> some;
        std::vector<Eigen::Index> columns;
        for (std::size_t i = 0; i < loads.size(); ++i)
            if (loads[i].is_body_force() == body) {
                some.push_back(loads[i]);
                columns.push_back(static_cast<Eigen::Index>(i));
            }
        if (some.empty()) continue;
        kinds.push_back(body ? tractions_of_body_forces(boundary, some) : constant_tractions(some));
        kinds.back().columns = std::move(columns);
    }
    return kinds;
}

void add_given(const Boundary& boundary, std::span<const UnitLoad> loads, const Eigen::MatrixXd& factors,
               SurfaceTractions& tractions) {
    for (const GivenTractions& given : given_tractions(boundary, loads))
        tractions.add(given.elements, given.coefficients * factors(given.columns, Eigen::all));
}

std::shared_ptr<const InteriorField> with_body_forces(std::shared_ptr<const InteriorField> field,
                                                      const SurfaceMesh& mesh, double poisson_ratio,
                                                      std::span<const UnitLoad> loads, const Eigen::MatrixXd& factors) {
    if (!has_body_force(loads)) return field;
    Eigen::Matrix3Xd body_forces = Eigen::Matrix3Xd::Zero(3, factors.cols());
    for (std::size_t i = 0; i < loads.size(); ++i)
        if (loads[i].is_body_force()) body_forces += loads[i].body_force * factors.row(static_cast<Eigen::Index>(i));
    return std::make_shared<const WithBodyForces>(std::move(field), BodyForceField(mesh, poisson_ratio),
                                                  std::move(body_forces));
}

}  // namespace elastolab
