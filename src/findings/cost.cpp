#include "findings/cost.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "mesh/refine.hpp"

namespace elastolab {

namespace {

std::string in_gigabytes(std::uint64_t bytes) {
    std::string text = std::to_string(static_cast<double>(bytes) / 1e9);
    return text.substr(0, text.find('.') + 2) + " GB";
}

}  // namespace

Cost predict_cost(const SurfaceMesh& surface, const Method& method) { return method.kind->predict(surface, method); }

std::uint64_t predict_check_memory(const Model& model, const ConstrainedSet& set) {
    const SurfaceMesh& surface = *model.body().surface;
    if (model.method().kind->has_inside) {
        // Stiffness of some eight times as many quadratic nodes and its two parts; of quadratic FEM a linear one.
        constexpr std::uint64_t kBytesOfNode = 12000;
        return kBytesOfNode * static_cast<std::uint64_t>(model.facts().n_degrees_of_freedom / 3) *
               (model.method().kind->locks ? 8 : 1);
    }
    // Galerkin BEM on a surface with finer rims: the hypersingular matrix and that of the free vertices, both layers.
    std::vector<char> constrained(static_cast<std::size_t>(surface.n_vertices()), 0), inside;
    for (const std::vector<int>* vertices : {&set.base, &set.handles})
        for (const int v : *vertices) constrained[static_cast<std::size_t>(v)] = 1;
    for (const auto& t : surface.triangles.colwise())
        inside.push_back(
            std::all_of(t.begin(), t.end(), [&](int v) { return constrained[static_cast<std::size_t>(v)]; }) ? 1 : 0);
    const RefinedSurface coarse = unrefined(surface), fine = refine_marked(coarse, around_rim(coarse, inside));
    const auto n_tractions = std::count_if(fine.coarse_triangle.begin(), fine.coarse_triangle.end(),
                                           [&](int t) { return inside[static_cast<std::size_t>(t)] != 0; });
    const auto n = 3 * static_cast<std::uint64_t>(fine.mesh.n_vertices()),
               m = 3 * static_cast<std::uint64_t>(n_tractions);
    return 8 * (2 * n * n + 3 * n * m + m * m);
}

void require_memory(const Cost& cost, const Method& method) {
    const std::uint64_t available = available_memory_bytes();
    if (cost.memory_bytes <= available) return;
    const std::string_view cheaper = method.mode == Mode::full_volume ? "the mode full"
                                     : method.mode == Mode::full      ? "the mode on-demand"
                                                                      : method.kind->cheaper;
    throw SolveError(std::string(name(method.kind)) + ", mode " + std::string(name(method.mode)) + ": needs " +
                     in_gigabytes(cost.memory_bytes) + " of memory, " + in_gigabytes(available) + " are free. Choose " +
                     std::string(cheaper) + ".");
}

}  // namespace elastolab
