#include "scene/balance.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "base/lapack.hpp"
#include "base/text.hpp"
#include "deform/constraint_map.hpp"
#include "deform/load_parts.hpp"
#include "deform/loose_motions.hpp"
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

/// For each vertex the number of its solid.
std::vector<int> solids_of_vertices(const std::vector<Solid>& solids, int n_vertices) {
    std::vector<int> solid_of(static_cast<std::size_t>(n_vertices), 0);
    for (std::size_t s = 0; s < solids.size(); ++s)
        for (const int v : solids[s].vertices) solid_of[static_cast<std::size_t>(v)] = static_cast<int>(s);
    return solid_of;
}

/// Solids that a handle under a force holds together count as one.
std::vector<Solid> joined_solids(const Constraints& constraints, const SurfaceMesh& surface) {
    std::vector<Solid> solids = split_solids(surface);
    const std::vector<int> solid_of =
        joined_by_grips(solids_of_vertices(solids, surface.n_vertices()), constraints.set.handles, constraints.grips());
    std::map<int, std::vector<int>> triangles;
    for (int t = 0; t < surface.n_triangles(); ++t)
        triangles[solid_of[static_cast<std::size_t>(surface.triangles(0, t))]].push_back(t);
    if (triangles.size() == solids.size()) return solids;
    solids.clear();
    for (auto& [solid, own] : triangles) solids.push_back(with_triangles(surface, std::move(own)));
    return solids;
}

/// length: by which moments are compared with forces.
SumOfLoads loads_on(const Solid& solid, const Constraints& constraints, const SurfaceMesh& surface, double length) {
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
        sum.add({grip.force, grip.moment + middle.cross(grip.force)}, grip.force.norm() + grip.moment.norm() / length);
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

/// Of loads on a body that is held at one point, or along the line through it about which it can turn.
std::string unbalanced_about(const Resultant& sum, const Eigen::Vector3d& point, const Eigen::MatrixXd& motions,
                             double size, double length) {
    const Eigen::Vector3d moment = sum.moment - point.cross(sum.force);
    Eigen::Vector3d axis = motions.col(0).tail<3>().stableNormalized();
    Eigen::Index main = 0;
    axis.cwiseAbs().maxCoeff(&main);
    if (axis[main] < 0.0) axis = -axis;
    const bool turns_about_line = motions.cols() == 1;
    const std::string about = turns_about_line
                                  ? "the line through " + precise(point, length) + " along " + precise(axis, 1.0)
                                  : precise(point, length);
    return "do not balance: what is held lets the body turn about " + about +
           ", and about it they add up to the moment " +
           (turns_about_line ? readable_number(moment.dot(axis), 8) : precise(moment, size * length)) +
           ". Fix more, so that not all that is held lies on one line, or add loads until this moment is zero.";
}

std::string unbalanced(const Resultant& sum, const Eigen::Vector3d& centre, double size, double length) {
    return "do not balance, and nothing holds the body against them: they add up to the force " +
           precise(sum.force, size) + " and, about " + precise(centre, length) + ", the moment " +
           precise(sum.moment - centre.cross(sum.force), size * length) +
           ". Fix a part of the body, or add loads until forces and moments sum to zero.";
}

bool are_moved_rigidly(Positions places, const Positions& moves) {
    if (places.cols() == 0) return true;  // BLAS complains of matrices without rows
    places.colwise() -= places.rowwise().mean().eval();
    const double extent = places.cwiseAbs().maxCoeff(), length = extent > 0.0 ? extent : 1.0;
    Eigen::MatrixXd motions(places.size(), 6);
    for (Eigen::Index i = 0; i < places.cols(); ++i)
        motions.middleRows<3>(3 * i) << Eigen::Matrix3d::Identity(), cross_matrix(places.col(i) / length);
    const Eigen::VectorXd values = moves.reshaped();
    const Eigen::VectorXd fit = solve_minimum_norm(motions, values).X;
    return (motions * fit - values).stableNorm() <= kRoundedMotion * values.stableNorm();
}

}  // namespace

void require_balance(const Document& document, const Constraints& constraints, const SurfaceMesh& surface,
                     const fs::path& scene_file) {
    if (constraints.set.loads.empty() && !constraints.has_forces()) return;
    for (const Solid& solid : joined_solids(constraints, surface)) {
        const Positions& vertices = solid.surface.vertices;
        const Eigen::Vector3d centre = vertices.rowwise().mean();
        const double length = (vertices.colwise() - centre).colwise().norm().maxCoeff();
        const std::vector<int> held = holding(solid, constraints, surface);
        const Eigen::MatrixXd motions = free_rigid_motions(vertices, held, centre, length);
        if (motions.cols() == 0) continue;
        const SumOfLoads sum = loads_on(solid, constraints, surface, length);
        if (sum.balances(motions, centre, length)) continue;
        const char* loads = !document.loads.empty() ? "/loads" : document.gravity ? "/gravity" : "/handles";
        fail_at(scene_file, loads,
                held.empty() ? unbalanced(sum.resultant, centre, sum.size, length)
                             : unbalanced_about(sum.resultant, vertices.col(held.front()), motions, sum.size, length));
    }
}

bool moves_rigidly(const Constraints& constraints, const SurfaceMesh& surface) {
    const ConstrainedSet& set = constraints.set;
    if (constraints.has_forces() || !constraints.values.tail(std::ssize(set.loads)).isZero(0.0)) return false;
    const std::vector<Solid> solids = split_solids(surface);
    const std::vector<int> solid_of = solids_of_vertices(solids, surface.n_vertices());
    const std::vector<int> constrained = joined(set.fixed, set.handles);
    for (int s = 0; s < std::ssize(solids); ++s) {
        std::vector<int> own;  // among the constrained vertices
        for (int i = 0; i < std::ssize(constrained); ++i)
            if (solid_of[static_cast<std::size_t>(constrained[static_cast<std::size_t>(i)])] == s) own.push_back(i);
        Positions places(3, std::ssize(own)), moves(3, std::ssize(own));
        for (Eigen::Index k = 0; k < places.cols(); ++k) {
            const int i = own[static_cast<std::size_t>(k)], moved = i - static_cast<int>(set.fixed.size());
            places.col(k) = surface.vertices.col(constrained[static_cast<std::size_t>(i)]);
            moves.col(k) =
                moved < 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(constraints.values.segment<3>(3 * moved));
        }
        if (!are_moved_rigidly(places, moves)) return false;
    }
    return true;
}

}  // namespace elastolab
