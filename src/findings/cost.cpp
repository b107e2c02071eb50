#include "findings/cost.hpp"

#include <cmath>
#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"

namespace elastolab {

Cost predict_cost(const SurfaceMesh& surface, const Method& method) { return method.kind->predict(surface, method); }

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
