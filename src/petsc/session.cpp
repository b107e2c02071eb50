#include "petsc/session.hpp"

#include <petscsys.h>

#include <array>
#include <cassert>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <thread>

#include "base/error.hpp"
#include "base/temporary_file.hpp"
#include "cli/complaint.hpp"
#include "petsc/check.hpp"
#include "petsc/distributed_system.hpp"
#include "petsc/share_exchange.hpp"

namespace elastolab {

namespace {

Session* the_session = nullptr;

/// That a process which failed waits for the others [s].
constexpr double kPatienceSeconds = 15.0;

void send(Order order) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(&order, sizeof order, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
}

/// Waits asleep: MPI's own waiting spins, on a core that another process may want.
bool arrives_within(MPI_Request& request, double seconds) {
    using namespace std::chrono;
    const auto end = steady_clock::now() + duration<double>(seconds);
    auto pause = microseconds(20);
    for (int arrived = 0;;) {
        MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
        if (arrived != 0) return true;
        if (steady_clock::now() > end) return false;
        std::this_thread::sleep_for(pause);
        pause = std::min(2 * pause, microseconds(2000));
    }
}

/// Of a failure of this process alone, which the others cannot be told: they wait for it inside a library.
[[noreturn]] void end_all(const std::string& failure) {
    complain(failure, kFailure);
    TemporaryFile::remove_own();
    MPI_Abort(MPI_COMM_WORLD, kFailure);
    std::_Exit(kFailure);
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

/// The first process may take any time in between, and all cores: it fills the body with tetrahedra.
Order Session::receive() const {
    Order order;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(&order, sizeof order, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
    arrives_within(request, std::numeric_limits<double>::infinity());
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

/// The words of the first process that failed, on all; empty: none. A process that failed waits for the others only so
/// long: they may stand in a call of PETSc or MUMPS that it has left.
std::string Session::agree(const std::string& failure) const {
    const int mine = failure.empty() ? n_processes_ : process_;
    int worst = 0;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallreduce(&mine, &worst, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD, &request);
    if (failure.empty())
        MPI_Wait(&request, MPI_STATUS_IGNORE);
    else if (!arrives_within(request, kPatienceSeconds))
        end_all(failure);
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
