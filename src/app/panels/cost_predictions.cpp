#include "app/panels/cost_predictions.hpp"

#include <algorithm>
#include <cmath>

#include "base/memory.hpp"

namespace elastolab {

void CostPredictions::measure_program() {
    if (program_bytes_ == 0) program_bytes_ = resident_memory_bytes();
}

Cost CostPredictions::of(const ViewerState& state, const Method& method) {
    const SurfaceMesh* surface = state.simulation.simulated_surface(method.kind, state.scene());
    if (scene_number_ != state.scene_number()) {
        costs_.clear();
        completed_bytes_.clear();
    }
    scene_number_ = state.scene_number();
    if (surface == nullptr) return {};
    measure_others();
    const auto [place, is_new] = costs_.try_emplace({method.kind, method.mode, method.update, method.elements,
                                                     method.rims, surface->n_vertices(), surface->n_triangles()});
    if (is_new) place->second = predict_cost(*surface, method);
    Cost cost = place->second;
    cost.work *= slowdown_;
    return cost;
}

void CostPredictions::measure_others() {
    constexpr double kInterval = 1.0;  // [s]
    if (processors_ && since_.seconds() < kInterval) return;
    const std::optional<ProcessorUse> now = processor_use();
    // In steps: what is told does not flicker.
    if (processors_ && now) slowdown_ = 0.5 * std::round(2.0 * slowdown_by_others(*processors_, *now));
    processors_ = now;
    since_ = Stopwatch();
}

std::uint64_t CostPredictions::memory_with_completion(const ViewerState& state, MethodKind kind) {
    const SurfaceMesh* surface = state.simulation.simulated_surface(kind, state.scene());
    if (surface == nullptr) return 0;
    const std::uint64_t own = of(state, state.choices.of(kind)).memory_bytes;
    const MethodChoices& choices = state.choices;
    const auto [place, is_new] =
        completed_bytes_.try_emplace({kind, choices.mode, choices.update, choices.elements, choices.rims,
                                      choices.complete_up_to, surface->n_vertices(), surface->n_triangles()});
    if (!is_new) return place->second;
    const std::optional<Method> completion = completion_of(*surface, kind, choices);
    return place->second = completion ? std::max(own, of(state, *completion).memory_bytes) : own;
}

std::uint64_t CostPredictions::memory_of_comparison(const ViewerState& state) {
    std::uint64_t sum = program_bytes_;
    for (const MethodKind kind : state.shown_kinds()) {
        const std::uint64_t model = memory_with_completion(state, kind);
        if (model == 0) return 0;
        sum += model + state.simulation.runner(kind).set_memory();
    }
    return sum;
}

}  // namespace elastolab
