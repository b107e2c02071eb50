#pragma once

#include <cstddef>
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "base/control.hpp"
#include "deform/deformer.hpp"
#include "deform/finding.hpp"
#include "deform/grip.hpp"
#include "deform/grip_force.hpp"

namespace elastolab {

/// Errors of linear theory below this are not worth a word.
inline constexpr double kSilentLinearTheory = 0.02;

/// Handles of a set that move by forces, and these; none: all are moved.
struct HandleForces {
    std::vector<Grip> grips = {};
    std::vector<GripForce> forces = {};
};

/// The same where linear theory moves a body by less than its size, `moved` [L] at most; else none: an equilibrium of
/// the handles would be sought for a minute, and linear theory's motion says enough.
HandleForces in_proportion(HandleForces by_force, double moved, const SurfaceMesh& surface);

/// How far linear theory is off for a motion: the linear and the finite answer of the same elements, on a coarse
/// surface that stands for the body (that of the preview). It tells the error of the model apart from that of the mesh.
/// Immutable; any thread may use it, best a worker: making one takes about a second, an error some iterations.
class LinearTheoryGauge {
public:
    /// body  with a closed surface of few vertices (kGaugeVertices), which tetrahedra can fill
    /// set   constrained vertices of that surface
    /// Throws MeshError, SolveError, Cancelled.
    LinearTheoryGauge(Body body, ConstrainedSet set, Control& control);

    /// Largest difference of both answers at a vertex, over the largest displacement of the finite one. values: as
    /// Deformer::displace takes them; approach: for turns of more than half a circle. Nothing where nothing moves,
    /// infinite where no stable equilibrium is found: a real body would be crushed, or buckle. by_force: handles whose
    /// values are left out, as each theory has them elsewhere. Throws SolveError, Cancelled.
    std::optional<double> error(const Eigen::VectorXd& values, Control& control, const Approach& approach = {},
                                const HandleForces& by_force = {}) const;

private:
    struct Finite {
        Eigen::VectorXd u;
        bool stable = true;
    };
    Finite finite(double part, const Eigen::VectorXd& values, Control& control, const Approach& approach,
                  const HandleForces& by_force) const;

    std::unique_ptr<const Deformer> deformer_;
};

/// Vertices that are enough to tell.
inline constexpr int kGaugeVertices = 500;
/// A surface of more vertices is gauged on a proxy.
inline constexpr int kMostGaugedThemselves = 1200;
/// Solids of more are not gauged.
inline constexpr std::size_t kMostGaugedSolids = 64;

/// Whether the method that is right beyond linear theory takes no Poisson's ratio as large as this.
bool is_too_incompressible_for_turns(double poisson_ratio);

/// The finding, for a method whose answer it is said of; nothing below kSilentLinearTheory.
Findings findings_of_linear_theory(MethodKind method, double error, double poisson_ratio);

}  // namespace elastolab
