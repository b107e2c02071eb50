#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>

#include "app/viewer_state.hpp"
#include "base/processor_use.hpp"
#include "base/timer.hpp"
#include "findings/cost.hpp"

namespace elastolab {

/// What methods will cost for the scene: predicted once, and longer by as much as other programs take of the processors
/// now.
class CostPredictions {
public:
    /// What the program takes by itself is measured when this is called first.
    void measure_program();

    /// On the proxy, where one is simulated, once it is there; nothing until then.
    Cost of(const ViewerState& state, const Method& method);
    /// What a method's model will take with what is completed by itself [bytes]; 0 where that is not known.
    std::uint64_t memory_with_completion(const ViewerState& state, MethodKind kind);
    /// Of all methods that are compared, and of the program itself, at most [bytes]; 0 where that is not known.
    std::uint64_t memory_of_comparison(const ViewerState& state);

private:
    /// Looks at the processors once a second.
    void measure_others();

    std::uint64_t scene_number_ = 0;
    /// By rims, vertices and triangles of what is simulated.
    std::map<std::tuple<MethodKind, Mode, Update, ElementDegree, int, int, int>, Cost> costs_;
    /// Likewise, and by the vertices up to which methods are completed.
    std::map<std::tuple<MethodKind, Mode, Update, ElementDegree, int, int, int, int>, std::uint64_t> completed_bytes_;
    std::uint64_t program_bytes_ = 0;
    std::optional<ProcessorUse> processors_;  ///< a second ago at most
    Stopwatch since_;                         ///< then
    double slowdown_ = 1.0;
};

}  // namespace elastolab
