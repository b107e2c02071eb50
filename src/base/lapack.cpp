#include "base/lapack.hpp"

#include <lapacke.h>

#include <algorithm>
#include <cassert>

#include "base/blas.hpp"
#include "base/blocked_lu.hpp"
#include "base/error.hpp"
#include "base/strips.hpp"

namespace elastolab {

namespace {

int as_int(Eigen::Index n) { return static_cast<int>(n); }

/// The work array that a LAPACK routine asks for in its query answer.
std::vector<double> work_array(double answer) {
    return std::vector<double>(static_cast<std::size_t>(std::max(1.0, answer)));
}

}  // namespace

LuFactorization::LuFactorization(Eigen::MatrixXd&& A, const std::string& name, Control* control)
    : factors_(std::move(A)) {
    assert(factors_.rows() == factors_.cols());
    const int n = as_int(factors_.rows());
    if (n == 0) return;
    const Eigen::RowVectorXd sums = factors_.cwiseAbs().colwise().sum();
    if (!sums.allFinite())  // the largest of them says nothing: a maximum may pass over NaN
        throw SolveError(name + ": has entries that are not finite. Check the mesh for degenerate triangles.");
    if (const int info = factorise_lu(factors_, pivots_, control); info > 0)
        throw SingularMatrixError(name + ": is singular (pivot " + std::to_string(info) + " of " + std::to_string(n) +
                                  " vanishes). Check the mesh for degenerate or duplicate parts.");
    const double norm = sums.maxCoeff();
    std::vector<double> work(4 * static_cast<std::size_t>(n));
    std::vector<int> iwork(static_cast<std::size_t>(n));
    const SerialBlas serial;
    LAPACKE_dgecon_work(LAPACK_COL_MAJOR, '1', n, factors_.data(), n, norm, &reciprocal_condition_, work.data(),
                        iwork.data());
}

void LuFactorization::solve_in_place(Eigen::Ref<Eigen::MatrixXd> B) const {
    assert(B.rows() == factors_.rows());
    if (factors_.size() == 0 || B.cols() == 0) return;
    const Eigen::Index stride = B.outerStride();
    for_right_sides(B.cols(), [&](Eigen::Index first, Eigen::Index count) {
        LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', as_int(size()), as_int(count), factors_.data(), as_int(size()),
                            pivots_.data(), B.data() + first * stride, as_int(stride));
    });
}

Eigen::MatrixXd LuFactorization::solve(Eigen::MatrixXd B) const {
    solve_in_place(B);
    return B;
}

Eigen::MatrixXd LuFactorization::inverse() && {
    const int n = as_int(size());
    if (n == 0) return {};
    double answer = 0.0;
    LAPACKE_dgetri_work(LAPACK_COL_MAJOR, n, factors_.data(), n, pivots_.data(), &answer, -1);
    std::vector<double> work = work_array(answer);
    LAPACKE_dgetri_work(LAPACK_COL_MAJOR, n, factors_.data(), n, pivots_.data(), work.data(), as_int(std::ssize(work)));
    return std::move(factors_);
}

Eigen::MatrixXd spd_inverse(Eigen::MatrixXd A, const std::string& name) {
    assert(A.rows() == A.cols());
    const int n = as_int(A.rows());
    if (n == 0) return A;
    if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, A.data(), n) != 0)
        throw SolveError(name + ": is not positive definite. Check the mesh for degenerate tetrahedra.");
    LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'L', n, A.data(), n);
    A.triangularView<Eigen::StrictlyUpper>() = A.transpose();
    return A;
}

MinimumNormSolution solve_minimum_norm(Eigen::MatrixXd A, Eigen::MatrixXd B, double rank_tolerance) {
    assert(A.rows() == B.rows());
    const int m = as_int(A.rows()), n = as_int(A.cols()), n_rhs = as_int(B.cols());
    B.conservativeResizeLike(Eigen::MatrixXd::Zero(std::max(m, n), n_rhs));
    std::vector<int> pivots(static_cast<std::size_t>(n), 0);
    MinimumNormSolution solution;
    double answer = 0.0;
    const auto call = [&](double* work, int size) {
        LAPACKE_dgelsy_work(LAPACK_COL_MAJOR, m, n, n_rhs, A.data(), m, B.data(), as_int(B.rows()), pivots.data(),
                            rank_tolerance, &solution.rank, work, size);
    };
    call(&answer, -1);
    std::vector<double> work = work_array(answer);
    call(work.data(), as_int(std::ssize(work)));
    solution.X = B.topRows(n);
    return solution;
}

