#include "deform/machine_speed.hpp"

#include <algorithm>
#include <Eigen/Core>
#include <limits>

#include "base/timer.hpp"

namespace elastolab {

double product_speed() {
    static const double speed = [] {
        constexpr Eigen::Index n = 512;
        constexpr int kProducts = 8;  // one alone was off by a factor of two from run to run
        const Eigen::MatrixXd A = Eigen::MatrixXd::Constant(n, n, 1.0);
        Eigen::MatrixXd B = A;
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < kProducts; ++i) {
            const Stopwatch watch;
            B.noalias() = A * A;
            least = std::min(least, watch.seconds());
        }
        return 2.0 * n * n * n / std::max(least, 1e-6);
    }();
    return speed;
}

}  // namespace elastolab
