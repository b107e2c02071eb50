#pragma once

#include <cstddef>
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "deform/element_degree.hpp"
#include "deform/grip_force.hpp"
#include "deform/method.hpp"
#include "elasticity/material.hpp"
#include "mesh/wrap/hole_caps.hpp"
#include "methods/registry.hpp"
#include "scene/shown.hpp"

namespace elastolab {

/// A mesh file; a relative name starts at the folder of the scene file.
struct MeshFile {
    std::string file;
    bool operator==(const MeshFile&) const = default;
};

/// A mesh made by mesh/primitives.hpp.
struct Primitive {
    std::string name;
    int resolution = 1;
    std::vector<double> size;  ///< [L]; empty for the default
    bool operator==(const Primitive&) const = default;
};

using MeshSource = std::variant<MeshFile, Primitive>;

/// The vertices of these numbers, in this order.
struct VertexSelector {
    std::vector<int> vertices;
    bool operator==(const VertexSelector&) const = default;
};

/// All vertices in an axis-parallel box, its faces included.
struct BoxSelector {
    Eigen::Vector3d min, max;
    bool operator==(const BoxSelector&) const = default;
};

/// All vertices in a ball, its surface included.
struct SphereSelector {
    Eigen::Vector3d center;
    double radius = 0.0;
    bool operator==(const SphereSelector&) const = default;
};

/// All vertices no further than `tolerance` from a plane; the normal may have any length but zero.
struct PlaneSelector {
    Eigen::Vector3d point, normal;
    double tolerance = 0.0;
    bool operator==(const PlaneSelector&) const = default;
};

/// Names vertices of the rest mesh; a list stands for the union of its members.
struct Selector {
    std::variant<VertexSelector, BoxSelector, SphereSelector, PlaneSelector, std::vector<Selector>> shape;
    bool operator==(const Selector&) const = default;
};

/// A hundred turns: what is not linear follows each.
inline constexpr double kMostDegrees = 36000.0;
/// A turn that remembers its angle: 720 degrees are two full turns.
struct Rotation {
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< of any length but zero
    double degrees = 0.0;  ///< counter-clockwise, seen against the axis; in files to +-kMostDegrees
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [L]
    bool operator==(const Rotation&) const = default;
};

/// A vertex at rest at x comes to center + R (x + matrix x - center) + translate, with R and center of `rotate`:
/// without a turn, to x + matrix x + translate. Where it ends is an affine map (scene/motion.hpp); the way there goes
/// through the whole turn.
struct AffineMotion {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d translate = Eigen::Vector3d::Zero();  ///< [L]
    Rotation rotate = {};
    bool operator==(const AffineMotion&) const = default;
};

/// One displacement for each selected vertex, in the order of selection.
struct VertexMotion {
    std::vector<Eigen::Vector3d> displacements;  ///< [L]
    bool operator==(const VertexMotion&) const = default;
};

/// Vertices that follow a prescribed motion, or that move as a rigid patch to where a force is in equilibrium.
struct Handle {
    std::string name;  ///< empty: called after its place in the list
    Selector select;
    std::variant<AffineMotion, VertexMotion> motion = {};  ///< where there is a force: at rest, or what it came to
    std::optional<GripForce> force = {};
    bool operator==(const Handle& other) const {
        return name == other.name && select == other.select && force == other.force &&
               (force.has_value() || motion == other.motion);
    }
};

/// A total force spread over the area of the loaded triangles [force].
struct ForceLoad {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    bool operator==(const ForceLoad&) const = default;
};
/// A force per area, the same everywhere [force / L^2].
struct TractionLoad {
    Eigen::Vector3d traction = Eigen::Vector3d::Zero();
    bool operator==(const TractionLoad&) const = default;
};
/// Presses into the body where it is positive [force / L^2].
struct PressureLoad {
    double pressure = 0.0;
    bool operator==(const PressureLoad&) const = default;
};

using LoadValue = std::variant<ForceLoad, TractionLoad, PressureLoad>;
/// A load on the triangles whose vertices are all selected.
struct Load {
    std::string name;  ///< empty: called after its place in the list
    Selector select;
    LoadValue value;
    bool operator==(const Load&) const = default;
};
/// What a load without a name of its own is called.
std::string default_load_name(std::size_t place);

/// When a closed surface around the scene's own is simulated in its place (scene/proxy).
enum class ProxyUse {
    never,      ///< a surface that a method cannot use is an error
    automatic,  ///< where the method cannot use the surface itself
    always,
    fill  ///< none around it; a surface that the method cannot use has its holes filled
};
struct ProxyChoice {
    ProxyUse use = ProxyUse::automatic;
    int n_vertices = 1500;  ///< wanted
    OpenSurface taken_for = OpenSurface::automatic;
    bool operator==(const ProxyChoice&) const = default;
};
inline constexpr int kFewestProxyVertices = 20, kMostProxyVertices = 100000;
/// The words that scene files and command lines use; nothing for any other.
std::string_view name(ProxyUse use);
std::optional<ProxyUse> parse_proxy_use(std::string_view text);
std::string_view name(OpenSurface taken_for);
std::optional<OpenSurface> parse_open_surface(std::string_view text);

/// Vertices that stay where they are at rest.
struct FixedSet {
    std::string name = {};  ///< empty: called after its place in the list
    Selector select;
    bool operator==(const FixedSet&) const = default;
};
/// What a fixed set without a name of its own is called.
std::string default_fixed_name(std::size_t place);
/// Whether scene files write them as one selector, without a list and names: a single set that has its default name.
bool is_plain(const std::vector<FixedSet>& sets);

/// Where a scene is looked at from.
struct ViewPoint {
    Eigen::Vector3d eye, target;                          ///< [L]; they differ
    Eigen::Vector3d up = Eigen::Vector3d::UnitZ();        ///< of the picture; not along the viewing direction
    Eigen::Vector3d vertical = Eigen::Vector3d::UnitZ();  ///< axis of the world that the view is turned about
    bool operator==(const ViewPoint&) const = default;
};

/// How the chosen method is carried out. Part of undo, not of scene files: what to compute ahead is a matter of the
/// machine.
struct MethodSettings {
    Mode mode = Mode::on_demand;
    Tractions tractions = Tractions::discontinuous;
    Update update = Update::reduced;
    ElementDegree elements = ElementDegree::quadratic;
    int rims = 0;
    bool operator==(const MethodSettings&) const = default;
};

/// A scene as plain values: what a scene file says, before any mesh is loaded.
struct Document {
    MeshSource mesh;
    Material material;
    MethodKind method = default_method();
    std::vector<FixedSet> fixed;  ///< together they are the fixed part
    std::vector<Handle> handles;
    std::optional<Eigen::Vector3d> gravity = {};  ///< acceleration [L / time^2]
    double density = 1.0;                         ///< [mass / L^3]
    std::vector<Load> loads = {};
    ProxyChoice proxy = {};
    MethodSettings settings = {};
    std::optional<ViewPoint> camera = {};  ///< none: the whole body is to be seen
    std::optional<Shown> shown = {};       ///< none: what the viewer shows already
};

/// Whether they state the same problem in the same way; how it is looked at makes no difference.
bool operator==(const Document& a, const Document& b);

}  // namespace elastolab
