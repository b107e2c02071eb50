#include "deform/machine_speed.hpp"

#include <algorithm>
#include <Eigen/Core>

#include "base/timer.hpp"

namespace elastolab {

double product_speed() {
    static const double speed = [] {
        constexpr Eigen::Index n = 512;
        const Eigen::MatrixXd A = Eigen::MatrixXd::Constant(n, n, 1.0);
        Eigen::MatrixXd B = A * A;  // wakes the threads
        const Stopwatch watch;
        B.noalias() = A * A;
        return 2.0 * n * n * n / std::max(watch.seconds(), 1e-6);
    }();
    return speed;
}

}  // namespace elastolab
