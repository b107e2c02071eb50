#include "app/picture/drawing_detail.hpp"

#include <algorithm>

namespace elastolab {

namespace {

/// Steps that a picture of this cost is worth.
std::size_t steps(double seconds) {
    constexpr double kVerySlow = 4.0, kHopeless = 12.0;  // times kSlowSeconds
    const double times = seconds / DetailKeeper::kSlowSeconds;
    return times > kHopeless ? 4 : times > kVerySlow ? 2 : times > 1.0 ? 1 : 0;
}

}  // namespace

const std::array<DrawingDetail, DetailKeeper::kLevels>& DetailKeeper::levels() {
    static const std::array<DrawingDetail, kLevels> all = {
        {{},
         {.soft_shadows = false},
         {.soft_shadows = false, .samples = 1},
         {.soft_shadows = false, .wireframe = false, .samples = 1},
         {.soft_shadows = false, .wireframe = false, .all_triangles = false, .samples = 1},
         {.soft_shadows = false, .wireframe = false, .all_triangles = false, .samples = 1, .resolution = 0.5},
         {.soft_shadows = false, .wireframe = false, .all_triangles = false, .samples = 1, .resolution = 0.34}}};
    return all;
}

const DrawingDetail& DetailKeeper::choose(bool moved, double now, bool may_try) {
    if (is_first_) {
        rest_since_ = now;
        shown_ = while_moving_ = kFirstLevel;
    } else if (moved) {
        const bool begins = now - rest_since_ > kRestSeconds;
        rest_since_ = now;
        const double cost = cost_[while_moving_];
        const bool may_be_quick = may_try && cost_[0] == 0.0 && cost > 0.0 && cost <= kQuickSeconds;
        const bool is_quick = begins && cost_[0] > 0.0 && cost_[0] <= kSlowSeconds;
        if (may_be_quick || is_quick) while_moving_ = 0;
        if (!begins) while_moving_ = std::min(kLevels - 1, while_moving_ + steps(cost_[while_moving_]));
        shown_ = while_moving_;
    } else if (now - rest_since_ > kRestSeconds) {
        shown_ = 0;
    }
    return levels()[shown_];
}

void DetailKeeper::took(double seconds) {
    const bool compiled_shaders = is_first_ && seconds > kQuickSeconds;  // the next one will not
    if (!compiled_shaders) cost_[shown_] = seconds;
    is_first_ = false;
    rest_since_ += seconds;  // a picture that takes longer than a rest is none
}

double DetailKeeper::due_in(double now) const {
    return shown_ == 0 ? -1.0 : std::max(0.0, rest_since_ + kRestSeconds - now);
}

}  // namespace elastolab
