#include "findings/cost.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

/// What any solid takes for as long as it is computed, however small it is: the next one takes it again.
std::uint64_t shared_memory(const Method& method) {
    SurfaceMesh smallest{Positions::Zero(3, 4), Triangles(3, 4)};
    smallest.vertices.rightCols<3>().setIdentity();
    smallest.triangles << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
    return method.kind->predict(smallest, method).memory_bytes;
}

void add(const Cost& cost, std::size_t times, std::uint64_t shared, Cost& sum) {
    sum.degrees_of_freedom += cost.degrees_of_freedom * static_cast<std::int64_t>(times);
    sum.memory_bytes += (cost.memory_bytes - std::min(cost.memory_bytes, shared)) * times;
    Work work = cost.work;
    sum.work += work *= static_cast<double>(times);
}

/// Solids that are within a fifth of each other's size, by the largest of them.
int size_class(const Solid& solid) { return static_cast<int>(4.0 * std::log2(solid.surface.n_vertices())); }

}  // namespace

Cost predict_cost(const SurfaceMesh& surface, const Method& method) {
    try {
        const std::vector<Solid> solids = split_solids(surface);
        return solids.size() > 1 ? predict_cost(solids, method) : method.kind->predict(surface, method);
    } catch (const MeshError&) {  // it faces inward, and has no solids
        return method.kind->predict(surface, method);
    }
}

Cost predict_cost(const std::vector<Solid>& solids, const Method& method) {
    constexpr std::size_t kMostAlone = 64;  // there may be a hundred thousand, and a frame waits
    const std::uint64_t shared = shared_memory(method);
    Cost sum{.memory_bytes = shared};
    if (solids.size() <= kMostAlone) {
        for (const Solid& solid : solids) add(method.kind->predict(solid.surface, method), 1, shared, sum);
        return sum;
    }
    struct Class {
        const Solid* largest = nullptr;
        std::size_t count = 0;
    };
    std::map<int, Class> classes;
    for (const Solid& solid : solids) {
        Class& its = classes[size_class(solid)];
        if (its.largest == nullptr || solid.surface.n_vertices() > its.largest->surface.n_vertices())
            its.largest = &solid;
        ++its.count;
    }
    for (const auto& [size, its] : classes)
        add(method.kind->predict(its.largest->surface, method), its.count, shared, sum);
    return sum;
}

std::string readable_prediction(double seconds) {
    if (!(seconds > 0.0)) return readable_seconds(0.0);
    const double second_digit = std::pow(10.0, std::floor(std::log10(seconds)) - 1.0);
    return readable_seconds(std::round(seconds / second_digit) * second_digit);
}

void require_memory(const Cost& cost, const Method& method) {
    const std::uint64_t available = available_memory_bytes();
    if (cost.memory_bytes <= available) return;
    const std::string_view cheaper = method.mode == Mode::full_volume ? "the mode full"
                                     : method.mode == Mode::full      ? "the mode on-demand"
                                                                      : method.kind->cheaper;
    throw SolveError(std::string(name(method.kind)) + ", mode " + std::string(name(method.mode)) + ": needs " +
                     readable_bytes(static_cast<double>(cost.memory_bytes)) + " of memory, " +
                     readable_bytes(static_cast<double>(available)) + " is available. Choose " + std::string(cheaper) +
                     ".");
}

}  // namespace elastolab
