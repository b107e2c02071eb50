#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace elastolab {

/// Buffers of zeros for sums of tasks on several threads. A buffer is handed on from task to task: memory that is new
/// for each of them would have its pages cleared by the system again and again. Any thread may call take() and
/// give_back(); a buffer that is not given back, as after an exception, is freed by its owner.
class ZeroBuffers {
public:
    /// `size`: numbers in each buffer.
    explicit ZeroBuffers(std::size_t size) : size_(size) {}

    std::vector<double> take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return std::vector<double>(size_);
        std::vector<double> buffer = std::move(free_.back());
        free_.pop_back();
        return buffer;
    }
    /// `buffer` is all zero again.
    void give_back(std::vector<double> buffer) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(buffer));
    }

private:
    std::mutex mutex_;
    std::size_t size_;
    std::vector<std::vector<double>> free_;
};

}  // namespace elastolab
