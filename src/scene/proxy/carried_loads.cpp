#include "scene/proxy/carried_loads.hpp"

#include "base/lapack.hpp"
#include "elasticity/rotation.hpp"
#include "mesh/closest_point.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace {

/// Edges of the proxy that a triangle of a filled surface may be from itself: rounding.
constexpr double kSameTriangle = 1e-6;
/// Of the tractions, up to which they are changed for the sake of their force and moment.
constexpr double kSmallCorrection = 0.5;

/// The shown triangle that the middle of each triangle of the proxy is nearest to; -1 where loads have no effect, and
/// where the proxy fills a hole.
std::vector<int> nearest_triangles(const Proxy& proxy, const ConstrainedSet& held) {
    const SurfaceMesh& surface = *proxy.surface;
    std::vector<char> is_held(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const std::vector<int>* vertices : {&held.fixed, &held.handles})
        for (const int v : *vertices) is_held[static_cast<std::size_t>(v)] = 1;
    std::vector<int> nearest(static_cast<std::size_t>(surface.n_triangles()), -1);
    const ClosestPoint closest(*proxy.shown);
    for (int t = 0; t < surface.n_triangles(); ++t) {
        const Eigen::Vector3i v = surface.triangles.col(t);
        if (is_held[static_cast<std::size_t>(v[0])] && is_held[static_cast<std::size_t>(v[1])] &&
            is_held[static_cast<std::size_t>(v[2])])
            continue;
        const SurfacePoint found = closest(centroid(surface, t));
        if (!proxy.is_filled() || found.distance <= kSameTriangle * proxy.edge)
            nearest[static_cast<std::size_t>(t)] = found.triangle;
    }
    return nearest;
}

/// The triangles of the proxy that carry what these shown ones do.
std::vector<int> carried_triangles(const Proxy& proxy, const std::vector<int>& shown, const std::vector<int>& nearest) {
    std::vector<char> is_loaded(static_cast<std::size_t>(proxy.shown->n_triangles()), 0);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int t : shown) {
        is_loaded[static_cast<std::size_t>(t)] = 1;
        middle += centroid(*proxy.shown, t) / static_cast<double>(shown.size());
    }
    std::vector<int> triangles;
    for (std::size_t t = 0; t < nearest.size(); ++t)
        if (nearest[t] >= 0 && is_loaded[static_cast<std::size_t>(nearest[t])] != 0)
            triangles.push_back(static_cast<int>(t));
    if (triangles.empty()) triangles.push_back(ClosestPoint(*proxy.surface)(middle).triangle);
    return triangles;
}

/// Adds tractions a + b x (x - c) to those of the load, so that its force and moment become these; nothing where they
/// would have to be large, as where few triangles of the proxy carry it.
void correct(UnitLoad& load, const Resultant& wanted, const SurfaceMesh& surface) {
    const Eigen::Index n = std::ssize(load.triangles);
    Eigen::Matrix3Xd arms(3, n);
    Eigen::VectorXd areas(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const int t = load.triangles[static_cast<std::size_t>(i)];
        arms.col(i) = centroid(surface, t);
        areas[i] = 0.5 * area_vector(triangle_points(surface, t)).norm();
    }
    const Eigen::Vector3d middle = arms * areas / areas.sum();
    arms.colwise() -= middle;
    const double length = arms.colwise().norm().maxCoeff();
    if (!(length > 0.0)) return;
    // Rows and columns of moments and turns are divided by the length.
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(6, 6);
    for (Eigen::Index i = 0; i < n; ++i) {
        Eigen::Matrix<double, 3, 6> field;
        field << Eigen::Matrix3d::Identity(), -cross_matrix(arms.col(i) / length);
        sums += areas[i] * field.transpose() * field;
    }
    const Resultant own = resultant(surface, load);
    Eigen::VectorXd missing(6);
    missing << wanted.force - own.force, (wanted.moment - own.moment - middle.cross(wanted.force - own.force)) / length;
    const Eigen::VectorXd field = solve_minimum_norm(sums, missing).X;
    Eigen::Matrix3Xd more(3, n);
    for (Eigen::Index i = 0; i < n; ++i)
        more.col(i) = field.head<3>() + field.tail<3>().cross((arms.col(i) / length).eval());
    if (more.colwise().norm().maxCoeff() <= kSmallCorrection * load.tractions.colwise().norm().maxCoeff())
        load.tractions += more;
}

}  // namespace

std::vector<AppliedLoad> carried_loads(const Proxy& proxy, const std::vector<AppliedLoad>& shown,
                                       const ConstrainedSet& held) {
    if (shown.empty()) return {};
    const std::vector<int> nearest = nearest_triangles(proxy, held);
    std::vector<AppliedLoad> carried = shown;
    for (AppliedLoad& load : carried)
        if (load.kind != AppliedLoad::Kind::gravity) load.triangles = carried_triangles(proxy, load.triangles, nearest);
    return carried;
}

std::vector<UnitLoad> carried_units(const Proxy& proxy, const AppliedLoad& carried, std::span<const UnitLoad> shown) {
    const SurfaceMesh& surface = *proxy.surface;
    std::vector<UnitLoad> units = unit_loads(carried.kind, surface, carried.triangles);
    if (proxy.is_filled()) return units;
    const bool has_total = carried.kind == AppliedLoad::Kind::force ||
                           (carried.kind == AppliedLoad::Kind::traction && proxy.shown_is_sound);
    for (std::size_t i = 0; i < units.size() && has_total; ++i)
        correct(units[i], resultant(*proxy.shown, shown[i]), surface);
    return units;
}

}  // namespace elastolab
