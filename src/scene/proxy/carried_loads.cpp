#include "scene/proxy/carried_loads.hpp"

#include "base/lapack.hpp"
#include "elasticity/rotation.hpp"
#include "mesh/closest_point.hpp"
#include "mesh/measures.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

namespace {

/// Edges of the proxy that a triangle of a filled surface may be from itself: rounding.
constexpr double kSameTriangle = 1e-6;
/// Triangles belong to a surface up to its open edges where their normals make angles of at most 60 degrees, and reach
/// beyond them by less than this part of an edge of the proxy.
constexpr double kSameSide = 0.5, kWithinRim = 0.25;
/// Of the area of the shown triangles, that those of one side have where that side is meant.
constexpr double kMostOfArea = 0.7;
/// Of the tractions, up to which they are changed for the sake of their force and moment.
constexpr double kSmallCorrection = 0.5;

/// The open edges of a surface, and which points are on them.
class OpenRims {
public:
    explicit OpenRims(const SurfaceMesh& mesh)
        : mesh_(mesh),
          is_open_(3 * static_cast<std::size_t>(mesh.n_triangles()), 0),
          at_open_edge_(static_cast<std::size_t>(mesh.n_vertices()), 0) {
        const EdgeTable edges(mesh);
        for (int e = 0; e < edges.size(); ++e) {
            if (edges.half_edges(e).size() != 1) continue;
            is_open_[static_cast<std::size_t>(edges.half_edges(e).front())] = 1;
            for (const int v : {edges[e].a, edges[e].b}) at_open_edge_[static_cast<std::size_t>(v)] = 1;
        }
    }

    bool has(const SurfacePoint& point) const {
        std::vector<int> without;  // corners that the point has nothing of
        for (int k = 0; k < 3; ++k)
            if (point.weights[k] < kRounding) without.push_back(k);
        if (without.size() == 1)
            return is_open_[static_cast<std::size_t>(next_corner(3 * point.triangle + without[0]))];
        return without.size() == 2 &&
               at_open_edge_[static_cast<std::size_t>(mesh_.triangles(3 - without[0] - without[1], point.triangle))];
    }

private:
    static constexpr double kRounding = 1e-9;

