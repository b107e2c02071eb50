#include "fem/nonlinear/halved_answer.hpp"

#include <functional>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "deform/node_rows.hpp"
#include "fem/error_estimate.hpp"
#include "fem/halved_mesh.hpp"
#include "fem/load_vectors.hpp"
#include "fem/stiffness_product.hpp"
#include "fem/two_levels.hpp"

namespace elastolab {

namespace {

/// For each node of the elements that are halved: of the new elements, their interpolation and vectors.
constexpr std::uint64_t kBytesOfTenNode = 20000;

/// Beyond kCompressible the step may lead nowhere, as pressures are noise on the halved elements: it must leave no more
/// than this part of the residual. Of small strains it leaves next to nothing.
constexpr double kLeftByStep = 0.1;

/// Elements with halved edges, and what acts on them.
struct Halved {
    QuadraticMesh mesh;
    std::shared_ptr<const FiniteElements> elements;
    NonlinearLoads loads;

    Halved(const NonlinearMesh& whole, std::span<const UnitLoad> given)
        : mesh(halved_mesh(whole.tets, whole.n_surface_nodes)),
          elements(std::make_shared<const FiniteElements>(mesh.positions, mesh.elements)) {
        const Triangles surface = quarters(whole.surface, whole.surface_midpoints);
        loads = {elements, surface, midpoints_of(surface, mesh), on_quarters(given)};
    }
};

/// Empty where the state is no longer near an equilibrium of the halved elements, or iterations find no answer: an
/// estimate that is not there takes nothing from the answer that it is of.
Eigen::VectorXd change_by(const TwoLevels& levels, const TwoLevels::Operators& apply, const Eigen::VectorXd& forces,
                          Control& control) {
    IterationReport report;
    try {
        const Eigen::VectorXd change = levels.solve(apply, forces, kEnoughOfHalved, control, &report);
        return report.indefinite ? Eigen::VectorXd() : change;
    } catch (const SolveError&) {
        return {};
    }
}

/// The same under loads that follow, where GMRES ends before it is there, as near nu = 1/2: conjugate gradients without
/// the change of the loads, which is put right after each. Where that is not small they do not get there either.
Eigen::VectorXd change_by_correction(const TwoLevels& levels, const TwoLevels::Operators& without,
                                     const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& change_of_loads,
                                     const Eigen::VectorXd& forces, Control& control) {
    constexpr int kMostCorrections = 4;
    constexpr double kEnough = 0.05;  // of an estimate
    Eigen::VectorXd change = change_by(levels, without, forces, control);
    for (int i = 0; i < kMostCorrections && change.size() > 0; ++i) {
        const Eigen::VectorXd before = change;
        change = change_by(levels, without, forces + change_of_loads(before), control);
        if (change.size() > 0 && (change - before).norm() <= kEnough * change.norm()) return change;
    }
    return {};
}

}  // namespace

std::optional<ReferenceAnswer> halved_answer(const NonlinearMesh& mesh, const Newton& newton,
                                             const std::vector<int>& vertices, std::span<const UnitLoad> loads,
                                             const Eigen::VectorXd& displacements, const Eigen::VectorXd& factors,
                                             Control& control) {
    const Halved fine(mesh, loads);
    const ConstrainedFemNodes nodes = constrain_nodes(mesh.tets.vertices, mesh.midpoints, {}, vertices);
    const ConstrainedFemNodes held =
        constrain_nodes(fine.mesh.positions, {fine.mesh.triangles, fine.mesh.midpoints}, {}, nodes.prescribed.nodes);
    const TwoLevels levels(fine.mesh, from_whole(fine.mesh, mesh.elements->elements()), held.prescribed.nodes);
    const Eigen::VectorXd u = levels.prolongation() * displacements;
    if (fine.loads.follow() &&
        2 * TwoLevels::kBasis * sizeof(double) * static_cast<std::size_t>(u.size()) > available_memory_bytes())
        return {};
    const Material& material = newton.material();
    ElementWork work = fine.elements->make_work(false);
    if (!(fine.elements->energy(u, material, work, control).least_J > 0.0)) return {};
    std::shared_ptr<const SparseCholesky> factor;
    {
        NewtonWork of_tangent = newton.make_work();
        bool stable = true;
        factor = newton.factor_at(displacements, factors, of_tangent, stable, control);
        // Under loads that follow, not positive definite is not yet unstable, and a factor need not be of the tangent.
        if (!factor || (!stable && !fine.loads.follow())) return {};
    }
    const Eigen::Matrix3Xd diagonal = StiffnessProduct(fine.mesh, material).diagonal();
    const auto change_of_loads = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
        return fine.loads.force_change(u, factors, v, Eigen::VectorXd::Zero(factors.size()));
    };
    const TwoLevels::Operators apply{
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
            return fine.elements->force_change(u, v, material, work, control) - change_of_loads(v);
        },
        [&](const Eigen::VectorXd& f) -> Eigen::VectorXd {
            return newton.tangent().all_rows(factor->solve(newton.tangent().free_rows(f)));
        },
        [&](int node) -> Eigen::Matrix3d { return diagonal.middleCols<3>(3 * node); }, !fine.loads.follow()};
    const Eigen::VectorXd forces = fine.elements->forces(u, material, work, control) - fine.loads.forces(u, factors);
    Eigen::VectorXd change = change_by(levels, apply, -forces, control);
    if (change.size() == 0 && fine.loads.follow()) {
        TwoLevels::Operators without = apply;
        without.symmetric = true;
        without.stiffness = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
            return fine.elements->force_change(u, v, material, work, control);
        };
        change = change_by_correction(levels, without, change_of_loads, -forces, control);
    }
    if (change.size() == 0) return {};
    if (material.poisson_ratio > kCompressible) {
        const Eigen::VectorXd better = u + change;
        ElementWork at_better = fine.elements->make_work(false);
        if (!(fine.elements->energy(better, material, at_better, control).least_J > 0.0)) return {};
        const Eigen::VectorXd left =
            fine.elements->forces(better, material, at_better, control) - fine.loads.forces(better, factors);
        if (levels.free_part(left).norm() > kLeftByStep * levels.free_part(forces).norm()) return {};
    }
    const Reactions at_nodes =
        gathered_reactions(held.shares, static_cast<int>(nodes.prescribed.nodes.size()),
                           rows_of(forces + apply.stiffness(change), held.prescribed.nodes).col(0));
    return ReferenceAnswer{
        (u + change).head(3 * mesh.n_vertices()),
        present_reactions(nodes.shares, rows_of(displacements, nodes.vertices).col(0), at_nodes.forces.reshaped()),
        1.0 + kLeftByHalving};
}

std::uint64_t halved_answer_memory(const NonlinearMesh& mesh) {
    return kBytesOfTenNode * static_cast<std::uint64_t>(mesh.elements->n_nodes());
}

}  // namespace elastolab
