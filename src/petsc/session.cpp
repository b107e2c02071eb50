#include "petsc/session.hpp"

#include <petscsys.h>

#include <array>
#include <cassert>
#include <chrono>
#include <thread>

#include "base/error.hpp"
#include "petsc/check.hpp"
#include "petsc/distributed_system.hpp"
#include "petsc/share_exchange.hpp"

namespace elastolab {

namespace {

Session* the_session = nullptr;

void send(Order order) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(&order, sizeof order, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
}

double reduced(double value, MPI_Op operation) {
    double result = 0.0;
    MPI_Allreduce(&value, &result, 1, MPI_DOUBLE, operation, MPI_COMM_WORLD);
    return result;
}

}  // namespace

Session::Session() {
    assert(the_session == nullptr);
    check(PetscInitializeNoArguments());
    check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr));
    MPI_Comm_rank(MPI_COMM_WORLD, &process_);
    MPI_Comm_size(MPI_COMM_WORLD, &n_processes_);
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &n_here_);
    MPI_Comm_free(&here);
    the_session = this;
}

Session::~Session() {
    if (first()) send(Order{});
    systems_.clear();
    the_session = nullptr;
    PetscFinalize();
}

Session& Session::current() {
    assert(the_session != nullptr);
    return *the_session;
}

/// MPI waits by spinning, on a core that the first process may want while it fills the body with tetrahedra.
Order Session::receive() const {
    Order order;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(&order, sizeof order, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
    auto pause = std::chrono::microseconds(20);
    for (int arrived = 0; arrived == 0;) {
        MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
        if (arrived != 0) break;
        std::this_thread::sleep_for(pause);
        pause = std::min(2 * pause, std::chrono::microseconds(2000));
    }
    return order;
}

void Session::follow(const Order& order) {
    using What = Order::What;
    if (order.what == What::create) {
        create(order.system, {});
    } else if (order.what == What::release) {
        remove(order.system);
    } else {
        system(order.system).follow(order, {});
    }
}

void Session::create(int number, const std::function<Share(int process)>& cut) {
    all_or_none([&] { systems_[number] = std::make_unique<DistributedSystem>(); });
    system(number).assemble(spread_shares(cut));
}

void Session::serve(Control& control) {
    for (Order order = receive(); order.what != Order::What::quit; order = receive()) {
        try {
            carry_out(
                order, [&] { follow(order); }, control);
        } catch (const Cancelled&) {
        } catch (const std::exception&) {  // the first process says it
        }
    }
}

void Session::together(const Order& order, const std::function<void()>& work, Control& control) {
    assert(first());
    control.checkpoint();
    send(order);
    carry_out(order, work, control);
}

/// Throws the same on all processes.
void Session::carry_out(const Order& order, const std::function<void()>& work, const Control& control) {
    control_ = &control;
    std::string failure;
    try {
        work();
    } catch (const Cancelled&) {
    } catch (const std::exception& error) {
        failure = user_text(error);
    }
    failure = agree(failure);
    const bool stopped = cancelled();
    control_ = nullptr;
    if (order.what == Order::What::create && (stopped || !failure.empty())) remove(order.system);
    if (stopped) throw Cancelled{};
    if (!failure.empty()) throw SolveError(failure);
}

void Session::throw_agreed(const std::string& failure) const {
    const std::string agreed = agree(failure);
    if (!agreed.empty()) throw SolveError(agreed);
}

/// The words of the first process that failed, on all; empty: none.
std::string Session::agree(const std::string& failure) const {
    const int mine = failure.empty() ? n_processes_ : process_;
    int worst = 0;
    MPI_Allreduce(&mine, &worst, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (worst == n_processes_) return {};
    std::array<char, 400> text{};
    if (worst == process_) failure.copy(text.data(), text.size() - 1);
    MPI_Bcast(text.data(), static_cast<int>(text.size()), MPI_CHAR, worst, MPI_COMM_WORLD);
    return text.data();
}

bool Session::cancelled() const { return largest(control_ != nullptr && control_->cancelled() ? 1.0 : 0.0) > 0.0; }

double Session::sum(double value) const { return reduced(value, MPI_SUM); }
double Session::least(double value) const { return reduced(value, MPI_MIN); }
double Session::largest(double value) const { return reduced(value, MPI_MAX); }

}  // namespace elastolab
