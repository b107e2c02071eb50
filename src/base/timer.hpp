#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "base/control.hpp"

namespace elastolab {

/// Wall-clock seconds since its construction.
class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Seconds by stage, in the order in which the stages began.
struct StageTime {
    std::string name;
    double seconds = 0.0;
};
using StageTimes = std::vector<StageTime>;

/// Announces a stage to `control` and appends its duration to `times` when it goes out of scope.
class Stage {
public:
    Stage(const char* name, Control& control, StageTimes& times) : name_(name), times_(times) {
        control.begin_stage(name);
    }
    ~Stage() { times_.push_back({name_, watch_.seconds()}); }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

private:
    const char* name_;
    StageTimes& times_;
    Stopwatch watch_;
};

}  // namespace elastolab
