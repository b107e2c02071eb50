#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "base/control.hpp"
#include "base/timer.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

/// What a poll of a background job found.
enum class JobEvent { none, finished, failed, cancelled };

/// Of a running computation: what it is at, how far in [0, 1], and for how long.
struct JobStatus {
    const char* stage = "";
    double progress = 0.0;
    double seconds = 0.0;
};

/// Runs computations on a worker thread, one at a time, for a watcher that polls once per frame and never blocks.
/// All members are for the watcher's thread. Destruction cancels and waits for the worker's next checkpoint.
template <class Result>
class BackgroundJob {
public:
    /// What the worker does. It owns its inputs, by value or by pointer to const, and shares nothing but the Control.
    using Work = std::function<Result(Control&)>;

    /// `wake` is called by the worker whenever a computation has ended, so that a sleeping watcher polls.
    explicit BackgroundJob(std::function<void()> wake = {}) : wake_(std::move(wake)) {}
    BackgroundJob(const BackgroundJob&) = delete;
    BackgroundJob& operator=(const BackgroundJob&) = delete;

    /// Starts a computation. One that is running is cancelled; the new one begins when that has stopped, so that two
    /// never compete for memory. However often it is called meanwhile, one waits: the last.
    void start(Work work) {
        cancel();
        waiting_ = std::move(work);
        begin_waiting();
    }

    /// Asks the running computation to stop; it does so at its next checkpoint.
    void cancel() {
        if (waiting_) {
            waiting_ = nullptr;
            cancelled_ = true;
        }
        if (ticket_) ticket_->control.cancel();
    }

    /// What has become of the computation, told once. After `finished` take() gives the result; after `failed`
    /// failure() says why.
    JobEvent poll() {
        if (ticket_ && !working()) {
            const std::unique_ptr<Ticket> ticket = std::move(ticket_);
            if (!waiting_) return finish(*ticket);  // else it was cancelled, and nobody waits for it
        }
        begin_waiting();
        return std::exchange(cancelled_, false) && !running() ? JobEvent::cancelled : JobEvent::none;
    }

    bool running() const { return ticket_ || waiting_; }
    /// Whether the worker itself has not ended yet; without a poll().
    bool working() const {
        return ticket_ && ticket_->result.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    }
    /// Of the running computation; all zero when there is none.
    JobStatus status() const {
        if (!ticket_) return {};
        return {ticket_->control.stage(), ticket_->control.progress(), ticket_->watch.seconds()};
    }
    /// Seconds that the last computation took.
    double last_seconds() const { return last_seconds_; }

    /// Gives away the result of the last computation that was finished: what it holds lives no longer than its users
    /// want. As default-constructed before the first and after each call.
    Result take() { return std::exchange(result_, {}); }
    /// Why the last computation failed, for the user; empty when it did not.
    const std::string& failure() const { return failure_; }

private:
    /// One computation. Its thread is declared last, so that it is joined before what it uses goes.
    struct Ticket {
        ~Ticket() { control.cancel(); }
        Control control;
        Stopwatch watch;
        std::future<Result> result;
        std::jthread thread;
    };

    void begin_waiting() {
        if (!waiting_ || ticket_) return;
        cancelled_ = false;
        ticket_ = std::make_unique<Ticket>();
        std::packaged_task<Result()> task([work = std::exchange(waiting_, nullptr), control = &ticket_->control] {
            control->checkpoint();
            return work(*control);
        });
        ticket_->result = task.get_future();
        ticket_->thread = std::jthread([task = std::move(task), wake = wake_]() mutable {
            task();
            if (wake) wake();
        });
    }

    JobEvent finish(Ticket& ticket) {
        last_seconds_ = ticket.watch.seconds();
        failure_.clear();
        cancelled_ = false;
        try {
            Result result = ticket.result.get();
            ticket.control.checkpoint();  // a cancel that came too late for the worker still counts
            result_ = std::move(result);
            return JobEvent::finished;
        } catch (const Cancelled&) {
            return JobEvent::cancelled;
        } catch (const std::exception& error) {
            failure_ = user_text(error);
            return JobEvent::failed;
        }
    }

    std::function<void()> wake_;
    Work waiting_;            ///< begins when the computation that was cancelled for it has ended
    bool cancelled_ = false;  ///< what waited was cancelled, which poll() has not told yet
    std::unique_ptr<Ticket> ticket_;
    Result result_{};
    std::string failure_;
    double last_seconds_ = 0.0;
};

}  // namespace elastolab
