#include "bodies/shape.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

namespace elastolab::bodies {

using Eigen::Vector3d;

Vector3d Shape::normal(const Vector3d& p, int sheet) const {
    return gradient(solid_.sheets[static_cast<std::size_t>(sheet)], p).normalized();
}

/// Newton's method, each step the shortest that meets all sheets to first order.
Vector3d Shape::project(const Vector3d& start, Patchwork::Sheets sheets) const {
    Vector3d p = start;
    for (int step = 0; step < 8; ++step) {
        Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
        Vector3d f = Vector3d::Zero();
        int n = 0;
        for (std::size_t s = 0; s < solid_.sheets.size(); ++s)
            if (sheets >> s & 1U) {
                f[n] = solid_.sheets[s](p);
                J.row(n++) = gradient(solid_.sheets[s], p).transpose();
            }
        Eigen::Matrix3d A = J * J.transpose();
        for (int i = n; i < 3; ++i) A(i, i) = 1.0;
        p -= J.transpose() * A.inverse() * f;
        if (f.cwiseAbs().maxCoeff() < 1e-9) break;
    }
    return p;
}

double Shape::badness(const Vector3d& a, const Vector3d& b, const Vector3d& c, int sheet) const {
    const Vector3d ab = b - a, bc = c - b, ca = a - c;
    const double lab = ab.norm(), lbc = bc.norm(), lca = ca.norm();
    const Vector3d area = ab.cross(bc);
    if (area.norm() <= 1e-9 * lab * lbc) return 1.0;
    if (area.dot(normal((a + b + c) / 3.0, sheet)) < 0.5 * area.norm()) return 2.0;
    return std::max({-ab.dot(bc) / (lab * lbc), -bc.dot(ca) / (lbc * lca), -ca.dot(ab) / (lca * lab)});
}

double Shape::badness(const Patchwork::Triangle& t, int sheet) const {
    return badness(surface_.place(t[0]), surface_.place(t[1]), surface_.place(t[2]), sheet);
}

double Shape::worst_around(int v, const Vector3d& p, int without) const {
    double worst = -1.0;
    for (int t : surface_.around(v)) {
        const Patchwork::Triangle& corners = surface_.triangle(t);
        if (std::find(corners.begin(), corners.end(), without) != corners.end()) continue;
        const auto place = [&](std::size_t c) { return corners[c] == v ? p : surface_.place(corners[c]); };
        worst = std::max(worst, badness(place(0), place(1), place(2), surface_.sheet(t)));
    }
    return worst;
}

}  // namespace elastolab::bodies
