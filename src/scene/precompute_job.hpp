#pragma once

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>

#include "base/control.hpp"
#include "base/timer.hpp"
#include "deform/model.hpp"

namespace elastolab {

/// Runs precomputations on a worker thread, one at a time, for a watcher that polls once per frame and never blocks.
/// All members are for the watcher's thread. Destruction cancels and waits for the worker's next checkpoint.
class PrecomputeJob {
public:
    /// What the worker does. It owns its inputs, by value or by pointer to const, and shares nothing but the Control.
    using Work = std::function<std::shared_ptr<const Model>(Control&)>;

    /// What a poll found.
    enum class Event { none, finished, failed, cancelled };

    PrecomputeJob() = default;
    ~PrecomputeJob();
    PrecomputeJob(const PrecomputeJob&) = delete;
    PrecomputeJob& operator=(const PrecomputeJob&) = delete;

    /// Starts a precomputation. One that is running is cancelled; the new one begins when it has stopped, so that two
    /// never compete for memory. The present model stays until the new one is there.
    void start(Work work);

    /// Asks the running precomputation to stop; it does so at its next checkpoint. The present model stays.
    void cancel();

    /// Takes over the result of a precomputation that has ended, once for each. After `finished` model() is the new
    /// one; after `failed` it is still the old one and failure() says why.
    Event poll();

    bool running() const { return ticket_ != nullptr; }
    /// Of the running precomputation: what it is at, how far in [0, 1], and since when.
    const char* stage() const { return ticket_ ? ticket_->control.stage() : ""; }
    double progress() const { return ticket_ ? ticket_->control.progress() : 0.0; }
    /// Seconds since the start of the running precomputation, or that the last one took.
    double elapsed_seconds() const { return ticket_ ? ticket_->watch.seconds() : last_seconds_; }

    /// The last model that was completed; null before the first.
    const std::shared_ptr<const Model>& model() const { return model_; }
    /// Why the last precomputation failed, for the user; empty when it did not.
    const std::string& failure() const { return failure_; }

private:
    /// One precomputation. Its thread is declared last, so that it is joined before what it uses goes.
    struct Ticket {
        ~Ticket() { control.cancel(); }
        Control control;
        Stopwatch watch;
        std::future<std::shared_ptr<const Model>> model;
        std::jthread thread;
    };

    std::unique_ptr<Ticket> ticket_;
    std::shared_ptr<const Model> model_;
    std::string failure_;
    double last_seconds_ = 0.0;
};

}  // namespace elastolab
