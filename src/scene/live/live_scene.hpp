#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/constraints.hpp"
#include "scene/live/history.hpp"
#include "scene/motion.hpp"
#include "scene/proxy/proxy.hpp"
#include "scene/scene_mesh.hpp"

namespace elastolab {

/// A scene while a person edits it: the document, its mesh, the constraints that follow from it, and undo. Every edit
/// takes effect at once; commit() ends a step that undo takes back as a whole (a stroke, a drag). Owned by one thread.
class LiveScene {
public:
    static constexpr int kNobody = -1;  ///< owner of a free vertex
    static constexpr int kFixed = -2;   ///< owner of a vertex of the fixed part

    /// Loads the mesh. Throws MeshError or SceneError as the functions of scene_mesh.hpp and constraints.hpp do;
    /// MeshError too when no method can simulate the mesh or a proxy of it.
    LiveScene(Document document, std::filesystem::path scene_file);
    /// The same; throws Cancelled too.
    LiveScene(Document document, std::filesystem::path scene_file, Control& control);

    const Document& document() const { return document_; }
    const std::filesystem::path& file() const { return file_; }  ///< where relative names of the document start
    const std::string& name() const { return mesh_.name; }       ///< of the mesh
    const SurfaceMesh& mesh() const { return *surface_; }
    const std::shared_ptr<const SurfaceMesh>& shared_mesh() const { return surface_; }
    const std::shared_ptr<const SurfaceMesh>& surface() const { return surface_; }
    const MeshReport& report() const { return mesh_.checked.report; }
    /// Whether a method of this kind simulates a proxy of the surface.
    bool needs_proxy(MethodKind kind) const { return elastolab::needs_proxy(document_.proxy, report(), kind); }
    /// The body that a method of this kind simulates: this surface, or that of `proxy` when there is one. Throws
    /// MeshError or SceneError when surface or material are not fit for it.
    Body body(MethodKind kind, const Proxy* proxy = nullptr) const;

    const Constraints& constraints() const { return constraints_; }
    int n_handles() const { return static_cast<int>(document_.handles.size()); }
    int n_fixed_sets() const { return static_cast<int>(document_.fixed.size()); }
    /// The vertices of a handle, or of all fixed sets together (kFixed).
    std::span<const int> vertices(int owner) const;
    Positions rest_positions(int handle) const;  ///< of its vertices, in their order
    std::span<const int> fixed_vertices(int set) const;
    std::vector<int> loaded_vertices(int load) const;  ///< that its selector names
    int owner(int vertex) const { return owners_[static_cast<std::size_t>(vertex)]; }
    /// The fixed set of a vertex that kFixed owns; kNobody for others.
    int fixed_set_of(int vertex) const;
    /// Name of a handle as constraints().groups has it.
    const std::string& handle_name(int handle) const;
    int n_loads() const { return static_cast<int>(document_.loads.size()); }
    const std::string& load_name(int load) const { return document_.loads[static_cast<std::size_t>(load)].name; }
    /// A load, or with kGravity the gravity, as it acts here; null where all its triangles are constrained, which may
    /// be while a patch of it is pulled: then it has no effect.
    static constexpr int kGravity = -1;
    const AppliedLoad* applied_load(int load) const;
    const std::string& fixed_name(int set) const { return document_.fixed[static_cast<std::size_t>(set)].name; }

    /// Grows with every edit.
    std::uint64_t revision() const { return revision_; }
    /// Whether something but the method and its settings changed since the document was loaded or marked as saved.
    bool modified() const;
    void mark_saved() { saved_ = document_; }
    /// Nothing of it was ever saved by the person: it comes from a session that was cut short.
    void mark_unsaved() { saved_.reset(); }

