#pragma once

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "bem/galerkin/method.hpp"
#include "deform/patch_reactions.hpp"
#include "mesh/primitives.hpp"
#include "mesh/rims.hpp"
#include "methods/problem.hpp"
#include "methods/stored_rows.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {

/// A body with a patch that holds it and one that moves it, and two motions of the latter.
struct OrganicCase {
    std::string name;
    SurfaceMesh surface;
    ConstrainedSet set;
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();

    /// Displacements of all vertices, zero but at the handle's: moved along the direction, or turned by a fifth of a
    /// right angle about an axis across it through the middle of the patch.
    Eigen::Matrix3Xd pulled() const {
        return field([&](const Eigen::Vector3d&) { return Eigen::Vector3d(0.2 * direction); });
    }
    Eigen::Matrix3Xd turned() const {
        const Eigen::Vector3d middle = surface.vertices(Eigen::all, set.handles).rowwise().mean();
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.314, direction.unitOrthogonal()).toRotationMatrix();
        return field([&](const Eigen::Vector3d& x) { return Eigen::Vector3d(turn * (x - middle) - (x - middle)); });
    }
    Eigen::VectorXd values(const Eigen::Matrix3Xd& motion) const { return motion(Eigen::all, set.handles).reshaped(); }

private:
    template <class Motion>
    Eigen::Matrix3Xd field(Motion&& motion) const {
        Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, surface.n_vertices());
        for (const int v : set.handles) u.col(v) = motion(surface.vertices.col(v));
        return u;
    }
};

/// Vertices of the triangles that lie wholly where a predicate selects.
template <class Predicate>
std::vector<int> patch_where(const SurfaceMesh& mesh, Predicate&& selects) {
    std::vector<char> kept(static_cast<std::size_t>(mesh.n_vertices()), 0);
    for (const auto& t : mesh.triangles.colwise())
        if (std::all_of(t.begin(), t.end(), [&](int v) { return selects(Eigen::Vector3d(mesh.vertices.col(v))); }))
            for (const int v : t) kept[static_cast<std::size_t>(v)] = 1;
    std::vector<int> vertices;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (kept[static_cast<std::size_t>(v)]) vertices.push_back(v);
    return vertices;
}

/// Held over the lowest part along an axis, `foot` of the extent; moved within `cap` of the highest vertex.
inline OrganicCase held_below(std::string name, SurfaceMesh mesh, Eigen::Vector3d axis, double foot, double cap) {
    axis.normalize();
    const Eigen::VectorXd height = mesh.vertices.transpose() * axis;
    Eigen::Index top = 0;
    const double highest = height.maxCoeff(&top), lowest = height.minCoeff();
    const Eigen::Vector3d summit = mesh.vertices.col(top);
    ConstrainedSet set;
    set.fixed = patch_where(mesh, [&](const auto& x) { return x.dot(axis) < lowest + foot * (highest - lowest); });
    set.handles = patch_where(mesh, [&](const auto& x) { return (x - summit).norm() < cap; });
    return {std::move(name), std::move(mesh), std::move(set), axis};
}

inline OrganicCase organic_case(const OrganicBody& body) {
    return {body.name, body.surface, {body.fixed, body.pull}, body.pull_direction};
}

/// A sphere with two horns and waves.
inline SurfaceMesh make_bumpy_sphere(int cells, double phase) {
    SurfaceMesh mesh = make_sphere(cells);
    const Eigen::Vector3d horn = Eigen::Vector3d(0.3, 0.2, 1.0).normalized(),
                          other = Eigen::Vector3d(-0.8, 0.5, 0.4 * std::sin(phase)).normalized();
    for (auto x : mesh.vertices.colwise()) {
        const Eigen::Vector3d p = x;
        const double radius = 1.0 + 0.25 * std::sin(3.0 * p[0] + phase) * std::cos(2.0 * p[1] - phase) +
                              0.5 * std::exp((p.dot(horn) - 1.0) / 0.08) + 0.6 * std::exp((p.dot(other) - 1.0) / 0.06);
        x = radius * Eigen::Vector3d(0.8 * p[0], 0.9 * p[1], p[2]);
    }
    return mesh;
}

/// A cylinder bent by an angle, its section changing along it.
inline SurfaceMesh make_bent_tube(int cells, double radius, double length, double angle) {
    SurfaceMesh mesh = make_cylinder(cells, radius, length);
    for (auto x : mesh.vertices.colwise()) {
        const double a = angle * (x[2] / length + 0.5);
        const double r = length / angle - x[0] * (1.0 + 0.3 * std::sin(2.0 * a));
        x = Eigen::Vector3d(r * std::cos(a), -x[1] * (1.0 + 0.3 * std::cos(3.0 * a)), r * std::sin(a));
    }
    return mesh;
}

/// Displacements of a body's vertices and reactions at its constrained ones (fixed set, then handles).
struct KnownAnswer {
    Eigen::VectorXd displacements;
    Reactions reactions;
};

