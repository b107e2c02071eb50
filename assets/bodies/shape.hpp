#pragma once

#include <Eigen/Core>

#include "bodies/patchwork.hpp"
#include "bodies/solid.hpp"

namespace elastolab::bodies {

/// Questions about the triangles of a surface and the sheets that they approximate.
class Shape {
public:
    Shape(const Patchwork& surface, const Solid& solid) : surface_(surface), solid_(solid) {}

    /// The point nearest to p, to first order, on all of these sheets.
    Eigen::Vector3d project(const Eigen::Vector3d& p, Patchwork::Sheets sheets) const;
    /// Outward, unit, of one sheet.
    Eigen::Vector3d normal(const Eigen::Vector3d& p, int sheet) const;

    /// Of these corners: the largest cosine of an angle (the smaller the better; 1 without area), or 2 when the
    /// triangle faces away from the outside of its sheet by more than 60 degrees.
    double badness(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, int sheet) const;
    double badness(const Patchwork::Triangle& corners, int sheet) const;
    /// The worst of the triangles around a vertex if it were at p, leaving out those that have the vertex `without`.
    double worst_around(int v, const Eigen::Vector3d& p, int without = -1) const;

    double length(int a, int b) const { return (surface_.place(a) - surface_.place(b)).norm(); }
    double wanted_length(const Eigen::Vector3d& p) const { return solid_.edge_length(p); }

private:
    const Patchwork& surface_;
    const Solid& solid_;
};

}  // namespace elastolab::bodies
