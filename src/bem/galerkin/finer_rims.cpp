#include "bem/galerkin/finer_rims.hpp"

#include <algorithm>

#include "elasticity/triangle_geometry.hpp"
#include "mesh/measures.hpp"
#include "mesh/rims.hpp"

namespace elastolab {

namespace {

/// Faces turn into the body at a re-entrant edge by more than this angle, in radians: at less, curved surfaces in flat
/// triangles have such edges everywhere.
constexpr double kReentrant = 0.8;
/// A row adds one to three times as many triangles as coarse bodies with a few such edges have. Where it would add more
/// than this, nearly every edge is one, as of a bar that is twisted through itself.
constexpr int kMostAdded = 6;

bool all_corners(const Eigen::Vector3i& triangle, const std::vector<char>& marked) {
    return std::all_of(triangle.begin(), triangle.end(), [&](int v) { return marked[static_cast<std::size_t>(v)]; });
}

std::vector<char> marked_vertices(const SurfaceMesh& surface, std::span<const int> vertices) {
    std::vector<char> marked(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const int v : vertices) marked[static_cast<std::size_t>(v)] = 1;
    return marked;
}

std::vector<char> constrained_triangles(const SurfaceMesh& surface, const std::vector<char>& is_constrained) {
    std::vector<char> inside;
    for (const auto& t : surface.triangles.colwise()) inside.push_back(all_corners(t, is_constrained) ? 1 : 0);
    return inside;
}

void mark_around(const SurfaceMesh& surface, const std::vector<char>& vertices, std::vector<char>& marked) {
    for (int t = 0; t < surface.n_triangles(); ++t)
        for (const int v : surface.triangles.col(t))
            if (vertices[static_cast<std::size_t>(v)]) marked[static_cast<std::size_t>(t)] = 1;
}

/// Cut, a sliver becomes slivers: its integrals cost far more, and its error stays.
bool may_be_cut(const SurfaceMesh& surface, int t, double share) {
    const TrianglePoints p = triangle_points(surface, t);
    TriangleGeometry cut = make_triangle_geometry(p.a, p.b, p.c, t);
    cut.double_area *= share;
    return !has_sliver_potential(cut);
}

/// Triangles around these vertices in four.
RefinedSurface halved_around(const SurfaceMesh& body, const std::vector<char>& around) {
    std::vector<char> marked(static_cast<std::size_t>(body.n_triangles()), 0);
    mark_around(body, around, marked);
    for (int t = 0; t < body.n_triangles(); ++t)
        if (!may_be_cut(body, t, 1.0)) marked[static_cast<std::size_t>(t)] = 0;
    return refine_marked(unrefined(body), marked);
}

std::vector<char> lone_vertices(const SurfaceMesh& body, std::vector<char> is_constrained,
                                const std::vector<char>& inside) {
    for (int t = 0; t < body.n_triangles(); ++t)
        for (const int v : body.triangles.col(t))
            if (inside[static_cast<std::size_t>(t)]) is_constrained[static_cast<std::size_t>(v)] = 0;
    return is_constrained;
}

/// The loads of the triangles that the finer ones are parts of.
std::vector<UnitLoad> on_finer_triangles(const RefinedSurface& fine, std::span<const UnitLoad> loads) {
    std::vector<UnitLoad> result(loads.begin(), loads.end());
    for (UnitLoad& load : result) {
        std::vector<int> place(fine.coarse_triangle.size(), -1), columns, triangles;  // no more coarse ones than fine
        for (std::size_t k = 0; k < load.triangles.size(); ++k)
            place[static_cast<std::size_t>(load.triangles[k])] = static_cast<int>(k);
        for (std::size_t t = 0; t < fine.coarse_triangle.size(); ++t)
            if (const int k = place[static_cast<std::size_t>(fine.coarse_triangle[t])]; k >= 0) {
                triangles.push_back(static_cast<int>(t));
                columns.push_back(k);
            }
        load.tractions = Eigen::Matrix3Xd(load.tractions(Eigen::all, columns));
        load.triangles = std::move(triangles);
    }
    return result;
}

}  // namespace

SurfaceSet::SurfaceSet(const SurfaceMesh& surface, std::vector<int> constrained, std::span<const UnitLoad> unit_loads)
    : vertices(std::move(constrained)),
      loads(unit_loads.begin(), unit_loads.end()),
      nodes(constrain_vertices(vertices)),
      shares(nodal_shares(surface.vertices, vertices)) {}

FinerRims::FinerRims(const SurfaceMesh& body, std::span<const int> constrained, std::span<const UnitLoad> unit_loads,
                     int rows, LoneVertices lone, Halved halved_triangles)
    : surface(unrefined(body)) {
    const std::vector<char> of_body = marked_vertices(body, constrained), inside = constrained_triangles(body, of_body);
    if (rows > 0) {
        std::vector<char> around(of_body.size(), halved_triangles == Halved::all ? 1 : 0);
        if (halved_triangles == Halved::none && lone == LoneVertices::refined)
            around = lone_vertices(body, of_body, inside);
        const RefinedSurface halved = halved_around(body, around);
        surface = add_rows_along_rim(halved, inside, rows, may_be_cut, kReentrant);
        if (surface.mesh.n_triangles() > (1 + kMostAdded * rows) * halved.mesh.n_triangles())
            surface = add_rows_along_rim(halved, inside, rows, may_be_cut);
    }
    n_constrained_of_body = std::count(inside.begin(), inside.end(), 1);
    is_finer = surface.mesh.n_triangles() > body.n_triangles();
    loads = on_finer_triangles(surface, unit_loads);

    std::vector<char> is_constrained = of_body;
    is_constrained.resize(static_cast<std::size_t>(surface.mesh.n_vertices()), 0);
    for (int t = 0; t < surface.mesh.n_triangles(); ++t)
        if (inside[static_cast<std::size_t>(surface.coarse_triangle[static_cast<std::size_t>(t)])]) {
            ++n_constrained_triangles;
            for (const int v : surface.mesh.triangles.col(t)) is_constrained[static_cast<std::size_t>(v)] = 1;
        }
    for (int v = 0; v < surface.mesh.n_vertices(); ++v)
        if (is_constrained[static_cast<std::size_t>(v)]) vertices.push_back(v);

    std::vector<int> place(of_body.size(), -1);
    for (std::size_t i = 0; i < constrained.size(); ++i)
        place[static_cast<std::size_t>(constrained[i])] = static_cast<int>(i);
    const SurfaceWeights weights = surface.weights();
    BlockWeights prescribe;
    for (int node = 0; node < std::ssize(vertices); ++node) {
        const int v = vertices[static_cast<std::size_t>(node)];
        for (SurfaceWeights::InnerIterator at(weights, v); at; ++at) {
            const int i = place[static_cast<std::size_t>(at.col())];
            prescribe.add(node, i, at.value());
            // With the arm of the body's vertex, as forces on its own surface have: where two handles touch, the moment
            // of each depends on it.
            shares.push_back({node, i, at.value(), at.value() * body.vertices.col(at.col())});
        }
    }
    nodes = {vertices, prescribe.build(std::ssize(vertices), std::ssize(constrained))};
}

}  // namespace elastolab
