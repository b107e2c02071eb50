#pragma once

#include <chrono>
#include <stdexcept>
#include <thread>

namespace elastolab::test {

/// Waits until `condition()` holds; false when it does not within a minute, far longer than anything that a test waits
/// for takes, so that a test that waits in vain fails instead of hanging. ASSERT_TRUE(wait_until(...)).
template <class Condition>
bool wait_until(const Condition& condition, std::chrono::seconds at_most = std::chrono::seconds(60)) {
    const auto end = std::chrono::steady_clock::now() + at_most;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

/// The same from where a test cannot be failed: throws instead, which fails it.
template <class Condition>
void wait_for(const Condition& condition, std::chrono::seconds at_most = std::chrono::seconds(300)) {
    if (!wait_until(condition, at_most)) throw std::runtime_error("waited in vain");
}

}  // namespace elastolab::test
