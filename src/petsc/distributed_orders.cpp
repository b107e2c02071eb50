#include <cmath>

#include "petsc/distributed_system.hpp"

namespace elastolab {

namespace {

/// |K|, which has K's pattern.
MatHandle sizes_of(Mat K) {
    auto sizes = made<MatHandle>(MatDuplicate, K, MAT_COPY_VALUES);
    Mat parts[2] = {sizes.get(), nullptr};
    PetscBool distributed = PETSC_FALSE;
    check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(sizes.get()), MATMPIAIJ, &distributed));
    if (distributed) check(MatMPIAIJGetSeqAIJ(sizes.get(), &parts[0], &parts[1], nullptr));
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

}  // namespace

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
            Eigen::Matrix3Xd springs;
            Session::current().all_or_none([&] {
                springs.resize(3, 3 * order.n);
                if (parcel.springs != nullptr) springs = *parcel.springs;
            });
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
    std::vector<int> nodes;
    Session::current().all_or_none([&] {
        nodes.resize(static_cast<std::size_t>(n));
        if (parcel.nodes != nullptr) nodes = *parcel.nodes;
    });
    MPI_Bcast(nodes.data(), static_cast<int>(n), MPI_INT, 0, MPI_COMM_WORLD);
    return nodes;
}

void DistributedSystem::scatter(const double* all, Vec v) const {
    double* own = nullptr;
    check(VecGetArray(v, &own));
    MPI_Scatterv(all, counts_.data(), begins_.data(), MPI_DOUBLE, own, 3 * n_own_, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    check(VecRestoreArray(v, &own));
}

void DistributedSystem::gather(const double* own, double* all) const {
    MPI_Gatherv(own, 3 * n_own_, MPI_DOUBLE, all, counts_.data(), begins_.data(), MPI_DOUBLE, 0, MPI_COMM_WORLD);
}

void DistributedSystem::gather(Vec v, double* all) const {
    const double* own = nullptr;
    check(VecGetArrayRead(v, &own));
    gather(own, all);
    check(VecRestoreArrayRead(v, &own));
}

void DistributedSystem::multiply(const Parcel& parcel, std::int64_t columns, bool sizes) {
    const MatHandle of_sizes = sizes ? sizes_of(K_.get()) : MatHandle();
    const VecHandle u = make_vector(), f = make_vector();
    for (Eigen::Index column = 0; column < columns; ++column) {
        scatter(parcel.in != nullptr ? parcel.in->col(column).data() : nullptr, u.get());
        check(MatMult(sizes ? of_sizes.get() : K_.get(), u.get(), f.get()));
        gather(f.get(), parcel.out != nullptr ? parcel.out->col(column).data() : nullptr);
    }
}

/// Three columns: the rows of each node's block.
void DistributedSystem::gather_diagonal(const Parcel& parcel) {
    Eigen::Matrix3Xd column;
    for (int axis = 0; axis < 3; ++axis) {
        Session::current().all_or_none([&] {
            column.resize(3, n_own_);
            for (int i = 0; i < n_own_; ++i) {
                const PetscInt node = 3 * (first_ + i), rows[3] = {node, node + 1, node + 2}, of = node + axis;
                check(MatGetValues(K_.get(), 3, rows, 1, &of, column.col(i).data()));
            }
        });
        gather(column.data(), parcel.out != nullptr ? parcel.out->col(axis).data() : nullptr);
    }
}

}  // namespace elastolab
