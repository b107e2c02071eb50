#include <petscksp.h>

#include <cmath>

#include "petsc/check.hpp"
#include "petsc/distributed_system.hpp"

namespace elastolab {

namespace {

/// |K|, which has K's pattern.
Mat sizes_of(Mat K) {
    Mat sizes = nullptr;
    check(MatDuplicate(K, MAT_COPY_VALUES, &sizes));
    Mat parts[2] = {sizes, nullptr};
    PetscBool distributed = PETSC_FALSE;
    check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(sizes), MATMPIAIJ, &distributed));
    if (distributed) check(MatMPIAIJGetSeqAIJ(sizes, &parts[0], &parts[1], nullptr));
    for (Mat part : parts) {
        if (part == nullptr) continue;
        MatInfo info;
        check(MatGetInfo(part, MAT_LOCAL, &info));
        double* values = nullptr;
        check(MatSeqAIJGetArray(part, &values));
        for (PetscInt i = 0; i < static_cast<PetscInt>(info.nz_used); ++i) values[i] = std::abs(values[i]);
        check(MatSeqAIJRestoreArray(part, &values));
    }
    return sizes;
}

template <class T>
void send_all(const T* values, Eigen::Index n, MPI_Datatype type, int process) {
    MPI_Send(values, static_cast<int>(n), type, process, 0, MPI_COMM_WORLD);
}

template <class T>
void receive_all(T* values, Eigen::Index n, MPI_Datatype type) {
    MPI_Recv(values, static_cast<int>(n), type, 0, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

}  // namespace

void send_share(const Share& share, int process) {
    const int sizes[] = {share.n_all,
                         share.first,
                         share.n_own,
                         static_cast<int>(share.nodes.size()),
                         static_cast<int>(share.elements.rows()),
                         static_cast<int>(share.elements.cols())};
    send_all(sizes, 6, MPI_INT, process);
    send_all(&share.poisson_ratio, 1, MPI_DOUBLE, process);
    send_all(share.nodes.data(), std::ssize(share.nodes), MPI_INT, process);
    send_all(share.positions.data(), share.positions.size(), MPI_DOUBLE, process);
    send_all(share.elements.data(), share.elements.size(), MPI_INT, process);
}

Share receive_share() {
    int sizes[6] = {};
    receive_all(sizes, 6, MPI_INT);
    Share share;
    share.n_all = sizes[0];
    share.first = sizes[1];
    share.n_own = sizes[2];
    share.nodes.resize(static_cast<std::size_t>(sizes[3]));
    share.positions.resize(3, sizes[3]);
    share.elements.resize(sizes[4], sizes[5]);
    receive_all(&share.poisson_ratio, 1, MPI_DOUBLE);
    receive_all(share.nodes.data(), std::ssize(share.nodes), MPI_INT);
    receive_all(share.positions.data(), share.positions.size(), MPI_DOUBLE);
    receive_all(share.elements.data(), share.elements.size(), MPI_INT);
    return share;
}

void DistributedSystem::follow(const Order& order, const Parcel& parcel) {
    using What = Order::What;
    switch (order.what) {
        case What::quit:
        case What::create:
        case What::release:
            break;
        case What::eliminate:
            eliminate(shared_nodes(parcel, order.n));
            prepare(order.engine);
            break;
        case What::ground: {
            const std::vector<int> nodes = shared_nodes(parcel, order.n);
            Eigen::Matrix3Xd springs(3, 3 * order.n);
            if (parcel.springs != nullptr) springs = *parcel.springs;
            MPI_Bcast(springs.data(), static_cast<int>(springs.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
            ground(nodes, springs);
            prepare(order.engine);
            break;
        }
        case What::solve:
            solve_columns(parcel, order);
            break;
        case What::multiply:
        case What::multiply_sizes:
            multiply(parcel, order.n, order.what == What::multiply_sizes);
            break;
        case What::diagonal:
            gather_diagonal(parcel);
            break;
    }
}

std::vector<int> DistributedSystem::shared_nodes(const Parcel& parcel, std::int64_t n) const {
    std::vector<int> nodes(static_cast<std::size_t>(n));
    if (parcel.nodes != nullptr) nodes = *parcel.nodes;
    MPI_Bcast(nodes.data(), static_cast<int>(n), MPI_INT, 0, MPI_COMM_WORLD);
    return nodes;
}

void DistributedSystem::scatter(const double* all, Vec v) const {
    double* own = nullptr;
    check(VecGetArray(v, &own));
    MPI_Scatterv(all, counts_.data(), begins_.data(), MPI_DOUBLE, own, 3 * n_own_, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    check(VecRestoreArray(v, &own));
}

void DistributedSystem::gather(Vec v, double* all) const {
    const double* own = nullptr;
    check(VecGetArrayRead(v, &own));
    MPI_Gatherv(own, 3 * n_own_, MPI_DOUBLE, all, counts_.data(), begins_.data(), MPI_DOUBLE, 0, MPI_COMM_WORLD);
    check(VecRestoreArrayRead(v, &own));
}

void DistributedSystem::multiply(const Parcel& parcel, std::int64_t columns, bool sizes) {
    Mat matrix = sizes ? sizes_of(K_) : K_;
    Vec u = make_vector(), f = make_vector();
    for (Eigen::Index column = 0; column < columns; ++column) {
        scatter(parcel.in != nullptr ? parcel.in->col(column).data() : nullptr, u);
        check(MatMult(matrix, u, f));
        gather(f, parcel.out != nullptr ? parcel.out->col(column).data() : nullptr);
    }
    check(VecDestroy(&u));
    check(VecDestroy(&f));
    if (sizes) check(MatDestroy(&matrix));
}

/// Three columns: the rows of each node's block.
void DistributedSystem::gather_diagonal(const Parcel& parcel) {
    Vec column = make_vector();
    for (int axis = 0; axis < 3; ++axis) {
        double* own = nullptr;
        check(VecGetArray(column, &own));
        for (int i = 0; i < n_own_; ++i)
            for (int row = 0; row < 3; ++row) {
                const PetscInt at = 3 * (first_ + i) + row, of = 3 * (first_ + i) + axis;
                check(MatGetValues(K_, 1, &at, 1, &of, own + 3 * i + row));
            }
        check(VecRestoreArray(column, &own));
        gather(column, parcel.out != nullptr ? parcel.out->col(axis).data() : nullptr);
    }
    check(VecDestroy(&column));
}

}  // namespace elastolab
