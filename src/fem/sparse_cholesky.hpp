#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>

#include "base/control.hpp"
#include "base/error.hpp"
#include "fem/sparse_matrix.hpp"

namespace elastolab {

/// Supernodal factor P A P^T = L L^T, for code that works on L itself. Columns super[s] .. super[s+1] form supernode s:
/// a dense column-major block at values[first_value[s]] with rows rows[first_row[s]] .. rows[first_row[s+1]], the first
/// of which are its own columns (the part above its diagonal is not used). Row i of P A P^T is row permutation[i] of A.
struct SupernodalView {
    std::span<const int> permutation, super, first_row, first_value, rows;
    const double* values = nullptr;

    int n_supernodes() const { return static_cast<int>(super.size()) - 1; }
};

/// Fill-reducing ordering and symbolic factorisation of a symmetric pattern: done once, shared by every matrix with
/// that pattern (another material, other eliminated vertices). Immutable; any thread may use it.
class CholeskyAnalysis {
public:
    /// `pattern`: both triangles or the lower one; values are ignored. Rows come in groups of `block` that share their
    /// pattern (three per node), and the ordering (the better of AMD and METIS) is found on the groups, which is
    /// several times faster and as good; a pattern that is not made of groups is still factorised correctly.
    /// keeps: the memory of a factor that is no longer used serves the next one.
    /// Throws SolveError when memory runs out or the factor would exceed 2^31 entries.
    explicit CholeskyAnalysis(const SparseMatrix& pattern, int block = 3, bool keeps = false);
    ~CholeskyAnalysis();
    CholeskyAnalysis(const CholeskyAnalysis&) = delete;
    CholeskyAnalysis& operator=(const CholeskyAnalysis&) = delete;

    int size() const;
    /// Bytes that each factor of this pattern takes.
    std::uint64_t factor_bytes() const;
    /// Where the entries of a factor will be; no values.
    SupernodalView view() const;

private:
    friend class SparseCholesky;
    struct Impl;
    std::unique_ptr<const Impl> impl_;
};

/// A matrix to be factorised is not positive definite.
class NotPositiveDefiniteError : public SolveError {
public:
    using SolveError::SolveError;
};

/// Cholesky factor of a sparse symmetric positive definite matrix (supernodal; CHOLMOD's analysis and solves).
/// Immutable; any thread may solve, also at the same time: each call has a workspace of its own.
class SparseCholesky {
public:
    /// Factorises A, which has the pattern given to `analysis`; only its lower triangle is read.
    /// Throws NotPositiveDefiniteError, naming `name`; SolveError when A is not finite or memory runs out; Cancelled,
    /// where a control is given, within a fraction of a second; it is told the progress.
    SparseCholesky(const CholeskyAnalysis& analysis, const SparseMatrix& A, std::string name,
                   Control* control = nullptr);
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    int size() const;
    /// A^-1 B. Takes twice the memory of B beside the result: give it blocks of some hundred columns.
    /// Throws SolveError when memory runs out or the result is not finite.
    Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const;
    /// Reciprocal condition number in the 1-norm, estimated by a few solves (Higham's method, LAPACK dlacn2).
    double reciprocal_condition() const;
    std::uint64_t memory_bytes() const;
    SupernodalView view() const;

private:
    struct Impl;
    std::unique_ptr<const Impl> impl_;
};

}  // namespace elastolab
