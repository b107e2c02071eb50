#include "deform/patch_reactions.hpp"

#include <algorithm>
#include <cstddef>
#include <Eigen/Geometry>
#include <numbers>
#include <numeric>

#include "mesh/triangles_across.hpp"

namespace elastolab {

namespace {

int root_of(std::vector<int>& parent, int i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
        int& up = parent[static_cast<std::size_t>(i)];
        up = parent[static_cast<std::size_t>(up)];
        i = up;
    }
    return i;
}

/// Near nu = -1 a body resists shear 1 / (1 + nu) times more than stretch. Where a part of the displacement error is
/// spurious shear, forces are too large by that factor times that part, in the better answer too, so that the
/// difference of both does not show it. The smallest such part that was measured (Galerkin BEM, bending).
constexpr double kShearForces = 0.1;
/// By how much more than at nu = 0, from where on the better answer shows it.
double shear_over_stretch(const Body& body) { return std::max(0.0, 1.0 / (1.0 + body.material.poisson_ratio) - 1.0); }

/// Part of all forces, added up by their sizes, that is the least which errors are compared with: where patches bear
/// nothing in all, as under loads that balance each other, nothing else is there. Of a slender body it is less, as much
/// as it is more slender than a cube: a moment over its length is that much less than the forces that make it.
constexpr double kShareOfAll = 0.1;
/// Forces below this fraction of Young's modulus times displacement times thickness are rounding.
constexpr double kNoForce = 1e-9;
/// Thickness over size of a cube.
constexpr double kOfACube = 2.0 / (3.0 * std::numbers::sqrt3);

}  // namespace

ConstrainedPatches constrained_patches(const SurfaceMesh& surface, std::span<const int> fixed,
                                       std::span<const int> handles) {
    const int n_fixed = static_cast<int>(fixed.size()), n = n_fixed + static_cast<int>(handles.size());
    std::vector<int> place(static_cast<std::size_t>(surface.n_vertices()), -1), parent(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i)
        place[static_cast<std::size_t>(i < n_fixed ? fixed[static_cast<std::size_t>(i)]
                                                   : handles[static_cast<std::size_t>(i - n_fixed)])] = i;
    std::iota(parent.begin(), parent.end(), 0);
    for (const auto& triangle : surface.triangles.colwise())
        for (int corner = 0; corner < 3; ++corner) {
            const int a = place[static_cast<std::size_t>(triangle[corner])];
            const int b = place[static_cast<std::size_t>(triangle[(corner + 1) % 3])];
            if (a >= 0 && b >= 0 && (a < n_fixed) == (b < n_fixed))
                parent[static_cast<std::size_t>(root_of(parent, a))] = root_of(parent, b);
        }
    ConstrainedPatches patches;
    std::vector<int> patch_of(static_cast<std::size_t>(n), -1);
    for (int i = 0; i < n; ++i) {
        int& patch = patch_of[static_cast<std::size_t>(root_of(parent, i))];
        if (patch < 0) {
            patch = static_cast<int>(patches.size());
            patches.emplace_back();
        }
        patches[static_cast<std::size_t>(patch)].push_back(i);
    }
    return patches;
}

double largest_patch_reaction(const SurfaceMesh& surface, const ConstrainedPatches& patches,
                              const Reactions& reactions) {
    const Eigen::Vector3d centre = surface.vertices.rowwise().mean();
    const double radius = (surface.vertices.colwise() - centre).colwise().norm().maxCoeff();
    double largest = 0.0;
    for (const std::vector<int>& patch : patches) {
        const Eigen::Vector3d force = reactions.forces(Eigen::all, patch).rowwise().sum();
        const Eigen::Vector3d moment = reactions.moments(Eigen::all, patch).rowwise().sum();
        largest = std::max({largest, force.stableNorm(), (moment - centre.cross(force)).stableNorm() / radius});
    }
    return largest;
}

bool is_statically_determinate(const SurfaceMesh& surface, std::span<const int> fixed, std::span<const int> moved) {
    return constrained_patches(surface, fixed, moved).size() <= 1;
}

double size_of(const SurfaceMesh& surface) {
    return (surface.vertices.rowwise().maxCoeff() - surface.vertices.rowwise().minCoeff()).norm();
}

double relative_reaction_error(const Body& body, const ConstrainedSet& set, const Reactions& reactions,
                               const Reactions& error, double load_forces, double motion, double motion_error) {
    const SurfaceMesh& surface = *body.surface;
    const ConstrainedPatches patches = constrained_patches(surface, set.fixed, set.handles);
    const double all_forces = reactions.forces.colwise().stableNorm().sum() + load_forces;
    const double thick = thickness(surface), slenderness = thick / size_of(surface);
    const double force = std::max({largest_patch_reaction(surface, patches, reactions),
                                   kShareOfAll * std::min(1.0, slenderness / kOfACube) * all_forces,
                                   kNoForce * body.material.young_modulus * motion * thick});
    const double off = largest_patch_reaction(surface, patches, error);
    return std::max(force > 0.0 ? off / force : 0.0, kShearForces * motion_error * shear_over_stretch(body));
}

}  // namespace elastolab
