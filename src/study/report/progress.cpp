#include "study/report/progress.hpp"

#include <algorithm>

namespace elastolab {

void StudyProgress::begin(int n_cases, int n_known, double weight) {
    const std::scoped_lock lock(mutex_);
    state_ = {.n_cases = n_cases, .n_done = n_known, .current = {}};
    weight_ = weight;
    weight_done_ = seconds_at_last_end_ = 0.0;
    watch_ = Stopwatch();
}

void StudyProgress::begin_case(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    state_.current = key;
}

void StudyProgress::end_case(double weight) {
    const std::scoped_lock lock(mutex_);
    ++state_.n_done;
    weight_done_ += weight;
    seconds_at_last_end_ = watch_.seconds();
}

StudyState StudyProgress::state() const {
    const std::scoped_lock lock(mutex_);
    StudyState now = state_;
    now.fraction = weight_ > 0.0 ? weight_done_ / weight_ : 1.0;
    if (weight_done_ > 0.0) {
        const double left = seconds_at_last_end_ * (weight_ - weight_done_) / weight_done_;
        now.seconds_left = std::max(0.0, left - (watch_.seconds() - seconds_at_last_end_));
    }
    return now;
}

}  // namespace elastolab
