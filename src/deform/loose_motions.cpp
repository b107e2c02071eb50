#include "deform/loose_motions.hpp"

#include <algorithm>
#include <Eigen/Geometry>
#include <iterator>
#include <numeric>
#include <set>

#include "base/lapack.hpp"
#include "deform/load_parts.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

namespace {

/// For each vertex the number of its solid.
std::vector<int> solids_of_vertices(const Model& model) {
    std::vector<int> solid_of(static_cast<std::size_t>(model.body().surface->n_vertices()));
    int n = 0;
    for (const Model::Part& part : model.parts()) {
        for (const int v : part.vertices) solid_of[static_cast<std::size_t>(v)] = n;
        ++n;
    }
    return solid_of;
}

/// Constrained vertices that are of no grip.
std::vector<int> held_by_others(const ConstrainedSet& set, const std::vector<Grip>& grips) {
    std::vector<int> held = set.fixed;
    for (int i = 0; i < std::ssize(set.handles); ++i)
        if (std::none_of(grips.begin(), grips.end(), [&](const Grip& g) { return g.begin <= i && i < g.end; }))
            held.push_back(set.handles[static_cast<std::size_t>(i)]);
    return held;
}

/// Rigid motions about the centre as those of the grips of one solid.
Eigen::MatrixXd of_grips(const Eigen::MatrixXd& rigid, const Eigen::Vector3d& centre, const GripArms& arms,
                         const std::vector<int>& solids, int solid) {
    Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(6 * std::ssize(solids), rigid.cols());
    for (std::size_t g = 0; g < solids.size(); ++g) {
        if (solids[g] != solid) continue;
        const Eigen::Vector3d arm = (arms.middles[g] - centre) / arms.length;
        for (Eigen::Index c = 0; c < rigid.cols(); ++c) {
            const Eigen::Vector3d shift = rigid.col(c).head<3>(), turn = rigid.col(c).tail<3>();
            motions.col(c).segment<6>(6 * static_cast<Eigen::Index>(g)) << shift + turn.cross(arm), turn;
        }
    }
    return motions;
}

/// Combinations of columns that are orthonormal, as many as there are independent ones: columns x n.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
    constexpr double kIndependent = 1e-6;  // columns are of a size of one
    if (columns.cols() == 0) return {};
    const SymmetricEigen products = symmetric_eigen(columns.transpose() * columns);
    const auto n = (products.values.array() > kIndependent * kIndependent).count();
    return products.vectors.rightCols(n) * products.values.tail(n).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Force over moment about the centre (over the length) of each load of size one on one solid: 6 x loads.
Eigen::MatrixXd resultants(const SurfaceMesh& surface, const std::vector<UnitLoad>& loads,
                           const std::vector<int>& solid_of, int solid, const Eigen::Vector3d& centre, double length) {
    std::vector<int> numbers(static_cast<std::size_t>(surface.n_triangles()), -1), own;
    for (int t = 0; t < surface.n_triangles(); ++t) {
        if (solid_of[static_cast<std::size_t>(surface.triangles(0, t))] != solid) continue;
        numbers[static_cast<std::size_t>(t)] = static_cast<int>(own.size());
        own.push_back(t);
    }
    const SurfaceMesh part{surface.vertices, surface.triangles(Eigen::all, own)};
    Eigen::MatrixXd sums(6, std::ssize(loads));
    for (Eigen::Index i = 0; i < sums.cols(); ++i) {
        const Resultant sum = resultant(part, on_triangles(loads[static_cast<std::size_t>(i)], numbers));
        sums.col(i) << sum.force, (sum.moment - centre.cross(sum.force)) / length;
    }
    return sums;
}

}  // namespace

std::vector<int> joined_by_grips(std::vector<int> solid_of, const std::vector<int>& handles,
                                 const std::vector<Grip>& grips) {
    const int n = solid_of.empty() ? 0 : 1 + *std::max_element(solid_of.begin(), solid_of.end());
    std::vector<int> number(static_cast<std::size_t>(n));
    std::iota(number.begin(), number.end(), 0);
    for (const Grip& grip : grips) {
        const auto number_at = [&](int i) {
            const int v = handles[static_cast<std::size_t>(i)];
            return number[static_cast<std::size_t>(solid_of[static_cast<std::size_t>(v)])];
        };
        for (int i = grip.begin; i < grip.end; ++i)
            std::replace(number.begin(), number.end(), number_at(i), number_at(grip.begin));
    }
    for (int& solid : solid_of) solid = number[static_cast<std::size_t>(solid)];
    return solid_of;
}

LooseMotions loose_motions(const Deformer& deformer, const std::vector<Grip>& grips, const GripArms& arms) {
    const SurfaceMesh& surface = *deformer.model().body().surface;
    const Eigen::Vector3d centre = surface.vertices.rowwise().mean();
    const ConstrainedSet& set = deformer.set();
    const std::vector<int> solid_of = joined_by_grips(solids_of_vertices(deformer.model()), set.handles, grips),
                           others = held_by_others(set, grips);
    std::vector<int> solids;  // of the grips
    for (const Grip& grip : grips) {
        const int v = set.handles[static_cast<std::size_t>(grip.begin)];
        solids.push_back(solid_of[static_cast<std::size_t>(v)]);
    }
    LooseMotions loose{Eigen::MatrixXd(6 * std::ssize(grips), 0), Eigen::MatrixXd(0, std::ssize(set.loads))};
    for (const int solid : std::set<int>(solids.begin(), solids.end())) {
        std::vector<int> held;
        std::copy_if(others.begin(), others.end(), std::back_inserter(held),
                     [&](int v) { return solid_of[static_cast<std::size_t>(v)] == solid; });
        const Eigen::MatrixXd rigid = free_rigid_motions(surface.vertices, held, centre, arms.length);
        if (rigid.cols() == 0) continue;
        loose.motions.conservativeResize(Eigen::NoChange, loose.motions.cols() + rigid.cols());
        loose.motions.rightCols(rigid.cols()) = of_grips(rigid, centre, arms, solids, solid);
        loose.work.conservativeResize(loose.motions.cols(), Eigen::NoChange);
        loose.work.bottomRows(rigid.cols()) =
            rigid.transpose() * resultants(surface, set.loads, solid_of, solid, centre, arms.length);
    }
    loose.motions -= arms.inert * (arms.inert.transpose() * loose.motions);
    const Eigen::MatrixXd combined = orthonormal(loose.motions);
    return {loose.motions * combined, combined.transpose() * loose.work};
}

}  // namespace elastolab
