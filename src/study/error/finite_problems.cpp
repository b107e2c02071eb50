#include "study/error/finite_problems.hpp"

#include <cmath>
#include <Eigen/Geometry>
#include <numbers>

#include "mesh/primitives.hpp"
#include "study/error/radial_equilibrium.hpp"
#include "study/error/study_bar.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

constexpr double kOnFace = 1e-9;
constexpr int kSteps = 2000;  ///< of the differential equations: errors of 1e-11

double radians(double degrees) { return degrees / 180.0 * std::numbers::pi; }

/// place: where a point goes. constrained: whether a point is prescribed.
template <class Place, class Constrained>
Problem placed(SurfaceMesh mesh, double nu, const Place& place, const Constrained& constrained) {
    Problem problem;
    problem.truth.resize(mesh.vertices.size());
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        const Eigen::Vector3d x = mesh.vertices.col(v);
        problem.truth.segment<3>(3 * v) = place(x) - x;
    }
    problem.constrained = vertices_where(mesh, constrained);
    problem.body = study_body(std::move(mesh), {1.0, nu});
    return problem;
}

bool at_ends(const Eigen::Vector3d& x) { return x[0] < kOnFace || x[0] > 2.0 - kOnFace; }

std::vector<double> evenly(double low, double high) {
    std::vector<double> R;
    for (int i = 0; i <= kSteps; ++i) R.push_back(low + (high - low) * i / kSteps);
    return R;
}

/// The stretch across a bar that is stretched along itself and free around.
double stretch_across(double along, const Material& material) {
    const double mu = material.shear_modulus(), lambda = material.lame_lambda();
    double low = 1e-3, high = 1e3;  // mu (t^2 - 1) + lambda ln(along t^2) grows with t
    for (int i = 0; i < 100; ++i) {
        const double t = std::sqrt(low * high);
        (mu * (t * t - 1.0) + lambda * std::log(along * t * t) > 0.0 ? high : low) = t;
    }
    return std::sqrt(low * high);
}

double unit_weight(double) { return 1.0; }

}  // namespace

Problem finite_rotation(int cells, double poisson_ratio, double angle) {
    const Eigen::AngleAxisd turn(radians(angle), Eigen::Vector3d(1.0, 2.0, -1.0).normalized());
    return placed(
        study_bar(cells, true), poisson_ratio, [&](const Eigen::Vector3d& x) { return turn * x; }, at_ends);
}

Problem finite_stretch(int cells, double poisson_ratio, double stretch) {
    const double across = stretch_across(stretch, {1.0, poisson_ratio});
    const Eigen::Vector3d factors(stretch, across, across);
    return placed(
        study_bar(cells, true), poisson_ratio,
        [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return factors.cwiseProduct(x); }, at_ends);
}

Problem finite_bending(int cells, double poisson_ratio, double angle) {
    const double per_length = radians(angle) / 2.0, middle = 1.0 / per_length;
    const RadialForm form{.a = [=](double) { return per_length * per_length; },
                          .b = [=](double) { return per_length; },
                          .weight = unit_weight,
                          .power = 1};
    const RadialEquilibrium r(
        form, {1.0, poisson_ratio}, evenly(0.0, 1.0),
        [](double inner) {
            return RadialStart{inner, 0.0};
        },
        std::max(0.2 * middle, middle - 0.9), middle);
    const auto place = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        const double theta = per_length * (x[0] - 1.0);
        return {1.0 + r(x[2]) * std::sin(theta), x[1], r(x[2]) * std::cos(theta) - middle + 0.5};
    };
    return placed(study_bar(cells, false), poisson_ratio, place,
                  [](const Eigen::Vector3d& x) { return at_ends(x) || x[1] < kOnFace || x[1] > 1.0 - kOnFace; });
}

Problem finite_torsion(int cells, double poisson_ratio, double angle) {
    constexpr double kCore = 1e-4, kRadius = 0.5, kHeight = 2.0;  // within the core r is proportional to R
    const double twist = radians(angle) / kHeight;
    const RadialForm form{.a = [=](double R) { return 1.0 / (R * R) + twist * twist; },
                          .b = [](double R) { return 1.0 / R; },
                          .weight = [](double R) { return R; },
                          .power = 1};
    std::vector<double> R;
    for (int i = 0; i <= 2 * kSteps; ++i) R.push_back(kCore * std::pow(kRadius / kCore, 0.5 * i / kSteps));
    const Material material{1.0, poisson_ratio};
    const double mu = material.shear_modulus(), lambda = material.lame_lambda();
    const RadialEquilibrium r(
        form, material, R,
        [=](double t) {
            return RadialStart{t * kCore, kCore * (mu * t - (mu - 2.0 * lambda * std::log(t)) / t)};
        },
        0.3, 1.2);
    const auto place = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        const double before = x.head<2>().norm(), now = before < kCore ? r(kCore) / kCore * before : r(before);
        const Eigen::Vector2d turned = Eigen::Rotation2Dd(twist * x[2]) * Eigen::Vector2d(x.head<2>());
        const Eigen::Vector2d moved = before > 0.0 ? Eigen::Vector2d(now / before * turned) : turned;
        return {moved[0], moved[1], x[2]};
    };
    return placed(make_cylinder(cells, kRadius, kHeight), poisson_ratio, place,
                  [](const Eigen::Vector3d& x) { return std::abs(x[2]) > 0.5 * kHeight - kOnFace; });
}

Problem finite_swelling(int cells, double poisson_ratio, double stretch) {
    constexpr double kInner = 0.5;
    const RadialForm form{.a = [](double R) { return 2.0 / (R * R); },
                          .b = [](double R) { return 1.0 / (R * R); },
                          .weight = [](double R) { return R * R; },
                          .power = 2};
    const Material material{1.0, poisson_ratio};
    const double mu = material.shear_modulus(), lambda = material.lame_lambda();
    const RadialEquilibrium r(
        form, material, evenly(kInner, 1.0),
        [=](double p) {
            const double c = mu - lambda * std::log(p * stretch * stretch);
            return RadialStart{stretch * kInner, kInner * kInner * (mu * p - c / p)};
        },
        0.2 / (stretch * stretch), 2.0);
    return placed(
        make_hollow_sphere(cells, 1.0, kInner), poisson_ratio,
        [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return r(x.norm()) / x.norm() * x; },
        [](const Eigen::Vector3d& x) { return x.norm() < 0.75; });
}

}  // namespace elastolab
