#pragma once

#include <cstdint>
#include <iterator>
#include <string>

namespace elastolab::fuzz {

/// Random numbers that are the same with every standard library (splitmix64), so that a seed names an input for ever.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /// Of the input of this number in the run of this seed.
    Random(std::uint64_t seed, std::uint64_t number) : state_(Random(seed).next() + number * 0x9e3779b97f4a7c15ULL) {}

    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }

    /// 0 to n - 1; 0 for an empty range.
    std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(next() % n); }
    /// True once in n times.
    bool once_in(std::size_t n) { return below(n) == 0; }
    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

    template <class Container>
    const auto& pick(const Container& container) {
        return *(std::begin(container) + static_cast<std::ptrdiff_t>(below(std::size(container))));
    }

private:
    std::uint64_t state_;
};

}  // namespace elastolab::fuzz
