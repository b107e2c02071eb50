#include "deform/loose_motions.hpp"

#include <algorithm>
#include <Eigen/Geometry>
#include <iterator>
#include <numeric>
#include <set>

#include "base/lapack.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

namespace {

/// For each vertex the number of its solid; solids that a grip joins have one number.
std::vector<int> joined_solids(const Deformer& deformer, const std::vector<Grip>& grips) {
    const std::vector<int>& handles = deformer.set().handles;
    std::vector<int> solid_of(static_cast<std::size_t>(deformer.model().body().surface->n_vertices()));
    int n = 0;
    for (const Model::Part& part : deformer.model().parts()) {
        for (const int v : part.vertices) solid_of[static_cast<std::size_t>(v)] = n;
        ++n;
    }
    std::vector<int> number(static_cast<std::size_t>(n));
    std::iota(number.begin(), number.end(), 0);
    for (const Grip& grip : grips) {
        const auto solid = [&](int i) {
            const int v = handles[static_cast<std::size_t>(i)];
            return number[static_cast<std::size_t>(solid_of[static_cast<std::size_t>(v)])];
        };
        for (int i = grip.begin; i < grip.end; ++i)
            if (const int own = solid(i), first = solid(grip.begin); own != first)
                std::replace(number.begin(), number.end(), own, first);
    }
    for (int& solid : solid_of) solid = number[static_cast<std::size_t>(solid)];
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

/// Orthonormal columns, as many as there are independent ones.
Eigen::MatrixXd span_of(const Eigen::MatrixXd& columns) {
    constexpr double kIndependent = 1e-6;  // columns are of a size of one
    if (columns.cols() == 0) return columns;
    const SymmetricEigen products = symmetric_eigen(columns.transpose() * columns);
    const auto n = (products.values.array() > kIndependent * kIndependent).count();
    return columns * products.vectors.rightCols(n) * products.values.tail(n).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace

Eigen::MatrixXd loose_motions(const Deformer& deformer, const std::vector<Grip>& grips, const GripArms& arms) {
    const Positions& all = deformer.model().body().surface->vertices;
    const Eigen::Vector3d centre = all.rowwise().mean();
    const std::vector<int> solid_of = joined_solids(deformer, grips), others = held_by_others(deformer.set(), grips);
    std::vector<int> solids;  // of the grips
    for (const Grip& grip : grips) {
        const int v = deformer.set().handles[static_cast<std::size_t>(grip.begin)];
        solids.push_back(solid_of[static_cast<std::size_t>(v)]);
    }
    Eigen::MatrixXd loose(6 * std::ssize(grips), 0);
    for (const int solid : std::set<int>(solids.begin(), solids.end())) {
        std::vector<int> held;
        std::copy_if(others.begin(), others.end(), std::back_inserter(held),
                     [&](int v) { return solid_of[static_cast<std::size_t>(v)] == solid; });
        const Eigen::MatrixXd rigid = free_rigid_motions(all, held, centre, arms.length);
        if (rigid.cols() == 0) continue;
        loose.conservativeResize(Eigen::NoChange, loose.cols() + rigid.cols());
        loose.rightCols(rigid.cols()) = of_grips(rigid, centre, arms, solids, solid);
    }
    return span_of(loose - arms.inert * (arms.inert.transpose() * loose));
}

}  // namespace elastolab
