#include "scene/balance.hpp"

#include <cmath>

#include "base/lapack.hpp"
#include "base/text.hpp"
#include "deform/constraint_map.hpp"
#include "deform/load_parts.hpp"
#include "elasticity/rotation.hpp"
#include "mesh/measures.hpp"
#include "mesh/solids.hpp"
#include "scene/scene_failure.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

/// What rounding leaves of a rigid motion.
constexpr double kRoundedMotion = 1e-12;

/// The loads of one solid: their resultant, and the sum of their sizes.
struct SumOfLoads {
    Resultant resultant;
    double size = 0.0;

    void add(const Resultant& load, double load_size) {
        resultant.force += load.force;
        resultant.moment += load.moment;
        size += load_size;
    }
    /// Whether it does no work in these rigid motions (free_rigid_motions), but for a millionth.
    bool balances(const Eigen::MatrixXd& motions, const Eigen::Vector3d& centre, double length) const {
        Eigen::Matrix<double, 6, 1> about_centre;
        about_centre << resultant.force, (resultant.moment - centre.cross(resultant.force)) / length;
        return !((motions.transpose() * about_centre).stableNorm() > 1e-6 * size);
    }
};

std::vector<int> numbers_among(const std::vector<int>& chosen, int n) {
    std::vector<int> numbers(static_cast<std::size_t>(n), -1);
    for (std::size_t i = 0; i < chosen.size(); ++i) numbers[static_cast<std::size_t>(chosen[i])] = static_cast<int>(i);
    return numbers;
}

SumOfLoads loads_on(const Solid& solid, const Constraints& constraints, const SurfaceMesh& surface) {
    SumOfLoads sum;
    const std::vector<int> own = numbers_among(solid.triangles, surface.n_triangles());
    const Eigen::VectorXd factors = constraints.values.tail(std::ssize(constraints.set.loads));
    for (std::size_t k = 0; k < constraints.set.loads.size(); ++k) {
        const UnitLoad part = on_triangles(constraints.set.loads[k], own);
        if (part.triangles.empty() && !constraints.set.loads[k].is_body_force()) continue;
        const double factor = factors[static_cast<Eigen::Index>(k)];
        const Resultant unit = resultant(solid.surface, part);
        sum.add({factor * unit.force, factor * unit.moment}, std::abs(factor) * gross_force(solid.surface, part));
    }
    const std::vector<int> local = numbers_among(solid.vertices, surface.n_vertices());
    for (std::size_t h = 0; h < constraints.forces.size(); ++h) {
        const auto [begin, end] = constraints.range_of(h);
        if (!constraints.forces[h] || begin == end) continue;
        const std::vector<int> patch(constraints.set.handles.begin() + begin, constraints.set.handles.begin() + end);
        if (local[static_cast<std::size_t>(patch.front())] < 0) continue;
        const Eigen::Vector3d middle = surface.vertices(Eigen::all, patch).rowwise().mean();
        const GripForce& grip = *constraints.forces[h];
        sum.add({grip.force, grip.moment + middle.cross(grip.force)}, grip.force.norm());
    }
    return sum;
}

/// Vertices of a solid, by its own numbers, that hold it: all constrained ones but those that move by a force.
std::vector<int> holding(const Solid& solid, const Constraints& constraints, const SurfaceMesh& surface) {
    const std::vector<int> local = numbers_among(solid.vertices, surface.n_vertices());
    std::vector<int> held;
    const auto add = [&](int v) {
        if (const int own = local[static_cast<std::size_t>(v)]; own >= 0) held.push_back(own);
    };
    for (const int v : constraints.set.fixed) add(v);
    for (std::size_t h = 0; h < constraints.forces.size(); ++h) {
        const auto [begin, end] = constraints.range_of(h);
        for (int i = begin; i < end && !constraints.forces[h]; ++i)
            add(constraints.set.handles[static_cast<std::size_t>(i)]);
    }
    return held;
}

/// A vector with the digits that are needed to balance it; parts that are rounding of numbers of this size are zero.
std::string precise(const Eigen::Vector3d& x, double size) {
    std::string text;
    for (const double part : x)
        text += (text.empty() ? "(" : ", ") + readable_number(std::abs(part) > 1e-9 * size ? part : 0.0, 8);
    return text + ")";
}

std::string unbalanced(const Resultant& sum, const Eigen::Vector3d& centre, double size, double length) {
    return "do not balance, and nothing holds the body against them: they add up to the force " +
           precise(sum.force, size) + " and, about " + precise(centre, length) + ", the moment " +
           precise(sum.moment - centre.cross(sum.force), size * length) +
           ". Fix a part of the body, or add loads until forces and moments sum to zero.";
}

}  // namespace

void require_balance(const Document& document, const Constraints& constraints, const SurfaceMesh& surface,
                     const fs::path& scene_file) {
    if (constraints.set.loads.empty() && !constraints.has_forces()) return;
    for (const Solid& solid : split_solids(surface)) {
        const Positions& vertices = solid.surface.vertices;
        const Eigen::Vector3d centre = vertices.rowwise().mean();
        const double length = (vertices.colwise() - centre).colwise().norm().maxCoeff();
        const Eigen::MatrixXd motions =
            free_rigid_motions(vertices, holding(solid, constraints, surface), centre, length);
        if (motions.cols() == 0) continue;
        const SumOfLoads sum = loads_on(solid, constraints, surface);
        if (sum.balances(motions, centre, length)) continue;
        const char* loads = !document.loads.empty() ? "/loads" : document.gravity ? "/gravity" : "/handles";
        fail_at(scene_file, loads, unbalanced(sum.resultant, centre, sum.size, length));
    }
}

bool moves_rigidly(const Constraints& constraints, const SurfaceMesh& surface) {
    const ConstrainedSet& set = constraints.set;
    if (constraints.has_forces() || !constraints.values.tail(std::ssize(set.loads)).isZero(0.0)) return false;
    Positions places = surface.vertices(Eigen::all, joined(set.fixed, set.handles));
    if (places.cols() == 0) return true;  // BLAS complains of matrices without rows
    places.colwise() -= surface.vertices.rowwise().mean().eval();
    const double length = places.cwiseAbs().maxCoeff();
    Eigen::VectorXd values = Eigen::VectorXd::Zero(places.size());
    values.tail(3 * std::ssize(set.handles)) = constraints.values.head(3 * std::ssize(set.handles));
    Eigen::MatrixXd motions(values.size(), 6);
    for (Eigen::Index i = 0; i < places.cols(); ++i)
        motions.middleRows<3>(3 * i) << Eigen::Matrix3d::Identity(), cross_matrix(places.col(i) / length);
    const Eigen::VectorXd fit = solve_minimum_norm(motions, values).X;
    return (motions * fit - values).stableNorm() <= kRoundedMotion * values.stableNorm();
}

}  // namespace elastolab
