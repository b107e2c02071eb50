#pragma once

#include <mutex>
#include <string>

#include "base/timer.hpp"

namespace elastolab {

/// How far a study has come.
struct StudyState {
    int n_cases = 0, n_done = 0;
    std::string current;  ///< key of the case that runs
    double fraction = 0.0;
    double seconds_left = -1.0;  ///< below zero: not known yet
};

/// Shared by a running study and whoever watches it; all members may be called from any thread.
class StudyProgress {
public:
    /// `weight` of all cases that have to run; `n_known` of the cases are finished already.
    void begin(int n_cases, int n_known, double weight);
    void begin_case(const std::string& key);
    void end_case(double weight);
    /// The time left follows from the weight done so far and the time it took.
    StudyState state() const;

private:
    mutable std::mutex mutex_;
    StudyState state_;
    double weight_ = 0.0, weight_done_ = 0.0, seconds_at_last_end_ = 0.0;
    Stopwatch watch_;
};

}  // namespace elastolab
