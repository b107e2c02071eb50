#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

#include "base/control.hpp"

namespace elastolab::python {

namespace py = pybind11;

/// Runs `work` on a thread of its own, without the interpreter's lock. Meanwhile this thread looks for signals, and
/// calls progress(stage, fraction) unless it is None, some twenty times a second. An exception of either, as
/// KeyboardInterrupt, cancels the work and is rethrown once that has stopped.
void run_watched(const py::object& progress, const std::function<void(Control&)>& work);

/// The same for work that returns a value.
template <class Work>
auto watched(const py::object& progress, const Work& work) {
    std::optional<decltype(work(std::declval<Control&>()))> result;
    run_watched(progress, [&](Control& control) { result.emplace(work(control)); });
    return std::move(*result);
}

}  // namespace elastolab::python
