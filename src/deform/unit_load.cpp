#include "deform/unit_load.hpp"

#include <array>
#include <bit>
#include <cassert>
#include <Eigen/Geometry>

#include "base/lapack.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace {

constexpr double kBalanced = 1e-6;
/// Square of the relative distance that counts as none.
constexpr double kNoSpread = 1e-12;

}  // namespace

bool UnitLoad::operator==(const UnitLoad& other) const {
    return body_force == other.body_force && triangles == other.triangles && follows == other.follows &&
           tractions.cols() == other.tractions.cols() && (tractions.size() == 0 || tractions == other.tractions);
}

std::vector<int> load_key(const UnitLoad& load) {
    std::vector<int> key = {-1};
    const auto add = [&](double number) {
        const auto halves = std::bit_cast<std::array<int, 2>>(number);
        key.insert(key.end(), halves.begin(), halves.end());
    };
    for (const double number : load.body_force) add(number);
    key.insert(key.end(), load.triangles.begin(), load.triangles.end());
    for (const double number : load.tractions.reshaped()) add(number);
    return key;
}

UnitLoad body_force_along(int axis) { return {.body_force = Eigen::Vector3d::Unit(axis)}; }

UnitLoad unit_traction(std::vector<int> triangles, const Eigen::Vector3d& traction) {
    UnitLoad load;
    load.triangles = std::move(triangles);
    load.tractions = traction.replicate(1, std::ssize(load.triangles));
    return load;
}

UnitLoad unit_pressure(const SurfaceMesh& surface, std::vector<int> triangles) {
    UnitLoad load = unit_traction(std::move(triangles), Eigen::Vector3d::Zero());
    load.follows = true;
    for (std::size_t i = 0; i < load.triangles.size(); ++i)
        load.tractions.col(static_cast<Eigen::Index>(i)) =
            -area_vector(triangle_points(surface, load.triangles[i])).normalized();
    return load;
}

UnitLoad unit_force(const SurfaceMesh& surface, std::vector<int> triangles, const Eigen::Vector3d& force) {
    double area = 0.0;
    for (const int t : triangles) area += 0.5 * area_vector(triangle_points(surface, t)).norm();
    assert(area > 0.0);
    return unit_traction(std::move(triangles), force / area);
}

Resultant resultant(const SurfaceMesh& surface, const UnitLoad& load) {
    Resultant sum;
    for (std::size_t i = 0; i < load.triangles.size(); ++i) {
        const TrianglePoints p = triangle_points(surface, load.triangles[i]);
        const Eigen::Vector3d force = 0.5 * area_vector(p).norm() * load.tractions.col(static_cast<Eigen::Index>(i));
        sum.force += force;
        sum.moment += ((p.a + p.b + p.c) / 3.0).cross(force);
    }
    if (!load.is_body_force()) return sum;
    // Tetrahedra between a middle of the surface and its triangles: their volumes add up to that of the body.
    const Eigen::Vector3d middle = surface.vertices.rowwise().mean();
    double volume = 0.0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();  // moment of the volume about the middle
    for (int t = 0; t < surface.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(surface, t);
        const Eigen::Vector3d a = p.a - middle, b = p.b - middle, c = p.c - middle;
        const double part = a.dot(b.cross(c)) / 6.0;
        volume += part;
        first += part / 4.0 * (a + b + c);
    }
    sum.force = volume * load.body_force;
    sum.moment = (volume * middle + first).cross(load.body_force);
    return sum;
}

double gross_force(const SurfaceMesh& surface, const UnitLoad& load) {
    double sum = load.is_body_force() ? resultant(surface, load).force.norm() : 0.0;
    for (std::size_t k = 0; k < load.triangles.size(); ++k)
        sum += 0.5 * area_vector(triangle_points(surface, load.triangles[k])).norm() *
               load.tractions.col(static_cast<Eigen::Index>(k)).norm();
    return sum;
}

double gross_force(const SurfaceMesh& surface, std::span<const UnitLoad> loads, const Eigen::VectorXd& factors) {
    double sum = 0.0;
    for (std::size_t i = 0; i < loads.size(); ++i)
        if (const double factor = std::abs(factors[static_cast<Eigen::Index>(i)]); factor > 0.0)
            sum += factor * gross_force(surface, loads[i]);
    return sum;
}

Eigen::MatrixXd free_rigid_motions(const Positions& positions, std::span<const int> vertices,
                                   const Eigen::Vector3d& centre, double size) {
    Eigen::Matrix<double, 6, 6> squared = Eigen::Matrix<double, 6, 6>::Zero();
    for (const int v : vertices) {
        const Eigen::Vector3d r = (positions.col(v) - centre) / size;
        Eigen::Matrix<double, 3, 6> seen;
        seen << Eigen::Matrix3d::Identity(), Eigen::Vector3d::UnitX().cross(r), Eigen::Vector3d::UnitY().cross(r),
            Eigen::Vector3d::UnitZ().cross(r);
        squared += seen.transpose() * seen;
    }
    const SymmetricEigen motions = symmetric_eigen(squared);
    const auto n_free = (motions.values.array() <= kNoSpread * std::max(squared.trace(), 1e-300)).count();
    return motions.vectors.leftCols(n_free);
}

FreeWork::FreeWork(const SurfaceMesh& surface, std::span<const int> constrained, std::span<const UnitLoad> loads) {
    const Eigen::Vector3d centre = surface.vertices.rowwise().mean();
    const double size = (surface.vertices.colwise() - centre).colwise().norm().maxCoeff();
    const Eigen::MatrixXd motions = free_rigid_motions(surface.vertices, constrained, centre, size);
    Eigen::MatrixXd resultants(6, std::ssize(loads));
    size_.resize(std::ssize(loads));
    for (Eigen::Index i = 0; i < std::ssize(loads); ++i) {
        const UnitLoad& load = loads[static_cast<std::size_t>(i)];
        const Resultant sum = resultant(surface, load);
        resultants.col(i) << sum.force, (sum.moment - centre.cross(sum.force)) / size;
        size_[i] = gross_force(surface, load);
    }
    work_ = motions.transpose() * resultants;
}

bool FreeWork::balanced(const Eigen::VectorXd& factors) const {
    if (work_.rows() == 0 || factors.size() == 0) return true;
    const Eigen::VectorXd sizes = size_.transpose().cwiseProduct(factors.cwiseAbs());
    return !((work_ * factors).stableNorm() > kBalanced * sizes.maxCoeff());
}

}  // namespace elastolab
