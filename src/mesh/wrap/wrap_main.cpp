// elastolab-wrap: runs CGAL's alpha wrapping, edge collapse and filling of holes for mesh/wrap/wrap_process.hpp, so
// that a crash or a long run of theirs harms nobody, and so that nothing else has to be compiled with them. Standard
// input is a socket to the caller.
#include <CGAL/alpha_wrap_3.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mesh/input/helper_io.hpp"
#include "mesh/wrap/cgal_mesh.hpp"
#include "mesh/wrap/wrap_protocol.hpp"

namespace {

using namespace elastolab;
namespace sms = CGAL::Surface_mesh_simplification;

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

/// A wrap is given up when it has inserted this many points for each vertex that is wanted; most become vertices.
constexpr double kMostPoints = 3.0;

struct TooManyPoints {};

/// Counts the points that a wrap inserts: tells the caller how far it is, and ends one that becomes far too fine.
class PointCount : public CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
public:
    PointCount(double usual, double most) : usual_(usual), most_(most) {}

    template <class Wrapper, class Point>
    void before_Steiner_point_insertion(const Wrapper&, const Point&) {
        constexpr int kBetweenWords = 256;
        if (++count_ > most_) throw TooManyPoints{};
        if (count_ % kBetweenWords != 0) return;
        WrapProgress word;
        word.fraction = std::min(0.95, count_ / usual_);
        write_bytes(&word, sizeof(word));
    }

private:
    double usual_, most_;
    int count_ = 0;
};

std::optional<Result> wrap_once(const Oracle& oracle, double alpha, PointCount count) {
    Result result{{}, alpha, kOffset * alpha, 0};
    CGAL::Alpha_wraps_3::internal::Alpha_wrap_3<Oracle> wrapper(oracle);
    try {
        wrapper(alpha, result.offset, result.mesh, CGAL::parameters::visitor(count));
    } catch (const TooManyPoints&) {
        return std::nullopt;
    }
    return result;
}

/// Looks for the alpha of which a wrap has so many vertices. Their number grows with the wrap's area over the square of
/// alpha; the area is known from a wrap only, and that of sheets and soups grows where a finer alpha finds its way
/// between them: with alpha to the power -1.85 around solids, to -3 at worst. The power is taken from the last two
/// wraps.
class AlphaSearch {
public:
    AlphaSearch(double wanted, double known_alpha, double known_vertices)
        : wanted_(wanted), alpha_(known_alpha), vertices_(known_vertices) {}

    /// The next to try. The first steps are careful: a wrap far too fine takes long, one too rough next to nothing.
    double next() const {
        const double ratio = wanted_ / vertices_;
        double step = std::pow(ratio, 1.0 / power_);
        if (!tried_ && ratio > 1.0) step = std::min(step, std::cbrt(2.0 * ratio));
        return std::max(alpha_ / std::clamp(step, 0.25, 10.0), 1.1 * too_fine_);
    }
    void tell(double alpha, double vertices) {
        if (alpha != alpha_) power_ = std::clamp(std::log(vertices / vertices_) / std::log(alpha_ / alpha), 1.2, 4.0);
        alpha_ = alpha;
        vertices_ = vertices;
        tried_ = true;
    }
    void tell_too_fine(double alpha) {
        constexpr double kPowerOfSoups = 2.6;
        too_fine_ = std::max(too_fine_, alpha);
        tell(alpha, kMostPoints * wanted_);
        power_ = kPowerOfSoups;
    }

private:
    double wanted_, alpha_, vertices_, power_ = 1.85, too_fine_ = 0.0;
    bool tried_ = false;
};

/// Three attempts to come near the number of vertices from either side, more to come down to it.
Result wrap_to_size(const Oracle& oracle, const WrapRequestHeader& request) {
    constexpr int kAttempts = 3, kMostAttempts = 8;
    const double wanted = request.wanted_vertices;
    AlphaSearch search(wanted, request.alpha, request.known_vertices);
    Result best;
    double best_ratio = 0.0;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
        const double alpha = search.next();
        auto result = wrap_once(oracle, alpha, PointCount(wanted, kMostPoints * wanted));
        if (!result) {
            search.tell_too_fine(alpha);
            continue;
        }
        const double n_vertices = static_cast<double>(result->mesh.number_of_vertices()), ratio = n_vertices / wanted;
        if (best_ratio == 0.0 || std::abs(std::log(ratio)) < std::abs(std::log(best_ratio))) {
            best = std::move(*result);
            best_ratio = ratio;
        }
        if (n_vertices == 0.0 || (best_ratio < request.within && best_ratio > 1.0 / request.within)) break;
        if (attempt + 1 >= kAttempts && best_ratio < request.within) break;
        search.tell(alpha, n_vertices);
    }
    if (best_ratio == 0.0 && best.mesh.is_empty()) throw std::runtime_error("every wrap became far too fine");
    return best;
}

Result wrap(const Soup& soup, const WrapRequestHeader& request) {
    constexpr double kUsualRough = 1000.0;
    Oracle oracle;
    oracle.add_triangle_soup(soup.points, soup.triangles, CGAL::parameters::default_values());
    if (request.wanted_vertices > 0) return wrap_to_size(oracle, request);
    return *wrap_once(oracle, request.alpha, PointCount(kUsualRough, std::numeric_limits<double>::infinity()));
}

/// Cost of a collapse after Lindstrom and Turk, which is zero for all edges of a plane: a little of what an edge's
/// length would cost keeps triangles there of one size. Lengths are in parts of the body's.
struct CollapseCost {
    static constexpr double kLengthPart = 1e-4;
    sms::LindstromTurk_cost<Mesh> shape;

    template <class Profile>
    boost::optional<Kernel::FT> operator()(const Profile& profile,
                                           const boost::optional<Kernel::Point_3>& placement) const {
        boost::optional<Kernel::FT> cost = shape(profile, placement);
        const double length = CGAL::squared_distance(profile.p0(), profile.p1());
        if (cost) *cost += kLengthPart * length * length * length;
        return cost;
    }
};

/// Collapses the shortest edges to their midpoints, which takes a quarter of the time, and leaves sharp edges and the
/// triangles at them as they are.
void collapse_short_edges(Mesh& mesh, std::size_t n_edges) {
    constexpr double kSharpDegrees = 40.0;
    const auto sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
    CGAL::Polygon_mesh_processing::detect_sharp_edges(mesh, kSharpDegrees, sharp);
    using Placement = sms::Constrained_placement<sms::Midpoint_placement<Mesh>, decltype(sharp)>;
    sms::edge_collapse(mesh, sms::Count_stop_predicate<Mesh>(n_edges),
                       CGAL::parameters::get_cost(sms::Edge_length_cost<Mesh>())
                           .get_placement(Placement(sharp))
                           .edge_is_constrained_map(sharp)
                           .filter(sms::Bounded_normal_change_filter<>()));
}

/// No collapse may turn a triangle over: without the filter, triangles fold where many lie in one plane.
Result collapse(const Soup& soup, int wanted) {
    constexpr std::size_t kFar = 32, kShortEdgesUpTo = 8;
    Result result;
    result.mesh = mesh_of(soup);
    const std::size_t n_edges = 3 * static_cast<std::size_t>(wanted);
    if (result.mesh.number_of_edges() > kFar * n_edges) collapse_short_edges(result.mesh, kShortEdgesUpTo * n_edges);
    sms::edge_collapse(result.mesh, sms::Count_stop_predicate<Mesh>(n_edges),
                       CGAL::parameters::get_cost(CollapseCost{}).filter(sms::Bounded_normal_change_filter<>()));
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
