#pragma once

#include <mutex>
#include <utility>

namespace elastolab {

/// Keeps one thing that takes time or memory to make for the next one who needs such. Pointer: owns the thing, and is
/// empty where there is none. Any thread may use it; who finds it empty makes a thing of its own.
template <class Pointer>
class Spare {
public:
    Pointer take() {
        const std::scoped_lock lock(mutex_);
        return std::exchange(kept_, Pointer());
    }
    void give(Pointer thing) {
        const std::scoped_lock lock(mutex_);
        kept_ = std::move(thing);
    }

private:
    std::mutex mutex_;
    Pointer kept_;
};

/// A thing that goes to a Spare at the end of a scope.
template <class Pointer>
class Loan {
public:
    /// make: a thing where there is none
    template <class Make>
    Loan(Spare<Pointer>& spare, const Make& make) : spare_(spare), thing_(spare.take()) {
        if (!thing_) thing_ = make();
    }
    ~Loan() { spare_.give(std::move(thing_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    auto& operator*() const { return *thing_; }

private:
    Spare<Pointer>& spare_;
    Pointer thing_;
};

}  // namespace elastolab
