// The Python module: what it binds is in the files beside.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <exception>

#include "base/blas.hpp"
#include "base/blas_memory.hpp"
#include "base/control.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "python/deformers.hpp"
#include "python/loads.hpp"
#include "python/models.hpp"
#include "python/scenes.hpp"
#include "python/surfaces.hpp"
#include "python/watch.hpp"

namespace py = pybind11;

namespace {

using namespace elastolab;

/// Those that are registered later are tried first.
void bind_errors(py::module_& module) {
    // Kept for ever: the interpreter ends before static objects do.
    static const py::handle error = py::exception<Error>(module, "Error", PyExc_ValueError).release();
    // NOLINTNEXTLINE(performance-unnecessary-value-param): the type that pybind11 asks for
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const Error& other) {
            PyErr_SetString(error.ptr(), other.what());
        } catch (const Cancelled&) {
            PyErr_SetString(PyExc_KeyboardInterrupt, "");
        }
    });
    py::register_exception<MeshError>(module, "MeshError", error.ptr());
    py::register_exception<SceneError>(module, "SceneError", error.ptr());
    py::register_exception<SolveError>(module, "SolveError", error.ptr());
}

void set_threads(int n) {
    if (n < 1 || n > 1024) throw py::value_error("n: must be from 1 to 1024.");
    static const int n_cores = thread_count();
    set_thread_count(std::min(n, n_cores));
}

}  // namespace

PYBIND11_MODULE(_core, module) {
    module.doc() = "The compiled part of elastolab.";
    reserve_blas_buffers();
    bind_errors(module);
    // Now, under the import's lock: threads that needed it first at once would wait for each other for ever.
    py::detail::npy_api::get();
    python::stop_work_at_the_end();
    python::bind_surfaces(module);
    python::bind_loads(module);
    python::bind_deformers(module);
    python::bind_models(module);
    python::bind_scenes(module);
    module.def("blas_kernels", &blas_kernels, "Name of the BLAS kernels that run, as OpenBLAS calls them.");
    module.def("thread_count", &thread_count);
    module.def("set_threads", &set_threads, py::arg("n"), "At most this many threads, and at most one for each core.");
    module.attr("__version__") = version();
}
