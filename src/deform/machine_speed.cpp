#include "deform/machine_speed.hpp"

#include <algorithm>
#include <Eigen/Core>
#include <vector>

#include "base/blas.hpp"
#include "base/timer.hpp"
#include "elasticity/triangle_geometry.hpp"
#include "elasticity/triangle_kernels.hpp"

namespace elastolab {

namespace {

/// Seconds of the fastest of some runs: one alone was off by a factor of two from time to time. Done when three are as
/// fast, as on a quiet machine at once.
template <class Run>
double least_seconds(const Run& run) {
    constexpr int kMostRuns = 8, kAgreeing = 3;
    constexpr double kAsFast = 1.1;
    std::vector<double> seconds;
    const auto fastest = [&] { return *std::ranges::min_element(seconds); };
    const auto as_fast = [&](double one) { return one < kAsFast * fastest(); };
    do {
        const Stopwatch watch;
        run();
        seconds.push_back(watch.seconds());
    } while (std::ranges::count_if(seconds, as_fast) < kAgreeing && std::ssize(seconds) < kMostRuns);
    return std::max(fastest(), 1e-6);
}

/// Points a second on one thread; some milliseconds.
double potential_speed(const TriangleKernels& kernels) {
    constexpr int kPoints = 8000;
    const TriangleGeometry triangle =
        make_triangle_geometry(Eigen::Vector3d::Zero(), {1.0, 0.0, 0.0}, {0.2, 0.9, 0.0}, 0);
    SourceLanes sources{};
    for (int i = 0; i < kMaxLanes; ++i) {
        sources.x[i] = 0.3 + 0.1 * i;
        sources.y[i] = 0.2;
        sources.z[i] = 0.5;
        sources.own_triangle[i] = -1.0;
    }
    double sums[kPotentialNumbers * kMaxLanes] = {};
    const double seconds = least_seconds([&] {
        for (int i = 0; i < kPoints / kernels.lanes; ++i)
            kernels.potential(triangle, sources, Potential::with_normals, sums);
    });
    return kPoints / seconds;
}

}  // namespace

/// Of products on all threads at once, each by itself: those of one core share it. Beside other processes one product
/// by all of them would be measured at a half or a third, as its threads wait for each other; one by itself is done
/// within a slice of the scheduler's.
double product_speed() {
    static const double of_a_thread = [] {
        constexpr Eigen::Index n = 256;
        const SerialBlas serial;
        const int n_threads = thread_count();
        double sum = 0.0;
#pragma omp parallel num_threads(n_threads) reduction(+ : sum)
        {
            const Eigen::MatrixXd A = Eigen::MatrixXd::Constant(n, n, 1.0);
            Eigen::MatrixXd B = A;
            sum += 2.0 * n * n * n / least_seconds([&] { B.noalias() = A * A; });
        }
        return sum / n_threads;
    }();
    return of_a_thread * thread_count();
}

double integral_speed() {
    static const double of_a_thread = potential_speed(best_triangle_kernels());
    return of_a_thread * thread_count();
}

double scalar_speed() {
    static const double speed = potential_speed(plain_triangle_kernels());
    return speed;
}

double Work::seconds() const {
    double sum = waiting;
    if (flops > 0.0) sum += flops / product_speed();
    if (integrals > 0.0) sum += integrals / integral_speed();
    if (scalars > 0.0) sum += scalars / scalar_speed();
    return sum;
}

double Work::usual_seconds() const {
    // Measured on two cores with AVX-512; the last roughly, as no choice depends on it yet.
    constexpr double kProducts = 1.7e11, kIntegrals = 1.3e8, kScalars = 1e7;
    return flops / kProducts + integrals / kIntegrals + scalars / kScalars + waiting;
}

Work& Work::operator+=(const Work& other) {
    flops += other.flops;
    integrals += other.integrals;
    scalars += other.scalars;
    waiting += other.waiting;
    return *this;
}

Work& Work::operator*=(double times) {
    for (double* part : {&flops, &integrals, &scalars, &waiting}) *part *= times;
    return *this;
}

}  // namespace elastolab
