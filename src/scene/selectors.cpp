#include "scene/selectors.hpp"

#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

[[noreturn]] void fail(const std::string& where, const std::string& finding) {
    throw SceneError(one_line(where + ": " + finding));
}

template <class Inside>
std::vector<int> vertices_where(const SurfaceMesh& mesh, const std::string& where, const Inside& inside) {
    std::vector<int> vertices;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (inside(Eigen::Vector3d(mesh.vertices.col(v)))) vertices.push_back(v);
    if (vertices.empty()) fail(where, "selects nothing: no vertex lies there. Move or enlarge it.");
    return vertices;
}

/// One visitor for each kind of selector.
struct Selection {
    const SurfaceMesh& mesh;
    const std::string& where;

    std::vector<int> operator()(const VertexSelector& selector) const {
        std::vector<char> seen(static_cast<std::size_t>(mesh.n_vertices()), 0);
        for (std::size_t i = 0; i < selector.vertices.size(); ++i) {
            const int v = selector.vertices[i];
            const auto place = [&] { return where + "/vertices/" + std::to_string(i); };
            if (v < 0 || v >= mesh.n_vertices())
                fail(place(), "there is no vertex " + std::to_string(v) + ", the mesh has 0 to " +
                                  std::to_string(mesh.n_vertices() - 1) + ". Choose one of these.");
            if (std::exchange(seen[static_cast<std::size_t>(v)], 1) != 0)
                fail(place(), "vertex " + std::to_string(v) + " is listed twice. Remove it here.");
        }
        if (selector.vertices.empty()) fail(where + "/vertices", "selects nothing. Give at least one vertex number.");
        return selector.vertices;
    }
    std::vector<int> operator()(const BoxSelector& box) const {
        return vertices_where(mesh, where + "/box", [&](const Eigen::Vector3d& x) {
            return (x.array() >= box.min.array()).all() && (x.array() <= box.max.array()).all();
        });
    }
    std::vector<int> operator()(const SphereSelector& sphere) const {
        return vertices_where(mesh, where + "/sphere",
                              [&](const Eigen::Vector3d& x) { return (x - sphere.center).norm() <= sphere.radius; });
    }
    std::vector<int> operator()(const PlaneSelector& plane) const {
        const Eigen::Vector3d normal = plane.normal.stableNormalized();
        return vertices_where(mesh, where + "/plane", [&](const Eigen::Vector3d& x) {
            return std::abs(normal.dot(x - plane.point)) <= plane.tolerance;
        });
    }
    std::vector<int> operator()(const std::vector<Selector>& members) const {
        std::vector<char> seen(static_cast<std::size_t>(mesh.n_vertices()), 0);
        std::vector<int> vertices;
        for (std::size_t i = 0; i < members.size(); ++i)
            for (const int v : select_vertices(mesh, members[i], where + "/" + std::to_string(i)))
                if (std::exchange(seen[static_cast<std::size_t>(v)], 1) == 0) vertices.push_back(v);
        if (vertices.empty()) fail(where, "selects nothing. Give at least one selector.");
        return vertices;
    }
};

}  // namespace

std::vector<int> select_vertices(const SurfaceMesh& mesh, const Selector& selector, const std::string& where) {
    return std::visit(Selection{mesh, where}, selector.shape);
}

}  // namespace elastolab
