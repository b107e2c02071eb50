#pragma once

#include <algorithm>
#include <Eigen/Core>
#include <utility>

#include "base/blas.hpp"

namespace elastolab {

/// Columns of a strip of a matrix of n columns, whatever the number of threads.
inline Eigen::Index strip_width(Eigen::Index n) {
    constexpr Eigen::Index kFewest = 64, kMost = 512, kStrips = 6;
    return std::clamp((n + kStrips - 1) / kStrips, kFewest, kMost);
}

/// Calls use(first, count) for strips of n columns (or rows) on thread_count() threads, BLAS calls in it on the thread
/// of their caller: threads meet once, at the end. Within one BLAS call OpenBLAS's threads meet again and again, and
/// spin; beside as many busy processes as cores each meeting costs slices of the scheduler's, and products of some
/// thousand rows took ten times as long. Strips are the same whatever the number of threads. `use` does not throw.
template <class Use>
void for_strips(Eigen::Index n, Eigen::Index width, Use&& use) {
    const Eigen::Index n_strips = (n + width - 1) / width;
    if (n_strips == 0) return;
    const SerialBlas serial;
    if (n_strips == 1) return use(Eigen::Index{0}, n);
#pragma omp parallel for schedule(dynamic) num_threads(thread_count())
    for (Eigen::Index strip = 0; strip < n_strips; ++strip) use(strip * width, std::min(width, n - strip * width));
}
template <class Use>
void for_strips(Eigen::Index n, Use&& use) {
    for_strips(n, strip_width(n), std::forward<Use>(use));
}

/// The same for the right sides of a system, of which one thread solves for some at once.
template <class Use>
void for_right_sides(Eigen::Index n, Use&& use) {
    for_strips(n, std::min<Eigen::Index>(strip_width(n), 128), std::forward<Use>(use));
}

}  // namespace elastolab