QrFactorization::QrFactorization(Eigen::MatrixXd A)
    : reflectors_(std::move(A)), scales_(std::min(reflectors_.rows(), reflectors_.cols())) {
    const int m = as_int(reflectors_.rows()), n = as_int(reflectors_.cols());
    if (scales_.size() == 0) return;
    double answer = 0.0;
    LAPACKE_dgeqrf_work(LAPACK_COL_MAJOR, m, n, reflectors_.data(), m, scales_.data(), &answer, -1);
    std::vector<double> work = work_array(answer);
    LAPACKE_dgeqrf_work(LAPACK_COL_MAJOR, m, n, reflectors_.data(), m, scales_.data(), work.data(),
                        as_int(std::ssize(work)));
}

Eigen::MatrixXd QrFactorization::R() const {
    return reflectors_.topRows(scales_.size()).triangularView<Eigen::Upper>();
}

Eigen::MatrixXd QrFactorization::times_Q(const Eigen::MatrixXd& B) const {
    assert(B.rows() == scales_.size());
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(reflectors_.rows(), B.cols());
    product.topRows(B.rows()) = B;
    if (product.size() == 0 || scales_.size() == 0) return product;
    const int m = as_int(product.rows()), n = as_int(product.cols()), k = as_int(scales_.size());
    double answer = 0.0;
    LAPACKE_dormqr_work(LAPACK_COL_MAJOR, 'L', 'N', m, n, k, reflectors_.data(), m, scales_.data(), product.data(), m,
                        &answer, -1);
    std::vector<double> work = work_array(answer);
    LAPACKE_dormqr_work(LAPACK_COL_MAJOR, 'L', 'N', m, n, k, reflectors_.data(), m, scales_.data(), product.data(), m,
                        work.data(), as_int(std::ssize(work)));
    return product;
}

SingularValues singular_values(Eigen::MatrixXd A) {
    const int m = as_int(A.rows()), n = as_int(A.cols()), k = std::min(m, n);
    if (k == 0) return {Eigen::MatrixXd(m, 0), Eigen::VectorXd(0), Eigen::MatrixXd(n, 0)};
    // dgesdd may not return from entries that are not finite.
    if (!A.allFinite()) throw SolveError("singular values: of a matrix with entries that are not finite.");
    Eigen::MatrixXd U(m, k), Vt(k, n);
    Eigen::VectorXd sigma(k);
    std::vector<int> iwork(8 * static_cast<std::size_t>(k));
    double answer = 0.0;
    LAPACKE_dgesdd_work(LAPACK_COL_MAJOR, 'S', m, n, A.data(), m, sigma.data(), U.data(), m, Vt.data(), k, &answer, -1,
                        iwork.data());
    std::vector<double> work = work_array(answer);
    if (LAPACKE_dgesdd_work(LAPACK_COL_MAJOR, 'S', m, n, A.data(), m, sigma.data(), U.data(), m, Vt.data(), k,
                            work.data(), as_int(std::ssize(work)), iwork.data()) != 0)
        throw SolveError("singular values: the iteration does not converge.");
    return {std::move(U), std::move(sigma), Vt.transpose()};
}

SymmetricEigen symmetric_eigen(Eigen::MatrixXd A) {
    assert(A.rows() == A.cols());
    const int n = as_int(A.rows());
    Eigen::VectorXd values(n);
    if (n == 0) return {std::move(values), std::move(A)};
    if (!A.allFinite()) throw SolveError("eigenvalues: of a matrix with entries that are not finite.");
    double answer = 0.0;
    int integers = 0;
    LAPACKE_dsyevd_work(LAPACK_COL_MAJOR, 'V', 'L', n, A.data(), n, values.data(), &answer, -1, &integers, -1);
    std::vector<double> work = work_array(answer);
    std::vector<int> iwork(static_cast<std::size_t>(std::max(1, integers)));
    if (LAPACKE_dsyevd_work(LAPACK_COL_MAJOR, 'V', 'L', n, A.data(), n, values.data(), work.data(),
                            as_int(std::ssize(work)), iwork.data(), as_int(std::ssize(iwork))) != 0)
        throw SolveError("eigenvalues: the iteration does not converge.");
    return {std::move(values), std::move(A)};
}

Eigen::VectorXd real_parts_of_eigenvalues(Eigen::MatrixXd A) {
    assert(A.rows() == A.cols());
    const int n = as_int(A.rows());
    Eigen::VectorXd real(n), imaginary(n);
    if (n == 0) return real;
    if (!A.allFinite()) throw SolveError("eigenvalues: of a matrix with entries that are not finite.");
    double answer = 0.0;
    const auto run = [&](double* work, int size) {
        return LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'N', n, A.data(), n, real.data(), imaginary.data(), nullptr, 1,
                                  nullptr, 1, work, size);
    };
    run(&answer, -1);
    std::vector<double> work = work_array(answer);
    if (run(work.data(), as_int(std::ssize(work))) != 0)
        throw SolveError("eigenvalues: the iteration does not converge.");
    std::sort(real.begin(), real.end());
    return real;
}

}  // namespace elastolab
