#include "python/watch.hpp"

#include <chrono>
#include <exception>
#include <future>
#include <thread>

namespace elastolab::python {

namespace {

constexpr auto kLookEvery = std::chrono::milliseconds(50);

/// What a signal handler or the callback raises; null where nothing is.
std::exception_ptr look(const py::object& progress, const Control& control) {
    try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!progress.is_none()) progress(py::str(control.stage()), py::float_(control.progress()));
    } catch (...) {
        return std::current_exception();
    }
    return nullptr;
}

}  // namespace

void run_watched(const py::object& progress, const std::function<void(Control&)>& work) {
    if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0)
        throw py::type_error("progress: is no function. Give one of a stage and a fraction, or None.");
    Control control;
    std::packaged_task<void()> task([&] { work(control); });
    std::future<void> done = task.get_future();
    std::thread worker(std::move(task));
    const auto ended_within = [&](std::chrono::milliseconds time) {
        const py::gil_scoped_release others;
        return done.wait_for(time) == std::future_status::ready;
    };
    std::exception_ptr raised;
    while (!raised && !ended_within(kLookEvery)) raised = look(progress, control);
    if (raised) control.cancel();
    {
        const py::gil_scoped_release others;
        worker.join();
    }
    if (raised) std::rethrow_exception(raised);
    done.get();
}

}  // namespace elastolab::python
