#include "scene/live/haptic_loop.hpp"

#include <pthread.h>
#include <sched.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace elastolab {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

constexpr double kFirstBucketNs = 10.0, kWidening = 1.02;
/// Of the real-time range: above ordinary work, below what the system itself needs.
constexpr int kPriority = 50;

bool ask_for_real_time() {
    const sched_param priority{.sched_priority = kPriority};
    return pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority) == 0;
}

}  // namespace

std::shared_ptr<const HapticLoop::Response> HapticLoop::response_of(const GripStiffness& stiffness) {
    assert(stiffness.n_grips() == 1);
    return std::make_shared<const Response>(Response{stiffness.matrix(), stiffness.forces(Eigen::VectorXd::Zero(6))});
}

HapticLoop::HapticLoop(const GripStiffness& stiffness, Read read, Feel feel, int ticks_per_second)
    : read_(std::move(read)),
      feel_(std::move(feel)),
      response_(response_of(stiffness)),
      thread_([this, ticks_per_second] { run(ticks_per_second); }) {}

HapticLoop::~HapticLoop() {
    stop_ = true;
    thread_.join();
}

void HapticLoop::replace(const GripStiffness& stiffness) {
    std::shared_ptr<const Response> response = response_of(stiffness);
    const std::scoped_lock lock(mutex_);
    response_.swap(response);
}

GripPose HapticLoop::pose() const {
    const std::scoped_lock lock(mutex_);
    return pose_;
}

void HapticLoop::run(int ticks_per_second) {
    real_time_ = ask_for_real_time();
    const nanoseconds period(1'000'000'000 / ticks_per_second);
    const Clock::time_point start = Clock::now();
    for (std::uint64_t tick = 0; !stop_; ++tick) {
        const Clock::time_point due = start + tick * period;
        std::this_thread::sleep_until(due);
        const Clock::time_point begin = Clock::now();
        const double seconds = std::chrono::duration<double>(begin - start).count();
        const GripPose pose = read_(seconds);
        const Clock::time_point before = Clock::now();
        std::shared_ptr<const Response> response;
        {
            const std::scoped_lock lock(mutex_);
            response = response_;
            pose_ = pose;
        }
        Vector6 motion;
        motion << pose.shift, pose.turn;
        // The grip exerts this on the body; the hand that holds it feels the opposite.
        const Vector6 exerted = response->rest + response->matrix * motion;
        const FeltForce felt{-exerted.head<3>(), -exerted.tail<3>()};
        const Clock::time_point end = Clock::now();
        feel_(seconds, felt);
        count(begin - due, end - before, period);
        // After a pause longer than a few periods (a suspended machine) it goes on from now, not in a burst.
        while (Clock::now() > start + (tick + 4) * period && !stop_) {
            ++tick;
            ++ticks_;
            ++late_;
        }
    }
}

void HapticLoop::count(nanoseconds lateness, nanoseconds computation, nanoseconds period) {
    ++ticks_;
    if (lateness > period) ++late_;
    worst_ns_ = std::max<std::int64_t>(worst_ns_, lateness.count());
    const double ratio = std::max(1.0, static_cast<double>(computation.count()) / kFirstBucketNs);
    const auto bucket = static_cast<std::size_t>(std::log(ratio) / std::log(kWidening));
    ++buckets_[std::min(bucket, kBuckets - 1)];
}

HapticTimings HapticLoop::timings() const {
    HapticTimings timings{.ticks = ticks_, .late = late_, .worst_lateness_ms = 1e-6 * static_cast<double>(worst_ns_)};
    timings.real_time = real_time_;
    std::uint64_t computed = 0, seen = 0;
    for (const auto& bucket : buckets_) computed += bucket;
    for (std::size_t k = 0; k < kBuckets && computed > 0; ++k) {
        seen += buckets_[k];
        if (static_cast<double>(seen) < 0.999 * static_cast<double>(computed)) continue;
        timings.computation_p999_ms = 1e-6 * kFirstBucketNs * std::pow(kWidening, static_cast<double>(k + 1));
        break;
    }
    return timings;
}

}  // namespace elastolab
