#include "fem/inverse_norm.hpp"

#include <lapacke.h>

#include <vector>

namespace elastolab {

double estimate_inverse_norm(int n, const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& solve) {
    Eigen::VectorXd x(n), v(n);
    std::vector<int> signs(static_cast<std::size_t>(n)), state(3);
    double norm = 0.0;
    for (int request = 0;;) {
        LAPACKE_dlacn2_work(n, v.data(), x.data(), signs.data(), &norm, &request, state.data());
        if (request == 0) return norm;
        x = solve(x);  // A is symmetric, so both of dlacn2's requests are this
    }
}

}  // namespace elastolab