    // Edits of the constrained set. Vertices that belong to others are left to them.
    /// Returns the new handle's number, or kNobody when no vertex of the list is free.
    int add_handle(std::span<const int> vertices);
    void remove_handle(int handle);
    void clear_handles();
    /// False when the name is empty, "fixed", or that of a handle or fixed set: then nothing changes.
    bool rename_handle(int handle, const std::string& name);
    /// Adds vertices to a fixed set, or, with n_fixed_sets(), makes a new one of them.
    void fix(std::span<const int> vertices, int set);
    /// Adds them to the last set, or to a new one where there is none.
    void fix(std::span<const int> vertices) { fix(vertices, std::max(0, n_fixed_sets() - 1)); }
    /// Takes vertices out of a fixed set, or out of all sets (kFixed). A set left without any is removed.
    void unfix(std::span<const int> vertices, int set = kFixed);
    void remove_fixed_set(int set);
    /// False when the name is empty, or that of a handle or fixed set: then nothing changes.
    bool rename_fixed_set(int set, const std::string& name);

    // Edits of loads.
    /// On the triangles whose vertices are all in this list. Returns the new load's number, or kNobody when there is
    /// none that is free to move.
    int add_load(std::span<const int> vertices, const LoadValue& value);
    /// Other vertices for a load; false when they have no triangle that is free to move: then nothing changes.
    bool set_loaded_vertices(int load, std::span<const int> vertices);
    void remove_load(int load);
    void clear_loads();
    /// False when the name is empty, "gravity", or that of another load: then nothing changes.
    bool rename_load(int load, const std::string& name);
    /// Another kind of load makes another constrained set; another size of the same kind only other values. A size
    /// that is not finite is ignored.
    void set_load(int load, const LoadValue& value);
    /// Nothing: there is none. density: > 0; finite.
    void set_gravity(const std::optional<Eigen::Vector3d>& gravity, double density);

    // Edits of values.
    /// A motion that is not finite at every vertex of the handle is ignored.
    void set_motion(int handle, const Motion& motion);
    /// The handle moves as a rigid patch, by this force; with nothing, it stays where it is. A force that is not finite
    /// is ignored.
    void set_force(int handle, const std::optional<GripForce>& force);
    /// Where a handle under a force has come to: what is shown of it, and where it stays if its force is taken away.
    /// Not an edit.
    void set_equilibrium(int handle, const AffineMotion& motion);
    void set_material(const Material& material);
    void set_proxy(const ProxyChoice& choice);
    void set_method(MethodKind kind, const MethodSettings& settings);
    /// The scene begins with this method: not an undo step, and nothing that has to be saved.
    void start_with(MethodKind kind, const MethodSettings& settings);

    /// Ends a step; does nothing when it changed nothing.
    void commit() { history_.commit(document_); }
    /// Ends the step of a choice of the method. After an undo it is none, so that what was undone can be done again.
    void commit_method() {
        if (can_redo())
            history_.set_method(document_.method, document_.settings);
        else
            commit();
    }
    /// Takes back what was done since the last step ended.
    void take_back() { become(Document(history_.present())); }
    bool can_undo() const { return history_.can_undo(); }
    bool can_redo() const { return history_.can_redo(); }
    void undo();
    void redo();

    /// The constraints as they would be with these vertices (those that are free) as one more handle, at rest.
    Constraints constraints_with_handle(std::span<const int> vertices) const;

private:
    std::vector<int> only_free(std::span<const int> vertices) const;
    bool is_taken(const std::string& name) const;
    std::string unused_handle_name() const, unused_fixed_name() const, unused_load_name() const;
    bool load_is_named(const std::string& name) const;
    bool try_loads(Document document, int load);
    void take_factors(int load, const Eigen::VectorXd& factors);
    void become(Document document);

    Document document_;
    std::optional<Document> saved_;  ///< as it was loaded or saved
    std::filesystem::path file_;
    SceneMesh mesh_;  ///< its surface has moved to surface_
    std::shared_ptr<const SurfaceMesh> surface_;
    History history_;
    Constraints constraints_;
    std::vector<int> owners_;  ///< for every vertex
    std::uint64_t revision_ = 0;
};

}  // namespace elastolab
