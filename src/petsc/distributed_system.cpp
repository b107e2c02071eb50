#include "petsc/distributed_system.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "elasticity/material.hpp"
#include "fem/assembly.hpp"
#include "petsc/check.hpp"

namespace elastolab {

namespace {

/// Of the integrals of a share; the same sum as stiffness() makes, without a third matrix.
SparseMatrix stiffness_of(const Share& share) {
    Control control;
    StiffnessParts parts = assemble_stiffness_parts(share.positions, share.elements, control);
    const Material material{1.0, share.poisson_ratio};
    parts.lambda.coeffs() =
        material.lame_lambda() * parts.lambda.coeffs() + material.shear_modulus() * parts.mu.coeffs();
    SparseMatrix K;
    K.swap(parts.lambda);  // Eigen's sparse matrices are copied where others move
    return K;
}

/// The rows of a process as PETSc takes them: its own ones of K, whose columns have their numbers among all.
struct OwnRows {
    SparseMatrix K;
    int own = 0;          ///< place of its first node in the share
    int first_entry = 0;  ///< in K
    std::vector<PetscInt> offsets;
};

/// K is symmetric, so its columns are its rows; those of the process's own nodes follow each other.
OwnRows own_rows(const Share& share) {
    OwnRows rows;
    if (share.n_own > 0) rows.K = stiffness_of(share);
    rows.own =
        static_cast<int>(std::lower_bound(share.nodes.begin(), share.nodes.end(), share.first) - share.nodes.begin());
    rows.offsets.assign(3 * static_cast<std::size_t>(share.n_own) + 1, 0);
    if (share.n_own == 0) return rows;
    const int* begins = rows.K.outerIndexPtr() + 3 * rows.own;
    rows.first_entry = begins[0];
    for (int row = 0; row < 3 * share.n_own; ++row)
        rows.offsets[static_cast<std::size_t>(row) + 1] = begins[row + 1] - rows.first_entry;
    for (int k = rows.first_entry; k < rows.first_entry + rows.offsets.back(); ++k) {
        int& column = rows.K.innerIndexPtr()[k];
        column = 3 * share.nodes[static_cast<std::size_t>(column / 3)] + column % 3;
    }
    return rows;
}

}  // namespace

void DistributedSystem::forget_solver() {
    ksp_.reset();
    factor_.reset();
    A_.reset();
    facts_ = {};
}

void DistributedSystem::assemble(Share share) {
    n_all_ = share.n_all;
    first_ = share.first;
    n_own_ = share.n_own;
    std::optional<OwnRows> rows;  // even an empty matrix of Eigen allocates
    Session::current().all_or_none([&] {
        for (const int count : share.own_counts) {
            begins_.push_back(begins_.empty() ? 0 : begins_.back() + counts_.back());
            counts_.push_back(3 * count);
        }
        rows = own_rows(share);
    });
    K_ = made<MatHandle>(MatCreate, PETSC_COMM_WORLD);
    check(MatSetSizes(K_.get(), 3 * n_own_, 3 * n_own_, 3 * n_all_, 3 * n_all_));
    check(MatSetType(K_.get(), MATAIJ));
    check(MatSetBlockSize(K_.get(), 3));
    const PetscInt* columns = n_own_ > 0 ? rows->K.innerIndexPtr() + rows->first_entry : nullptr;
    const double* values = n_own_ > 0 ? rows->K.valuePtr() + rows->first_entry : nullptr;
    check(MatSeqAIJSetPreallocationCSR(K_.get(), rows->offsets.data(), columns, values));
    check(MatMPIAIJSetPreallocationCSR(K_.get(), rows->offsets.data(), columns, values));
    check(MatSetOption(K_.get(), MAT_SYMMETRIC, PETSC_TRUE));
    const int own = rows->own;
    rows.reset();

    coordinates_ = make_vector();
    double* x = nullptr;
    check(VecGetArray(coordinates_.get(), &x));
    Eigen::Map<Eigen::Matrix3Xd>(x, 3, n_own_) = share.positions.middleCols(own, n_own_);
    check(VecRestoreArray(coordinates_.get(), &x));
}

void DistributedSystem::attach_rigid_modes(Mat A) const {
    const auto modes = made<NullSpaceHandle>(MatNullSpaceCreateRigidBody, coordinates_.get());
    check(MatSetNearNullSpace(A, modes.get()));
}

VecHandle DistributedSystem::make_vector() const {
    auto v = made<VecHandle>(VecCreateMPI, PETSC_COMM_WORLD, 3 * n_own_, 3 * n_all_);
    check(VecSetBlockSize(v.get(), 3));
    return v;
}

void DistributedSystem::eliminate(const std::vector<int>& nodes) {
    forget_solver();
    std::vector<PetscInt> rows;
    Session::current().all_or_none([&] {
        for (const int node : nodes)
            if (node >= first_ && node < first_ + n_own_)
                rows.insert(rows.end(), {3 * node, 3 * node + 1, 3 * node + 2});
    });
    A_ = made<MatHandle>(MatDuplicate, K_.get(), MAT_COPY_VALUES);
    const VecHandle diagonal = make_vector();
    check(MatGetDiagonal(K_.get(), diagonal.get()));
    check(MatZeroRowsColumns(A_.get(), static_cast<PetscInt>(rows.size()), rows.data(), 1.0, nullptr, nullptr));
    check(MatDiagonalSet(A_.get(), diagonal.get(), INSERT_VALUES));
}

void DistributedSystem::ground(const std::vector<int>& nodes, const Eigen::Matrix3Xd& springs) {
    forget_solver();
    A_ = made<MatHandle>(MatDuplicate, K_.get(), MAT_COPY_VALUES);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i] < first_ || nodes[i] >= first_ + n_own_) continue;
        const Eigen::Matrix3d spring = springs.middleCols<3>(3 * static_cast<Eigen::Index>(i));
        const PetscInt rows[3] = {3 * nodes[i], 3 * nodes[i] + 1, 3 * nodes[i] + 2};
        check(MatSetValues(A_.get(), 3, rows, 3, rows, spring.data(), ADD_VALUES));  // symmetric
    }
    check(MatAssemblyBegin(A_.get(), MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(A_.get(), MAT_FINAL_ASSEMBLY));
}

}  // namespace elastolab
