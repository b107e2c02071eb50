#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

#include "base/control.hpp"

namespace elastolab::python {

namespace py = pybind11;

/// Gives the interpreter's lock away for its lifetime. When the interpreter ends meanwhile, it waits: a thread that
/// takes the lock back after the end is ended by force, and with it the process.
class WithoutLock {
public:
    WithoutLock();
    ~WithoutLock();  // NOLINT(bugprone-exception-escape): neither lock fails
    WithoutLock(const WithoutLock&) = delete;
    WithoutLock& operator=(const WithoutLock&) = delete;

private:
    std::optional<py::gil_scoped_release> released_;  ///< nothing once the interpreter ends
};

/// Runs `work` on a thread of its own, without the interpreter's lock. Meanwhile this thread looks for signals, and
/// calls progress(stage, fraction) unless it is None, some twenty times a second. An exception of either, as
/// KeyboardInterrupt, cancels the work and is rethrown once that has stopped; so does the end of the interpreter, with
/// SystemExit.
void run_watched(const py::object& progress, const std::function<void(Control&)>& work);

/// The same for work that returns a value.
template <class Work>
auto watched(const py::object& progress, const Work& work) {
    std::optional<decltype(work(std::declval<Control&>()))> result;
    run_watched(progress, [&](Control& control) { result.emplace(work(control)); });
    return std::move(*result);
}

/// Has all work cancelled when the interpreter ends, which waits for it. To be called once.
void stop_work_at_the_end();

}  // namespace elastolab::python
