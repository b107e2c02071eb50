#include "python/watch.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <future>
#include <mutex>
#include <set>
#include <thread>

namespace elastolab::python {

namespace {

constexpr auto kLookEvery = std::chrono::milliseconds(50);
/// OpenBLAS never ends a product that was under way in the parent of a fork.
constexpr auto kMostAtTheEnd = std::chrono::seconds(60);

/// What is under way on threads that will need the interpreter's lock again. Whoever changes it holds that lock.
struct UnderWay {
    std::mutex mutex;
    std::condition_variable changed;
    std::set<Control*> watched;
    int n_without_lock = 0;
    bool ending = false;  ///< the interpreter
};

/// Kept for ever: threads may outlive static objects.
UnderWay& under_way() {
    static auto& all = *new UnderWay;
    return all;
}

template <class By>
void change(const By& by) {
    {
        const std::scoped_lock lock(under_way().mutex);
        by(under_way());
    }
    under_way().changed.notify_all();
}

/// While a Control is watched, this thread needs the interpreter's lock again.
class Watched {
public:
    explicit Watched(Control& control) : control_(control) {
        change([&](UnderWay& all) {
            if (all.ending) throw Cancelled{};
            all.watched.insert(&control_);
        });
    }
    ~Watched() {
        change([&](UnderWay& all) { all.watched.erase(&control_); });
    }
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;

private:
    Control& control_;
};

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

void stop_all() {
    change([](UnderWay& all) {
        all.ending = true;
        for (Control* control : all.watched) control->cancel();
    });
    const py::gil_scoped_release others;
    std::unique_lock lock(under_way().mutex);
    under_way().changed.wait_for(lock, kMostAtTheEnd,
                                 [] { return under_way().watched.empty() && under_way().n_without_lock == 0; });
}

/// In a child process no other thread is there.
void forget_all() {
    change([](UnderWay& all) {
        all.watched.clear();
        all.n_without_lock = 0;
    });
}

void watch(const py::object& progress, const std::function<void(Control&)>& work) {
    Control control;
    const Watched watched(control);
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

}  // namespace

WithoutLock::WithoutLock() {
    bool ending = false;
    change([&](UnderWay& all) {
        ending = all.ending;
        all.n_without_lock += ending ? 0 : 1;
    });
    if (!ending) released_.emplace();
}

WithoutLock::~WithoutLock() {  // NOLINT(bugprone-exception-escape)
    if (!released_) return;
    released_.reset();
    change([](UnderWay& all) { --all.n_without_lock; });
}

void run_watched(const py::object& progress, const std::function<void(Control&)>& work) {
    if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0)
        throw py::type_error("progress: is no function. Give one of a stage and a fraction, or None.");
    try {
        watch(progress, work);
    } catch (const Cancelled&) {
        if (!under_way().ending) throw;
        PyErr_SetNone(PyExc_SystemExit);  // ends a thread without a word
        throw py::error_already_set();
    }
}

void stop_work_at_the_end() {
    py::module_::import("atexit").attr("register")(py::cpp_function(&stop_all));
    py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") = py::cpp_function(&forget_all));
}

}  // namespace elastolab::python
