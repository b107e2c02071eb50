#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "deform/grip.hpp"

namespace elastolab {

/// Where a grip is, from rest: its middle is shifted, and it is turned about it. turn: axis times angle [rad]. Methods
/// are linear, so that turns count as small ones, however large.
struct GripPose {
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< [L]
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
};

/// What a hand feels that holds the grip: the body's force on the hand, and its moment about the grip's middle.
struct FeltForce {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [force]
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< [force * L]
};

/// How the loop kept its time.
struct HapticTimings {
    std::uint64_t ticks = 0;
    std::uint64_t late = 0;            ///< ticks that began more than a period after they were due
    double worst_lateness_ms = 0.0;    ///< of any tick
    double computation_p999_ms = 0.0;  ///< 99.9 % of the ticks computed no longer than this (to 2 %)
    bool real_time = false;            ///< the system granted real-time priority
};

/// Force feedback: a thread of its own that takes the pose of a handle 1000 times a second and gives back force and
/// moment, as GripStiffness has them: 36 multiplications, no allocation, no lock but where the stiffness is replaced.
/// It does not share the pose with what is drawn; whoever draws reads the last one with pose().
///
/// For a device: `read` returns its pose, `feel` hands it the force; both are called on the loop's thread once a tick,
/// take well under a millisecond and do not throw.
class HapticLoop {
public:
    using Read = std::function<GripPose(double seconds_since_start)>;
    using Feel = std::function<void(double seconds_since_start, const FeltForce&)>;

    /// stiffness: of one grip. Asks the system for real-time priority and goes on without where it is refused.
    HapticLoop(const GripStiffness& stiffness, Read read, Feel feel, int ticks_per_second = 1000);
    /// Ends the thread, at most a tick later.
    ~HapticLoop();
    HapticLoop(const HapticLoop&) = delete;
    HapticLoop& operator=(const HapticLoop&) = delete;

    /// Another stiffness from the next tick on: the constrained set, the loads or the material have changed.
    void replace(const GripStiffness& stiffness);
    /// The pose of the last tick.
    GripPose pose() const;
    HapticTimings timings() const;

private:
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    struct Response {
        Eigen::Matrix<double, 6, 6> matrix;
        Vector6 rest;
    };
    static std::shared_ptr<const Response> response_of(const GripStiffness& stiffness);
    void run(int ticks_per_second);
    void count(std::chrono::nanoseconds lateness, std::chrono::nanoseconds computation,
               std::chrono::nanoseconds period);

    /// Computation times fall into buckets that widen by 2 % each, from 10 ns on.
    static constexpr std::size_t kBuckets = 1024;

    Read read_;
    Feel feel_;
    mutable std::mutex mutex_;  ///< of the two below; held for a copy only
    std::shared_ptr<const Response> response_;
    GripPose pose_;
    std::array<std::atomic<std::uint64_t>, kBuckets> buckets_{};
    std::atomic<std::uint64_t> ticks_ = 0, late_ = 0;
    std::atomic<std::int64_t> worst_ns_ = 0;
    std::atomic<bool> real_time_ = false, stop_ = false;
    std::thread thread_;
};

}  // namespace elastolab
