#pragma once

#include <chrono>
#include <mutex>
#include <thread>

#include "base/control.hpp"

namespace elastolab {

/// Locks a mutex that another thread may hold for seconds, while it computes what both need. Throws Cancelled within
/// milliseconds of a cancel.
inline std::unique_lock<std::mutex> lock_unless_cancelled(std::mutex& mutex, const Control& control) {
    std::unique_lock lock(mutex, std::try_to_lock);
    while (!lock.owns_lock()) {
        control.checkpoint();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        lock.try_lock();
    }
    return lock;
}

}  // namespace elastolab
