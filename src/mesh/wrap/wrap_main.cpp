// elastolab-wrap: runs CGAL's alpha wrapping, edge collapse and filling of holes for mesh/wrap/wrap_process.hpp, so
// that a crash or a long run of theirs harms nobody, and so that nothing else has to be compiled with them. Standard
// input is a socket to the caller.
#include <CGAL/alpha_wrap_3.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mesh/input/helper_io.hpp"
#include "mesh/wrap/cgal_mesh.hpp"
#include "mesh/wrap/wrap_protocol.hpp"

namespace {

using namespace elastolab;

using Oracle = CGAL::Alpha_wraps_3::internal::Triangle_soup_oracle<Kernel>;

Soup read_soup(const WrapRequestHeader& request) {
    const auto vertices = read_array<double>(3 * request.n_vertices);
    const auto triangles = read_array<int>(3 * request.n_triangles);
    Soup soup;
    for (std::size_t i = 0; i < vertices.size(); i += 3)
        soup.points.emplace_back(vertices[i], vertices[i + 1], vertices[i + 2]);
    for (std::size_t i = 0; i < triangles.size(); i += 3)
        soup.triangles.push_back({static_cast<std::size_t>(triangles[i]), static_cast<std::size_t>(triangles[i + 1]),
                                  static_cast<std::size_t>(triangles[i + 2])});
    return soup;
}

/// Vertices of a wrap lie this part of alpha from the surface.
constexpr double kOffset = 0.1;

Result wrap_once(const Oracle& oracle, double alpha) {
    Result result{{}, alpha, kOffset * alpha, 0};
    CGAL::Alpha_wraps_3::internal::Alpha_wrap_3<Oracle> wrapper(oracle);
    wrapper(alpha, result.offset, result.mesh);
    return result;
}

/// The number of vertices of a wrap grows with its area over the square of alpha.
Result wrap(const Soup& soup, const WrapRequestHeader& request) {
    Oracle oracle;
    oracle.add_triangle_soup(soup.points, soup.triangles, CGAL::parameters::default_values());
    Result result = wrap_once(oracle, request.alpha);
    for (int attempt = 1; attempt < 3 && request.wanted_vertices > 0; ++attempt) {
        const double ratio = static_cast<double>(result.mesh.number_of_vertices()) / request.wanted_vertices;
        if (ratio == 0.0 || (ratio > 1.0 / request.within && ratio < request.within)) break;
        result = wrap_once(oracle, result.alpha * std::clamp(std::sqrt(ratio), 0.1, 4.0));
    }
    return result;
}

/// Cost of a collapse after Lindstrom and Turk, which is zero for all edges of a plane: a little of what an edge's
/// length would cost keeps triangles there of one size. Lengths are in parts of the body's.
struct CollapseCost {
    static constexpr double kLengthPart = 1e-4;
    CGAL::Surface_mesh_simplification::LindstromTurk_cost<Mesh> shape;

    template <class Profile>
    boost::optional<Kernel::FT> operator()(const Profile& profile,
                                           const boost::optional<Kernel::Point_3>& placement) const {
        boost::optional<Kernel::FT> cost = shape(profile, placement);
        const double length = CGAL::squared_distance(profile.p0(), profile.p1());
        if (cost) *cost += kLengthPart * length * length * length;
        return cost;
    }
};

Result collapse(const Soup& soup, int wanted) {
    namespace sms = CGAL::Surface_mesh_simplification;
    Result result;
    result.mesh = mesh_of(soup);
    const sms::Count_stop_predicate<Mesh> stop(3 * static_cast<std::size_t>(wanted));
    sms::edge_collapse(result.mesh, stop, CGAL::parameters::get_cost(CollapseCost{}));
    result.mesh.collect_garbage();
    return result;
}

void answer(const Result& result) {
    std::vector<double> vertices;
    std::vector<int> triangles;
    for (const auto v : result.mesh.vertices()) {
        const auto& p = result.mesh.point(v);
        vertices.insert(vertices.end(), {p.x(), p.y(), p.z()});
    }
    for (const auto f : result.mesh.faces())
        for (const auto v : CGAL::vertices_around_face(result.mesh.halfedge(f), result.mesh))
            triangles.push_back(static_cast<int>(v.idx()));
    WrapReplyHeader reply;
    reply.n_vertices = static_cast<std::int32_t>(vertices.size() / 3);
    reply.n_triangles = static_cast<std::int32_t>(triangles.size() / 3);
    reply.n_holes = result.n_holes;
    reply.alpha = result.alpha;
    reply.offset = result.offset;
    write_bytes(&reply, sizeof(reply));
    write_bytes(vertices.data(), vertices.size() * sizeof(double));
    write_bytes(triangles.data(), triangles.size() * sizeof(int));
}

Result result_of(const WrapRequestHeader& request, const Soup& soup) {
    switch (request.task) {
        case WrapTask::wrap:
            return wrap(soup, request);
        case WrapTask::collapse:
            return collapse(soup, request.wanted_vertices);
        case WrapTask::fill_smooth:
        case WrapTask::fill_flat:
            break;
    }
    return fill_holes(soup, request.task);
}

}  // namespace

namespace elastolab {

Mesh mesh_of(const Soup& soup) {
    Mesh mesh;
    for (const auto& p : soup.points) mesh.add_vertex(p);
    const auto vertex = [](std::size_t i) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(i)); };
    for (const auto& t : soup.triangles)
        if (!mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])).is_valid())
            throw std::runtime_error("its triangles are no oriented 2-manifold");
    return mesh;
}

}  // namespace elastolab

int main() {
    begin_helper();
    WrapRequestHeader request;
    read_bytes(&request, sizeof(request));
    if (request.magic != kWrapMagic || request.n_triangles < 1) return kHelperMisused;
    const Soup soup = read_soup(request);
    try {
        answer(result_of(request, soup));
    } catch (const std::exception& error) {
        std::puts(error.what());
        return EXIT_FAILURE;
    }
    std::_Exit(0);
}
