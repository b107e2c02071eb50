#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "base/control.hpp"
#include "petsc/share.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

class DistributedSystem;

/// How a stiffness is solved.
///   automatic  by mumps where its own prediction fits into the memory of every process, else by gamg
///   mumps      a distributed Cholesky factor
///   gamg       conjugate gradients, preconditioned by PETSc's algebraic multigrid
enum class Engine { automatic, mumps, gamg };

/// What the first process asks all of them to do together.
struct Order {
    enum class What : int { quit, create, release, eliminate, ground, solve, multiply, multiply_sizes, diagonal };
    What what = What::quit;
    int system = 0;
    std::int64_t n = 0;      ///< columns, or nodes
    double tolerance = 0.0;  ///< of a solve
    Engine engine = Engine::automatic;
};

/// MPI and PETSc, from construction to destruction; one in a program. The first process runs the program and gives
/// orders, the others serve() them. Destroying it on the first process sends the others home.
class Session {
public:
    Session();
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    /// The one that lives (asserted).
    static Session& current();

    int process() const { return process_; }
    int n_processes() const { return n_processes_; }
    bool first() const { return process_ == 0; }
    /// Processes on this one's machine.
    int n_on_this_machine() const { return n_here_; }
    /// Of what is shared evenly by all processes, the part that lies on this machine.
    double part_on_this_machine() const { return static_cast<double>(n_here_) / n_processes_; }

    /// On all processes but the first: follows orders until told to quit. Sleeps while there are none. A cancel of this
    /// process cancels the order that runs, or else the next one.
    void serve(Control& control);
    /// On the first: all processes follow the order, this one by `work`. Throws SolveError when it failed on one of
    /// them, Cancelled when one of them was. A process that failed inside a collective call, while the others wait
    /// there for it, says so and ends the program on all.
    void together(const Order& order, const std::function<void()>& work, Control& control);

    /// On all processes, inside an order or outside of any: does what may fail on one process alone, before the next
    /// collective call, in which the others would wait for ever. Throws SolveError on all where it fails on one.
    template <class Work>
    void all_or_none(const Work& work) const {
        std::string failure;
        try {
            work();
        } catch (const std::exception& error) {
            failure = user_text(error);
        }
        throw_agreed(failure);
    }
    /// On all processes, inside an order: whether the control of one of them was cancelled.
    bool cancelled() const;
    /// On all processes, inside an order or outside of any: sums and least values over processes.
    double sum(double value) const;
    double least(double value) const;
    double largest(double value) const;

    /// On the first: a number for a new system.
    int new_number() { return next_++; }
    /// On all processes, inside an order: makes the system of this number. cut: as in spread_shares().
    void create(int number, const std::function<Share(int process)>& cut);
    void remove(int number) { systems_.erase(number); }
    DistributedSystem& system(int number) const { return *systems_.at(number); }

    Engine engine = Engine::automatic;  ///< that the user asked for

private:
    Order receive() const;
    void follow(const Order& order);
    void carry_out(const Order& order, const std::function<void()>& work, const Control& control);
    std::string agree(const std::string& failure) const;
    void throw_agreed(const std::string& failure) const;

    int process_ = 0, n_processes_ = 1, n_here_ = 1, next_ = 0;
    const Control* control_ = nullptr;
    std::map<int, std::unique_ptr<DistributedSystem>> systems_;
};

}  // namespace elastolab
