#pragma once

#include <chrono>
#include <thread>

namespace elastolab::test {

/// Waits until `condition()` holds; false when it does not within a minute, which is far beyond what anything takes
/// that a test waits for, so that a test which waits in vain fails instead of hanging. ASSERT_TRUE(wait_until(...)).
template <class Condition>
bool wait_until(const Condition& condition, std::chrono::seconds at_most = std::chrono::seconds(60)) {
    const auto end = std::chrono::steady_clock::now() + at_most;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

}  // namespace elastolab::test
