#include "scene/precompute_job.hpp"

#include "scene/user_text.hpp"

namespace elastolab {

PrecomputeJob::~PrecomputeJob() = default;

void PrecomputeJob::start(Work work) {
    cancel();
    auto ticket = std::make_unique<Ticket>();
    // The worker takes the job before it along and joins that first: the watcher does not wait, and only one computes.
    std::packaged_task<std::shared_ptr<const Model>()> task(
        [before = std::move(ticket_), work = std::move(work), control = &ticket->control]() mutable {
            before.reset();
            control->checkpoint();
            return work(*control);
        });
    ticket->model = task.get_future();
    ticket->thread = std::jthread(std::move(task));
    ticket_ = std::move(ticket);
}

void PrecomputeJob::cancel() {
    if (ticket_) ticket_->control.cancel();
}

PrecomputeJob::Event PrecomputeJob::poll() {
    using namespace std::chrono_literals;
    if (!ticket_ || ticket_->model.wait_for(0s) != std::future_status::ready) return Event::none;
    const std::unique_ptr<Ticket> ticket = std::move(ticket_);
    last_seconds_ = ticket->watch.seconds();
    failure_.clear();
    try {
        std::shared_ptr<const Model> model = ticket->model.get();
        ticket->control.checkpoint();  // a cancel that came too late for the worker still counts
        model_ = std::move(model);
        return Event::finished;
    } catch (const Cancelled&) {
        return Event::cancelled;
    } catch (const std::exception& error) {
        failure_ = user_text(error);
        return Event::failed;
    }
}

}  // namespace elastolab
