// elastolab-tetgen: runs TetGen for tetrahedralize(), so that an abort or crash of TetGen ends this process only.
// Standard input is a socket to the caller; what TetGen prints goes to standard output, which the caller keeps.
#include <tetgen.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <vector>

#include "mesh/input/helper_io.hpp"
#include "mesh/tets/seed_points.hpp"
#include "mesh/tets/size_field.hpp"
#include "mesh/tets/tetgen_protocol.hpp"

namespace {

using namespace elastolab;

/// The surface as TetGen takes it, and points that belong to no triangle of it. tetgenio frees what it points to with
/// delete[].
void fill(tetgenio& in, const std::vector<double>& vertices, const std::vector<int>& triangles,
          const std::vector<double>& holes, const std::vector<double>& seeds) {
    in.firstnumber = 0;
    in.numberofpoints = static_cast<int>((vertices.size() + seeds.size()) / 3);
    in.pointlist = new double[vertices.size() + seeds.size()];
    std::copy(seeds.begin(), seeds.end(), std::copy(vertices.begin(), vertices.end(), in.pointlist));
    in.numberoffacets = static_cast<int>(triangles.size() / 3);
    in.facetlist = new tetgenio::facet[triangles.size() / 3];
    for (int t = 0; t < in.numberoffacets; ++t) {
        tetgenio::facet& facet = in.facetlist[t];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        facet.polygonlist[0].numberofvertices = 3;
        facet.polygonlist[0].vertexlist = new int[3];
        std::copy_n(&triangles[static_cast<std::size_t>(3 * t)], 3, facet.polygonlist[0].vertexlist);
    }
    in.numberofholes = static_cast<int>(holes.size() / 3);
    in.holelist = holes.empty() ? nullptr : new double[holes.size()];
    std::copy(holes.begin(), holes.end(), in.holelist);
}

/// What TetGen's callback, which takes no context, asks about each tetrahedron.
struct VolumeBound {
    std::unique_ptr<const SizeField> sizes;
    double relative_volume = 0.0;

    bool exceeded(const double* a, const double* b, const double* c, const double* d) const {
        const double volume = volume_of(a, b, c, d);
        if (volume <= allowed(sizes->least())) return false;
        const double centre[3] = {mean(a, b, c, d, 0), mean(a, b, c, d, 1), mean(a, b, c, d, 2)};
        return volume > allowed(sizes->at(centre));
    }
    double allowed(double edge) const { return relative_volume * edge * edge * edge / (6.0 * std::numbers::sqrt2); }
    static double mean(const double* a, const double* b, const double* c, const double* d, int i) {
        return (a[i] + b[i] + c[i] + d[i]) / 4.0;
    }
    static double volume_of(const double* a, const double* b, const double* c, const double* d) {
        double u[3], v[3], w[3];
        for (int i = 0; i < 3; ++i) {
            u[i] = a[i] - d[i];
            v[i] = b[i] - d[i];
            w[i] = c[i] - d[i];
        }
        return std::abs(u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                        u[2] * (v[0] * w[1] - v[1] * w[0])) /
               6.0;
    }
};
VolumeBound volume_bound;

bool is_too_large(double* a, double* b, double* c, double* d, double*, double) {
    return volume_bound.exceeded(a, b, c, d);
}

int run(char* switches, tetgenio& in, tetgenio& out) {
    try {
        tetrahedralize(switches, &in, &out);
        return 0;
    } catch (int status) {
        return status == 0 ? -1 : status;
    } catch (const std::bad_alloc&) {
        return 1;  // TetGen's own number for this
    }
}

}  // namespace

int main() {
    begin_helper();
    TetgenRequestHeader request;
    read_bytes(&request, sizeof(request));
    if (request.magic != kTetgenMagic || request.switches.back() != '\0') return kHelperMisused;
    limit_seconds(request.cpu_seconds);
    const auto vertices = read_array<double>(3 * request.n_vertices);
    const auto triangles = read_array<int>(3 * request.n_triangles);
    const auto holes = read_array<double>(3 * request.n_holes);

    tetgenio in, out;
    std::vector<double> seeds;
    if (request.relative_volume > 0.0) {
        volume_bound = {std::make_unique<SizeField>(vertices, triangles, request.growth), request.relative_volume};
        if (request.seeded != 0) seeds = seed_points(vertices, *volume_bound.sizes);
        in.tetunsuitable = is_too_large;
    }
    fill(in, vertices, triangles, holes, seeds);
    TetgenReplyHeader reply;
    reply.status = run(request.switches.data(), in, out);
    if (reply.status == 0) {
        reply.n_vertices = out.numberofpoints;
        reply.n_tetrahedra = out.numberoftetrahedra;
    }
    write_bytes(&reply, sizeof(reply));
    write_bytes(out.pointlist, 3 * sizeof(double) * static_cast<std::size_t>(reply.n_vertices));
    write_bytes(out.tetrahedronlist, 4 * sizeof(int) * static_cast<std::size_t>(reply.n_tetrahedra));
    std::_Exit(0);  // at once: what TetGen leaves behind after a throw cannot be trusted
}
