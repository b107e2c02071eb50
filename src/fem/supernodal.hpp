#pragma once

#include <string>

#include "base/control.hpp"
#include "fem/sparse_cholesky.hpp"
#include "fem/sparse_matrix.hpp"

namespace elastolab {

/// Numeric Cholesky factorisation by supernodes, left-looking: each is updated by those before it that have rows in
/// common, by products of dense blocks. CHOLMOD's own can be neither stopped nor watched, and its threads are those of
/// the BLAS alone, which wait for each other in every call; here independent subtrees of the elimination tree go to
/// different threads, and then the columns of each supernode of the rest. Neither the parts nor the order of sums
/// depend on the number of threads.
/// pattern  where entries go; its values are not looked at
/// A        its lower triangle is read
/// values   room for all entries of the factor; the result
/// Throws NotPositiveDefiniteError, naming `name`, when A is not positive definite; Cancelled within a block product.
void factorise_supernodes(const SupernodalView& pattern, const SparseMatrix& A, double* values, const std::string& name,
                          Control& control);

}  // namespace elastolab
