#include "bem/galerkin/hierarchical_system.hpp"

#include <algorithm>

#include "bem/galerkin/given_loads.hpp"
#include "deform/load_columns.hpp"
#include "elasticity/rigid_motion.hpp"

namespace elastolab {

namespace {

/// Tolerance of a far block over that of an integral, and its upper bound: the far field is a small part of D, whose
/// entries fall with the cube of the distance. Displacements then differ by 3e-8 from those of the dense matrix (rabbit
/// of 2500 vertices, integrals to 1e-8), by 2e-7 at ten times as much and 1e-8 at a tenth.
constexpr double kFarTolerance = 1000.0, kMostFarTolerance = 1e-4;

}  // namespace

HierarchicalSystem::HierarchicalSystem(const SurfaceMesh& surface, double poisson_ratio, const Method& method,
                                       StageTimes& stages, Control& control)
    : pairs_(
          std::make_shared<const BoundaryPairs>(std::make_shared<const Boundary>(surface), integral_tolerance(method))),
      tree_(pairs_->cluster_vertices(kVerticesOfALeaf)),
      surfaces_(surface),
      material_{1.0, poisson_ratio},
      options_{.tolerance = std::min(kFarTolerance * integral_tolerance(method), kMostFarTolerance)},
      surface_modes_(to_tree_order(*tree_, surfaces_.rigid)),
      body_modes_(to_tree_order(*tree_, rigid_modes(surface.vertices))) {
    const Stage stage("integrate", control, stages);
    control.begin_stage("integrate close pairs");  // of which the progress is another one
    const HypersingularEntries entries(pairs_, tree_, material_, pairs_->keep_close_pairs(control));
    control.begin_stage("integrate");
    D_ = std::make_unique<const HierarchicalMatrix>(tree_, tree_, true, entries, options_, control);
}

Eigen::MatrixXd HierarchicalSystem::hypersingular(const Eigen::MatrixXd& X) const {
    const Eigen::MatrixXd& C = surface_modes_;
    Eigen::MatrixXd Y = X;
    Y.noalias() -= C * (C.transpose() * X).eval();
    Y = D_->product(Y);
    Y.noalias() -= C * (C.transpose() * Y).eval();
    return Y;
}

Eigen::MatrixXd HierarchicalSystem::given_layers(std::span<const UnitLoad> loads, Control& control) const {
    const auto compute = [&](std::span<const UnitLoad> missing) {
        const LayerOptions as_far_blocks{pairs_->far_integrals(), options_.tolerance};
        return elastolab::given_layers(*pairs_, material_, missing, as_far_blocks, control);
    };
    return load_columns(given_, loads, size() + 3 * boundary().n_triangles(), compute, control)
        .middle(0, std::ssize(loads));
}

Eigen::MatrixXd HierarchicalSystem::given_nodal_forces(std::span<const UnitLoad> loads, Control& control) const {
    return given_layers(loads, control).topRows(size());
}

Eigen::MatrixXd HierarchicalSystem::given_single_layer(const GalerkinTractions& tractions,
                                                       std::span<const UnitLoad> loads, Control& control) const {
    return elastolab::given_single_layer(given_layers(loads, control), boundary(), surfaces_, tractions);
}

std::shared_ptr<const TriangleLayers> HierarchicalSystem::layers_of(const std::vector<int>& triangles,
                                                                    Control& control) const {
    return living_.add([&](const auto& known) {
        return std::make_shared<const TriangleLayers>(LayerSource{pairs_, tree_, material_, options_}, triangles, known,
                                                      control);
    });
}

}  // namespace elastolab
