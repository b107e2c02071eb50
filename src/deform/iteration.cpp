#include "deform/iteration.hpp"

#include <string>

#include "base/error.hpp"
#include "base/text.hpp"

namespace elastolab {

void give_up_iteration(const char* name, double residual) {
    throw SolveError(std::string(name) + ": the iteration does not converge (relative residual " +
                     readable_number(residual) + "). Check the mesh for slivers and thin walls, or choose fem.");
}

Eigen::MatrixXd scaled_start(const Eigen::MatrixXd& start, Eigen::Index n_rows, const Eigen::RowVectorXd& size) {
    Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(n_rows, size.cols());
    if (start.size() == 0) return scaled;
    for (Eigen::Index c = 0; c < size.cols(); ++c)
        if (size[c] > 0.0) scaled.col(c) = start.col(c) / size[c];
    return scaled;
}

}  // namespace elastolab
