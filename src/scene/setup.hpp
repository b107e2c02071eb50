#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "deform/deformer.hpp"
#include "deform/model.hpp"
#include "mesh/checks/check.hpp"
#include "scene/document.hpp"
#include "scene/motion.hpp"

namespace elastolab {

/// The mesh of a scene, checked and repaired but not judged, and what to call it in messages.
struct SceneMesh {
    std::string name;
    CheckedMesh checked;
};

/// Loads a mesh file, relative names starting at the folder of `scene_file`, or makes a primitive.
/// Throws MeshError (a file that cannot be read), SceneError (a primitive that cannot be made), Cancelled.
SceneMesh load_scene_mesh(const MeshSource& source, const std::filesystem::path& scene_file, Control& control);

/// Whether a method of `kind` simulates a closed surface around this mesh (scene/proxy/proxy.hpp), not the mesh itself.
bool needs_proxy(const ProxyChoice& choice, const MeshReport& mesh, MethodKind kind);

/// Throws MeshError when a mesh is not usable for a method of `kind`.
void require_usable(const SceneMesh& mesh, MethodKind kind);
/// Throws SceneError when the material is not.
void require_material(const Material& material, MethodKind kind, const std::filesystem::path& scene_file);

/// Constrained vertices that belong together: columns [begin, end) of Deformer::reactions.
struct ConstraintGroup {
    std::string name;
    int begin = 0;
    int end = 0;
    bool operator==(const ConstraintGroup&) const = default;
};

/// What a scene prescribes, in the form that a Deformer takes.
struct Constraints {
    ConstrainedSet set;                   ///< base: the fixed part; handles: those of all handles, one after the other
    Eigen::VectorXd values;               ///< 3 * set.handles.size(), node-major [L]
    std::vector<Motion> motions;          ///< of every handle; `values` are what they do to its vertices
    std::vector<ConstraintGroup> groups;  ///< "fixed", all of it, first when there is one, then every handle
    /// The parts of "fixed", as the document lists them. One that is carried to a proxy may be left without vertices,
    /// where others hold all of those near it.
    std::vector<ConstraintGroup> fixed_sets = {};

    bool has_fixed() const { return groups.size() > motions.size(); }
};

/// Throws SceneError naming the JSON path when a selector selects nothing or a vertex that is not there, when a vertex
/// is constrained twice, when a handle is called "fixed", when two sets or handles have the same name, or when its
/// displacements are not one for each of its vertices or not finite.
Constraints make_constraints(const Document& document, const SurfaceMesh& mesh,
                             const std::filesystem::path& scene_file);

}  // namespace elastolab
