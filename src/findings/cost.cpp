#include "findings/cost.hpp"

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "base/memory.hpp"

namespace elastolab {

namespace {

std::string in_gigabytes(std::uint64_t bytes) {
    std::string text = std::to_string(static_cast<double>(bytes) / 1e9);
    return text.substr(0, text.find('.') + 2) + " GB";
}

}  // namespace

Cost predict_cost(const SurfaceMesh& surface, const Method& method) { return method.kind->predict(surface, method); }

void require_memory(const Cost& cost, const Method& method) {
    const std::uint64_t available = available_memory_bytes();
    if (cost.memory_bytes <= available) return;
    const std::string_view cheaper = method.mode == Mode::full_volume ? "the mode full"
                                     : method.mode == Mode::full      ? "the mode on-demand"
                                                                      : method.kind->cheaper;
    throw SolveError(std::string(name(method.kind)) + ", mode " + std::string(name(method.mode)) + ": needs " +
                     in_gigabytes(cost.memory_bytes) + " of memory, " + in_gigabytes(available) +
                     " is available. Choose " + std::string(cheaper) + ".");
}

}  // namespace elastolab
