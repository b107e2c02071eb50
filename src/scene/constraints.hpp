#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deform/deformer.hpp"
#include "deform/grip.hpp"
#include "deform/grip_tangent.hpp"
#include "scene/document.hpp"
#include "scene/motion.hpp"

namespace elastolab {

/// Constrained vertices that belong together: columns [begin, end) of Deformer::reactions.
struct ConstraintGroup {
    std::string name;
    int begin = 0;
    int end = 0;
    bool operator==(const ConstraintGroup&) const = default;
};

/// A load of a scene as unit loads: rows [first, first + count) behind the handles' displacements in the values.
struct AppliedLoad {
    enum class Kind { gravity, force, traction, pressure };
    std::string name;
    Kind kind = Kind::gravity;
    std::vector<int> triangles = {};  ///< loaded ones of the surface; none: the whole body's weight
    int first = 0;
    int count = 0;    ///< 3 for a vector, one unit load for each axis; 1 for a pressure
    int number = -1;  ///< among the document's loads; -1: its gravity
    bool operator==(const AppliedLoad&) const = default;
};
/// Its unit loads on these triangles of a surface, which may be another than that of the scene.
std::vector<UnitLoad> unit_loads(AppliedLoad::Kind kind, const SurfaceMesh& surface, const std::vector<int>& triangles);
/// The factors of its unit loads: of a load of this size; of gravity, the density times the acceleration.
Eigen::VectorXd load_factors(const LoadValue& value);
/// Those of the document's gravity or load that was applied.
Eigen::VectorXd load_factors(const Document& document, const AppliedLoad& load);

/// What a scene prescribes, in the form that a Deformer takes.
struct Constraints {
    ConstrainedSet set;      ///< fixed: those of all fixed sets; handles: those of all handles, one after the other
    Eigen::VectorXd values;  ///< set.n_values(): handles, node-major [L], then the factors of set.loads
    std::vector<Motion> motions;          ///< of every handle; `values` are what they do to its vertices
    std::vector<ConstraintGroup> groups;  ///< "fixed", all of it, first when there is one, then every handle
    /// The parts of "fixed", as the document lists them. One that is carried to a proxy may be left without vertices,
    /// where others hold all of those near it.
    std::vector<ConstraintGroup> fixed_sets = {};
    std::vector<AppliedLoad> loads = {};                ///< gravity first, if there is one
    std::vector<std::optional<GripForce>> forces = {};  ///< of every handle that moves by a force

    bool has_fixed() const { return groups.size() > motions.size(); }
    bool has_forces() const;
    /// Handles that move by a force, those without vertices left out, and their patches as grips.
    std::vector<std::size_t> gripped() const;
    std::vector<Grip> grips() const;
    /// What is prescribed of them.
    std::vector<GripForce> grip_forces() const;
    /// Moves them to where their forces are in equilibrium; stiffness: of grips(), with everything else at these
    /// values. Returns their motions. Throws SolveError (GripStiffness::motions).
    std::vector<AffineMotion> move_grips(const GripStiffness& stiffness, const Positions& vertices);
    /// Moves them to these places. Returns their motions.
    std::vector<AffineMotion> move_grips(const std::vector<GripPlace>& places, const Positions& vertices);
    /// Places of a handle's vertices in set.handles: [begin, end).
    std::pair<int, int> range_of(std::size_t handle) const;
    /// Gives a handle another motion; vertices: of the surface that the set is on.
    void move(std::size_t handle, const AffineMotion& motion, const Positions& vertices);
};

/// What becomes of a load's triangles whose vertices are all constrained, where it has no effect: they are an error, or
/// left out, and with them a load that acts on no other. A total force is spread over those that are left.
enum class ConstrainedTriangles { error, left_out };

/// Throws SceneError naming the JSON path when a selector selects nothing or a vertex that is not there, when a vertex
/// is constrained twice, when a load acts on no triangle or on one whose vertices are all constrained, when a handle is
/// called "fixed" or a load "gravity", when two sets or handles have the same name, or when its displacements are not
/// one for each of its vertices or not finite. The constraints of a document on its mesh.
Constraints make_constraints(const Document& document, const SurfaceMesh& mesh, const std::filesystem::path& scene_file,
                             ConstrainedTriangles loaded = ConstrainedTriangles::error);

}  // namespace elastolab