    const SurfaceMesh& mesh_;
    std::vector<char> is_open_;       ///< half-edges
    std::vector<char> at_open_edge_;  ///< vertices
};

/// What a triangle of the proxy is near to.
struct Near {
    int triangle = -1;         ///< shown; -1 where loads have no effect, and where the proxy closes a hole or is a rim
    bool faces_alike = false;  ///< its outside is on the side of that triangle's
};

/// Beyond an open edge of the shown surface the proxy is its cap, or the rim of its wall.
bool is_beyond(const Proxy& proxy, int triangle, const SurfacePoint& found) {
    const Eigen::Vector3d n = area_vector(triangle_points(*proxy.shown, found.triangle)).stableNormalized();
    const Eigen::Vector3d m = area_vector(triangle_points(*proxy.surface, triangle)).stableNormalized();
    const Eigen::Vector3d place =
        proxy.shown->vertices(Eigen::all, proxy.shown->triangles.col(found.triangle)) * found.weights;
    const Eigen::Vector3d from = centroid(*proxy.surface, triangle) - place;
    return std::abs(n.dot(m)) < kSameSide || (from - n.dot(from) * n).norm() > kWithinRim * proxy.edge;
}

/// What the middle of each triangle of the proxy is nearest to.
std::vector<Near> nearest_triangles(const Proxy& proxy, const ConstrainedSet& held) {
    const SurfaceMesh& surface = *proxy.surface;
    std::vector<char> is_held(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const std::vector<int>* vertices : {&held.fixed, &held.handles})
        for (const int v : *vertices) is_held[static_cast<std::size_t>(v)] = 1;
    std::vector<Near> nearest(static_cast<std::size_t>(surface.n_triangles()));
    const ClosestPoint closest(*proxy.shown);
    const OpenRims rims(*proxy.shown);
    for (int t = 0; t < surface.n_triangles(); ++t) {
        const Eigen::Vector3i v = surface.triangles.col(t);
        if (is_held[static_cast<std::size_t>(v[0])] && is_held[static_cast<std::size_t>(v[1])] &&
            is_held[static_cast<std::size_t>(v[2])])
            continue;
        const SurfacePoint found = closest(centroid(surface, t));
        const bool closes = proxy.is_filled() ? found.distance > kSameTriangle * proxy.edge
                                              : rims.has(found) && is_beyond(proxy, t, found);
        if (closes) continue;
        const bool alike =
            area_vector(triangle_points(surface, t)).dot(area_vector(triangle_points(*proxy.shown, found.triangle))) >=
            0.0;
        nearest[static_cast<std::size_t>(t)] = {found.triangle, alike};
    }
    return nearest;
}

double area_of(const SurfaceMesh& mesh, std::span<const int> triangles) {
    double sum = 0.0;
    for (const int t : triangles) sum += 0.5 * area_vector(triangle_points(mesh, t)).norm();
    return sum;
}

/// The triangles of the proxy that carry what these shown ones do: of a wall those on the side that these face. Where
/// too few face it, as round loose triangles that face anywhere, all of them.
std::vector<int> carried_triangles(const Proxy& proxy, const std::vector<int>& shown,
                                   const std::vector<Near>& nearest) {
    std::vector<char> is_loaded(static_cast<std::size_t>(proxy.shown->n_triangles()), 0);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int t : shown) {
        is_loaded[static_cast<std::size_t>(t)] = 1;
        middle += centroid(*proxy.shown, t) / static_cast<double>(shown.size());
    }
    std::vector<int> alike, all;
    for (std::size_t t = 0; t < nearest.size(); ++t) {
        const auto& [triangle, faces_alike] = nearest[t];
        if (triangle < 0 || is_loaded[static_cast<std::size_t>(triangle)] == 0) continue;
        all.push_back(static_cast<int>(t));
        if (faces_alike) alike.push_back(static_cast<int>(t));
    }
    if (!alike.empty() && area_of(*proxy.surface, alike) >= kMostOfArea * area_of(*proxy.shown, shown)) return alike;
    if (all.empty()) all.push_back(ClosestPoint(*proxy.surface)(middle).triangle);
    return all;
}

/// Loose triangles that lie upon each other have several times the area of the proxy around them.
bool is_as_large(std::span<const int> carried, const SurfaceMesh& surface, std::span<const int> own,
                 const SurfaceMesh& shown) {
    const double area = area_of(shown, own);
    return std::abs(area_of(surface, carried) - area) <= (1.0 - kMostOfArea) * area;
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
    const std::vector<Near> nearest = nearest_triangles(proxy, held);
    std::vector<AppliedLoad> carried = shown;
    for (AppliedLoad& load : carried)
        if (load.kind != AppliedLoad::Kind::gravity) load.triangles = carried_triangles(proxy, load.triangles, nearest);
    return carried;
}

std::vector<UnitLoad> carried_units(const Proxy& proxy, const AppliedLoad& carried, std::span<const UnitLoad> shown) {
    const SurfaceMesh& surface = *proxy.surface;
    std::vector<UnitLoad> units = unit_loads(carried.kind, surface, carried.triangles);
    if (proxy.is_filled()) return units;
    for (std::size_t i = 0; i < units.size(); ++i) {
        const bool has_total =
            carried.kind == AppliedLoad::Kind::force ||
            (carried.kind == AppliedLoad::Kind::traction &&
             (proxy.shown_is_sound || is_as_large(carried.triangles, surface, shown[i].triangles, *proxy.shown)));
        if (has_total) correct(units[i], resultant(*proxy.shown, shown[i]), surface);
    }
    return units;
}

}  // namespace elastolab
