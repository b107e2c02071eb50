#include "petsc/distributed_system.hpp"

#include <algorithm>
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
    return std::move(parts.lambda);
}

/// Where one process has no memory for its part, all fail.
SparseMatrix own_stiffness(const Share& share) {
    SparseMatrix K;
    std::string failure;
    try {
        if (share.n_own > 0) K = stiffness_of(share);
    } catch (const std::exception& error) {
        failure = error.what();
    }
    failure = Session::current().agree(failure);
    if (!failure.empty()) throw SolveError(failure);
    return K;
}

}  // namespace

DistributedSystem::DistributedSystem(Share share) : n_all_(share.n_all), first_(share.first), n_own_(share.n_own) {
    int begin = 0;
    for (const int count : share.own_counts) {
        counts_.push_back(3 * count);
        begins_.push_back(begin);
        begin += 3 * count;
    }
    assemble(share);
}

DistributedSystem::~DistributedSystem() {
    forget_solver();
    VecDestroy(&coordinates_);
    MatDestroy(&K_);
}

void DistributedSystem::forget_solver() {
    KSPDestroy(&ksp_);
    MatDestroy(&factor_);
    MatDestroy(&A_);
    facts_ = {};
}

/// K is symmetric, so its columns are its rows; those of the process's own nodes follow each other.
void DistributedSystem::assemble(const Share& share) {
    SparseMatrix K = own_stiffness(share);
    const auto own =
        static_cast<int>(std::lower_bound(share.nodes.begin(), share.nodes.end(), first_) - share.nodes.begin());
    const int rows = 3 * n_own_, first_entry = rows > 0 ? K.outerIndexPtr()[3 * own] : 0;
    std::vector<PetscInt> offsets(static_cast<std::size_t>(rows) + 1, 0);
    for (int row = 0; row < rows; ++row)
        offsets[static_cast<std::size_t>(row) + 1] = K.outerIndexPtr()[3 * own + row + 1] - first_entry;
    for (int k = first_entry; k < first_entry + offsets.back(); ++k) {
        int& column = K.innerIndexPtr()[k];
        column = 3 * share.nodes[static_cast<std::size_t>(column / 3)] + column % 3;
    }
    check(MatCreate(PETSC_COMM_WORLD, &K_));
    check(MatSetSizes(K_, rows, rows, 3 * n_all_, 3 * n_all_));
    check(MatSetType(K_, MATAIJ));
    check(MatSetBlockSize(K_, 3));
    const PetscInt* columns = rows > 0 ? K.innerIndexPtr() + first_entry : nullptr;
    const double* values = rows > 0 ? K.valuePtr() + first_entry : nullptr;
    check(MatSeqAIJSetPreallocationCSR(K_, offsets.data(), columns, values));
    check(MatMPIAIJSetPreallocationCSR(K_, offsets.data(), columns, values));
    check(MatSetOption(K_, MAT_SYMMETRIC, PETSC_TRUE));
    K = SparseMatrix();

    coordinates_ = make_vector();
    double* x = nullptr;
    check(VecGetArray(coordinates_, &x));
    for (int i = 0; i < n_own_; ++i) Eigen::Map<Eigen::Vector3d>(x + 3 * i) = share.positions.col(own + i);
    check(VecRestoreArray(coordinates_, &x));
}

void DistributedSystem::attach_rigid_modes(Mat A) const {
    MatNullSpace modes = nullptr;
    check(MatNullSpaceCreateRigidBody(coordinates_, &modes));
    check(MatSetNearNullSpace(A, modes));
    check(MatNullSpaceDestroy(&modes));
}

Vec DistributedSystem::make_vector() const {
    Vec v = nullptr;
    check(VecCreateMPI(PETSC_COMM_WORLD, 3 * n_own_, 3 * n_all_, &v));
    check(VecSetBlockSize(v, 3));
    return v;
}

void DistributedSystem::eliminate(const std::vector<int>& nodes) {
    forget_solver();
    check(MatDuplicate(K_, MAT_COPY_VALUES, &A_));
    std::vector<PetscInt> rows;
    for (const int node : nodes)
        for (int axis = 0; axis < 3 && node >= first_ && node < first_ + n_own_; ++axis)
            rows.push_back(3 * node + axis);
    Vec diagonal = make_vector();
    check(MatGetDiagonal(K_, diagonal));
    check(MatZeroRowsColumns(A_, static_cast<PetscInt>(rows.size()), rows.data(), 1.0, nullptr, nullptr));
    check(MatDiagonalSet(A_, diagonal, INSERT_VALUES));
    check(VecDestroy(&diagonal));
}

void DistributedSystem::ground(const std::vector<int>& nodes, const Eigen::Matrix3Xd& springs) {
    forget_solver();
    check(MatDuplicate(K_, MAT_COPY_VALUES, &A_));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i] < first_ || nodes[i] >= first_ + n_own_) continue;
        const Eigen::Matrix3d spring = springs.middleCols<3>(3 * static_cast<Eigen::Index>(i));
        const PetscInt rows[3] = {3 * nodes[i], 3 * nodes[i] + 1, 3 * nodes[i] + 2};
        check(MatSetValues(A_, 3, rows, 3, rows, spring.data(), ADD_VALUES));  // symmetric
    }
    check(MatAssemblyBegin(A_, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(A_, MAT_FINAL_ASSEMBLY));
}

}  // namespace elastolab
