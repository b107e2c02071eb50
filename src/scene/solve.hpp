#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "base/timer.hpp"
#include "deform/deformer.hpp"
#include "deform/finding.hpp"
#include "scene/constraints.hpp"
#include "scene/document.hpp"
#include "scene/field_export.hpp"
#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// What is to be solved.
struct SolveRequest {
    std::filesystem::path scene_file;
    Document document;
    Method method;  ///< with the kind that the command line or the scene asks for
    /// Solving once, on demand: take the direct update, which needs one factorisation and nothing else, or the reduced
    /// one if the body is not held.
    bool solve_once = false;
    /// Residual, and the estimates of the error: some times the solve, of small bodies some tenths of a second.
    bool with_checks = true;
};

/// Total force [force] and moment about the origin [force * L] that one group of constrained vertices exerts on the
/// body.
struct GroupReaction {
    std::string name;
    Eigen::Vector3d force, moment;
};

/// How far the reactions are from equilibrium: the resultant of all groups over the largest of one group, or over a
/// tenth of all forces where groups balance themselves; 0 where there is no force. Moments are about the mean of the
/// body's vertices; a force times the body's radius counts as one when the largest is sought.
struct Imbalance {
    double force = 0.0, moment = 0.0;
};
/// all_forces: their sizes, added up, whether they balance or not [force].
Imbalance imbalance_of(const std::vector<GroupReaction>& reactions, double all_forces, const SurfaceMesh& surface);

/// Everything that solve writes or prints.
struct Solution {
    std::shared_ptr<const SurfaceMesh> surface;  ///< that of the scene; results are at its vertices
    std::shared_ptr<const Proxy> proxy;          ///< what was simulated in its place; null: the surface itself
    std::shared_ptr<const Model> model;
    Cost predicted;
    std::string mesh_name;
    Eigen::Vector3d vertical = Eigen::Vector3d::UnitZ();  ///< the axis of the scene that points up
    int n_constrained = 0;
    Eigen::Matrix3Xd displacement;  ///< 3 x n_vertices [L]
    /// For fields: the deformer of the model's surface and what is prescribed there, displacements, constrained
    /// vertices and the reactions there.
    std::shared_ptr<const Deformer> deformer;
    Eigen::VectorXd values;
    std::vector<ConstraintGroup> groups;
    Eigen::VectorXd simulated_displacement;
    std::vector<int> constrained;
    Eigen::Matrix3Xd forces;
    std::vector<GroupReaction> reactions;
    /// What the loads exert: gravity first, then each load. With the reactions they sum to zero.
    std::vector<GroupReaction> loads;
    std::optional<double> compliance;  ///< work of the loads on the displacements [force * L]; none without loads
    /// Of each fixed set, without those whose vertices on a proxy all belong to others.
    std::vector<GroupReaction> fixed_reactions;
    Imbalance imbalance;
    std::optional<double> error_estimate;        ///< of the displacement of the worst vertex, over the largest
    std::optional<double> force_error_estimate;  ///< of the reactions of the worst patch, over the largest
    std::optional<double> residual;
    /// Of large deformations: iterations, energy, largest stretch; else none.
    std::optional<EquilibriumFacts> facts;
    /// Of linear methods: see scene/linear_theory.hpp.
    std::optional<double> linear_theory_error;
    double condition_estimate = 0.0;  ///< the larger of that of the factorised system and that of the update
    StageTimes stages;
    std::vector<Defect> defects;  ///< of the mesh, repaired or harmless for the method
    Findings findings;

    /// Everything that the user should know, in words.
    std::vector<std::string> warnings() const;
};

/// What its files of fields are written from.
SolvedBody solved_body(const Solution& solution);

/// Loads the mesh, precomputes, constrains and displaces. Throws Error or Cancelled.
Solution solve(const SolveRequest& request, Control& control);

}  // namespace elastolab