/// Answers to several motions by Galerkin BEM on the same polyhedron, all triangles halved, with so many rows of thin
/// ones along the rims.
inline std::vector<KnownAnswer> computed_answers(const OrganicCase& body, const std::vector<Eigen::Matrix3Xd>& motions,
                                                 double poisson_ratio, int rows) {
    const auto marks = [&](const std::vector<int>& vertices, const RefinedSurface& fine, std::vector<char>& inside) {
        std::vector<char> chosen(static_cast<std::size_t>(body.surface.n_vertices()), 0);
        for (const int v : vertices) chosen[static_cast<std::size_t>(v)] = 1;
        std::vector<char> found(static_cast<std::size_t>(fine.mesh.n_vertices()), 0);
        for (int t = 0; t < body.surface.n_triangles(); ++t) {
            const auto corners = body.surface.triangles.col(t);
            if (std::all_of(corners.begin(), corners.end(), [&](int v) { return chosen[static_cast<std::size_t>(v)]; }))
                inside[static_cast<std::size_t>(t)] = 1;
        }
        for (int t = 0; t < fine.mesh.n_triangles(); ++t) {
            const auto corners = body.surface.triangles.col(fine.coarse_triangle[static_cast<std::size_t>(t)]);
            if (std::all_of(corners.begin(), corners.end(), [&](int v) { return chosen[static_cast<std::size_t>(v)]; }))
                for (const int v : fine.mesh.triangles.col(t)) found[static_cast<std::size_t>(v)] = 1;
        }
        return found;
    };
    std::vector<char> inside(static_cast<std::size_t>(body.surface.n_triangles()), 0);
    RefinedSurface fine = refine_all(unrefined(body.surface));
    marks(body.set.fixed, fine, inside);
    marks(body.set.handles, fine, inside);
    fine = add_rows_along_rim(fine, inside, rows, [](const SurfaceMesh&, int, double) { return true; });
    const std::vector<char> in_fixed = marks(body.set.fixed, fine, inside),
                            in_handle = marks(body.set.handles, fine, inside);
    ConstrainedSet set;
    for (int v = 0; v < fine.mesh.n_vertices(); ++v) {
        if (in_fixed[static_cast<std::size_t>(v)])
            set.fixed.push_back(v);
        else if (in_handle[static_cast<std::size_t>(v)])
            set.handles.push_back(v);
    }
    Method method{.kind = kGalerkinBem, .update = Update::direct};
    method.integral_tolerance = 1e-6;
    Control control;
    Deformer deformer(precomputed(make_body(fine.mesh, {1.0, poisson_ratio}), method));
    deformer.constrain(set, control);
    std::vector<int> all = set.fixed, coarse = body.set.fixed;
    all.insert(all.end(), set.handles.begin(), set.handles.end());
    coarse.insert(coarse.end(), body.set.handles.begin(), body.set.handles.end());
    std::vector<KnownAnswer> answers;
    for (const Eigen::Matrix3Xd& motion : motions) {
        const Eigen::VectorXd values = fine.interpolate(motion)(Eigen::all, set.handles).reshaped();
        const Deformer::Answer answer = deformer.answer(values, {}, control);
        Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, fine.mesh.n_vertices()), moments = forces;
        forces(Eigen::all, all) = answer.reactions.forces;
        moments(Eigen::all, all) = answer.reactions.moments;
        answers.push_back({answer.displacements.head(3 * body.surface.n_vertices()),
                           {fine.gather(forces)(Eigen::all, coarse), fine.gather(moments)(Eigen::all, coarse)}});
    }
    return answers;
}

/// computed_answers, stored.
inline std::vector<KnownAnswer> refined_answers(const OrganicCase& body, const std::vector<Eigen::Matrix3Xd>& motions,
                                                double poisson_ratio, int rows) {
    std::vector<int> constrained = body.set.fixed;
    constrained.insert(constrained.end(), body.set.handles.begin(), body.set.handles.end());
    const Eigen::Index n = body.surface.n_vertices();
    // Displacements, forces and moments, for each motion.
    const auto compute = [&] {
        Eigen::MatrixXd stored = Eigen::MatrixXd::Zero(n, 9 * std::ssize(motions));
        Eigen::Index column = 0;
        for (const KnownAnswer& answer : computed_answers(body, motions, poisson_ratio, rows)) {
            stored.middleCols(column, 3) = answer.displacements.reshaped(3, n).transpose();
            stored(constrained, Eigen::seqN(column + 3, 3)) = answer.reactions.forces.transpose();
            stored(constrained, Eigen::seqN(column + 6, 3)) = answer.reactions.moments.transpose();
            column += 9;
        }
        return stored;
    };
    const std::string what = body.name + " of " + std::to_string(static_cast<int>(std::lround(100.0 * poisson_ratio))) +
                             " hundredths with " + std::to_string(rows) + " rows";
    const Eigen::MatrixXd stored = stored_rows(what, body.surface.vertices, 9 * std::ssize(motions), compute);
    std::vector<KnownAnswer> answers;
    for (std::size_t m = 0; m < motions.size(); ++m) {
        const Eigen::Matrix3Xd own = stored.middleCols(9 * static_cast<Eigen::Index>(m), 9).transpose().topRows(3);
        const auto part = [&](int first) -> Eigen::Matrix3Xd {
            return stored(constrained, Eigen::seqN(9 * static_cast<Eigen::Index>(m) + first, 3)).transpose();
        };
        EXPECT_LT((own - motions[m])(Eigen::all, constrained).norm(), 1e-5 * motions[m].norm()) << what;
        answers.push_back({own.reshaped(), {part(3), part(6)}});
    }
    return answers;
}

/// Largest error of a vertex, over the largest displacement.
inline double displacement_error(const Eigen::VectorXd& u, const Eigen::VectorXd& truth) {
    return (u - truth).reshaped(3, u.size() / 3).colwise().norm().maxCoeff() /
           truth.reshaped(3, u.size() / 3).colwise().norm().maxCoeff();
}

/// Error of the reactions of the worst patch, over the largest.
inline double reaction_error(const OrganicCase& body, const Reactions& reactions, const Reactions& truth) {
    const ConstrainedPatches patches = constrained_patches(body.surface, body.set.fixed, body.set.handles);
    return largest_patch_reaction(body.surface, patches,
                                  {reactions.forces - truth.forces, reactions.moments - truth.moments}) /
           largest_patch_reaction(body.surface, patches, truth);
}

}  // namespace elastolab::test
