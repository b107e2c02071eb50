#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "base/control.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

/// What a poll of a background job found.
enum class JobEvent { none, finished, failed, cancelled };

/// A running computation: its stage, its progress in [0, 1], and for how long it has run.
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
    ~BackgroundJob() {
        cancel();
        const std::lock_guard lock(mutex_);
        next_.reset();
    }

    /// Starts a computation. One that is running is cancelled; the new one begins when it has stopped, so that two
    /// never compete for memory. One that has not begun by then is replaced: however often this is called, there is one
    /// thread and one computation that waits.
    void start(Work work) {
        cancel();
        ticket_ = std::make_shared<Ticket>(std::move(work));
        const std::lock_guard lock(mutex_);
        next_ = ticket_;
        if (worker_runs_) return;
        try {
            worker_ = std::jthread([this] { work_off(); });  // joins the previous thread, which has nothing left to do
            worker_runs_ = true;
        } catch (const std::system_error&) {  // no memory for its stack, or no thread is left to this user
            next_.reset();
            ticket_->promise.set_exception(std::make_exception_ptr(
                Error("no thread can be started for it. Close other programs, and try again.")));
        }
    }

    /// Asks the running computation to stop; it does so at its next checkpoint.
    void cancel() {
        if (ticket_) ticket_->control.cancel();
    }

    /// What has become of the computation, reported once. After `finished` take() gives the result; after `failed`
    /// failure() says why.
    JobEvent poll() {
        if (!ticket_ || working()) return JobEvent::none;
        const std::shared_ptr<Ticket> ticket = std::move(ticket_);
        last_seconds_ = ticket->watch.seconds();
        failure_.clear();
        try {
            Result result = ticket->result.get();
            ticket->control.checkpoint();  // a cancel that came too late for the worker still counts
            result_ = std::move(result);
            return JobEvent::finished;
        } catch (const Cancelled&) {
            return JobEvent::cancelled;
        } catch (const std::exception& error) {
            if (ticket->control.cancelled()) return JobEvent::cancelled;  // nobody waits for it any more
            failure_ = user_text(error);
            return JobEvent::failed;
        }
    }

    bool running() const { return ticket_ != nullptr; }
    /// Whether the worker has not ended yet; changes nothing, unlike poll().
    bool working() const {
        return ticket_ && ticket_->result.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    }
    /// That of the running computation; all zero when there is none.
    JobStatus status() const {
        if (!ticket_) return {};
        return {ticket_->control.stage(), ticket_->control.progress(), ticket_->watch.seconds()};
    }
    /// Seconds that the last computation took.
    double last_seconds() const { return last_seconds_; }

    /// Hands over the result of the last finished computation, so that it lives no longer than its users want.
    /// Default-constructed before the first one and after each call.
    Result take() { return std::exchange(result_, {}); }
    /// Why the last computation failed, for the user; empty when it did not.
    const std::string& failure() const { return failure_; }

private:
    /// One computation, shared by the watcher and the worker.
    struct Ticket {
        explicit Ticket(Work what) : work(std::move(what)), result(promise.get_future()) {}
        /// On the worker. Releases the inputs before the watcher can see the result.
        void run() {
            try {
                Result value = [&] {
                    const Work mine = std::move(work);
                    control.checkpoint();
                    return mine(control);
                }();
                promise.set_value(std::move(value));
            } catch (...) {
                promise.set_exception(std::current_exception());
            }
        }
        Control control;
        Stopwatch watch;
        Work work;
        std::promise<Result> promise;
        std::future<Result> result;
    };

    /// The worker: one computation after the other, until none is left. It ends then, and with it the teams of threads
    /// that OpenMP keeps for it.
    void work_off() {
        while (std::shared_ptr<Ticket> ticket = next()) {
            ticket->run();
            ticket.reset();  // a result that nobody wants any more is gone before the next computation begins
            if (wake_) wake_();
        }
    }
    std::shared_ptr<Ticket> next() {
        const std::lock_guard lock(mutex_);
        if (!next_) worker_runs_ = false;
        return std::exchange(next_, nullptr);
    }

    const std::function<void()> wake_;
    std::shared_ptr<Ticket> ticket_;
    Result result_{};
    std::string failure_;
    double last_seconds_ = 0.0;

    std::mutex mutex_;  ///< for the next two
    std::shared_ptr<Ticket> next_;
    bool worker_runs_ = false;
    std::jthread worker_;  ///< last: it ends before what it uses is destroyed
};

}  // namespace elastolab
