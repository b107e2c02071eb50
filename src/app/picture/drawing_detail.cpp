#include "app/picture/drawing_detail.hpp"

#include <algorithm>

namespace elastolab {

namespace {

constexpr double kVerySlow = 4.0;  ///< times kSlowSeconds: worth more than one step

}  // namespace

const std::array<DrawingDetail, DetailKeeper::kLevels>& DetailKeeper::levels() {
    static const std::array<DrawingDetail, kLevels> all = {
        {{},
         {.soft_shadows = false},
         {.soft_shadows = false, .samples = 1},
         {.soft_shadows = false, .wireframe = false, .samples = 1},
         {.soft_shadows = false, .wireframe = false, .samples = 1, .resolution = 0.5},
         {.soft_shadows = false, .wireframe = false, .samples = 1, .resolution = 0.34}}};
    return all;
}

const DrawingDetail& DetailKeeper::choose(bool moved, double now) {
    if (moved) {
        const bool begins = now - last_move_ > kRestSeconds;
        last_move_ = now;
        if (begins && cost_[0] <= kSlowSeconds) while_moving_ = 0;
        if (!begins && cost_[while_moving_] > kSlowSeconds)
            while_moving_ =
                std::min(kLevels - 1, while_moving_ + (cost_[while_moving_] > kVerySlow * kSlowSeconds ? 2 : 1));
        shown_ = while_moving_;
    } else if (now - last_move_ > kRestSeconds) {
        shown_ = 0;
    }
    return levels()[shown_];
}

void DetailKeeper::took(double seconds) { cost_[shown_] = seconds; }

double DetailKeeper::due_in(double now) const {
    return shown_ == 0 ? -1.0 : std::max(0.0, last_move_ + kRestSeconds - now);
}

}  // namespace elastolab
