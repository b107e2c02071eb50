#include "petsc/share_exchange.hpp"

#include <petscsys.h>

#include <array>

#include "petsc/session.hpp"

namespace elastolab {

namespace {

template <class T>
void send_all(const T* values, Eigen::Index n, MPI_Datatype type, int process) {
    MPI_Send(values, static_cast<int>(n), type, process, 0, MPI_COMM_WORLD);
}

template <class T>
void receive_all(T* values, Eigen::Index n, MPI_Datatype type) {
    MPI_Recv(values, static_cast<int>(n), type, 0, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

/// n_all, first, n_own, nodes, nodes of an element, elements.
using Sizes = std::array<int, 6>;

Sizes sizes_of(const Share& share) {
    return {share.n_all,
            share.first,
            share.n_own,
            static_cast<int>(share.nodes.size()),
            static_cast<int>(share.elements.rows()),
            static_cast<int>(share.elements.cols())};
}

Share with_room_for(const Sizes& sizes) {
    Share share;
    share.n_all = sizes[0];
    share.first = sizes[1];
    share.n_own = sizes[2];
    share.nodes.resize(static_cast<std::size_t>(sizes[3]));
    share.positions.resize(3, sizes[3]);
    share.elements.resize(sizes[4], sizes[5]);
    return share;
}

void send_contents(const Share& share, int process) {
    send_all(&share.poisson_ratio, 1, MPI_DOUBLE, process);
    send_all(share.nodes.data(), std::ssize(share.nodes), MPI_INT, process);
    send_all(share.positions.data(), share.positions.size(), MPI_DOUBLE, process);
    send_all(share.elements.data(), share.elements.size(), MPI_INT, process);
}

void receive_contents(Share& share) {
    receive_all(&share.poisson_ratio, 1, MPI_DOUBLE);
    receive_all(share.nodes.data(), std::ssize(share.nodes), MPI_INT);
    receive_all(share.positions.data(), share.positions.size(), MPI_DOUBLE);
    receive_all(share.elements.data(), share.elements.size(), MPI_INT);
}

}  // namespace

/// What may fail, cutting a share and making room for it, is settled by all before its contents are on the way.
Share spread_shares(const std::function<Share(int process)>& cut) {
    const Session& session = Session::current();
    Share own;
    for (int process = 1; process < session.n_processes(); ++process) {
        const bool mine = session.process() == process;
        Share others;
        session.all_or_none([&] {
            if (session.first()) others = cut(process);
        });
        Sizes sizes = sizes_of(others);
        if (session.first()) send_all(sizes.data(), std::ssize(sizes), MPI_INT, process);
        if (mine) receive_all(sizes.data(), std::ssize(sizes), MPI_INT);
        session.all_or_none([&] {
            if (mine) own = with_room_for(sizes);
        });
        if (session.first()) send_contents(others, process);
        if (mine) receive_contents(own);
    }
    session.all_or_none([&] {
        if (session.first()) own = cut(0);
    });
    return own;
}

}  // namespace elastolab
