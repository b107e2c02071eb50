#include "python/arrays.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

namespace elastolab::python {

namespace {

std::string shape_text(const py::array& array) {
    std::string text = "(";
    for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
    return text + (array.ndim() == 1 ? ",)" : ")");
}

/// What NumPy makes of it, if its elements are of one of these kinds.
py::array array_of(const py::handle& object, const std::string& name, const std::string& kinds, const char* wanted) {
    auto array = py::array::ensure(object);
    if (!array) {
        PyErr_Clear();
        throw py::type_error(name + ": is no array. Give " + wanted + ".");
    }
    if (kinds.find(array.dtype().kind()) == std::string::npos)
        throw py::type_error(name + ": has elements of type " + py::str(array.dtype()).cast<std::string>() + ". Give " +
                             wanted + ".");
    return array;
}

template <class T>
py::array_t<T, py::array::c_style> cast_to(const py::array& array, const std::string& name) {
    auto result = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(array);
    if (!result) {
        PyErr_Clear();
        throw py::type_error(name + ": cannot be made an array of numbers.");
    }
    return result;
}

[[noreturn]] void fail_shape(const py::array& array, const std::string& name, const std::string& wanted) {
    throw py::value_error(name + ": has the shape " + shape_text(array) + ". Give " + wanted + ".");
}

void require_finite(const double* values, py::ssize_t n, const std::string& name) {
    for (py::ssize_t i = 0; i < n; ++i)
        if (!(std::abs(values[i]) <= std::numeric_limits<double>::max()))
            throw py::value_error(name + ": number " + std::to_string(i) + " is not finite. Give finite numbers.");
}

std::string rows_text(Eigen::Index rows) { return rows < 0 ? std::string("n") : std::to_string(rows); }

/// Any integers, as they are; unsigned ones beyond the largest signed one are out of any range.
py::array_t<std::int64_t, py::array::c_style> integer_array(const py::handle& object, const std::string& name) {
    const py::array array = py::array::ensure(object);
    if (array && array.size() == 0)  // an empty list is one of floats
        return py::array_t<std::int64_t>(std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()));
    PyErr_Clear();
    return cast_to<std::int64_t>(array_of(object, name, "iu", "whole numbers"), name);
}

int in_range(std::int64_t value, Eigen::Index n, const std::string& name, const std::string& of = "vertex") {
    if (value < 0 || value >= n)
        throw py::value_error(name + ": " + of + " " + std::to_string(value) + " does not exist; the surface has " +
                              std::to_string(n) + ". Give numbers from 0.");
    return static_cast<int>(value);
}

/// An array on the memory of something that moves into it.
template <class T>
py::array owning(T&& values, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides) {
    auto kept = std::make_unique<T>(std::forward<T>(values));
    const double* data = kept->data();
    const py::capsule owner(kept.release(), [](void* pointer) { delete static_cast<T*>(pointer); });
    return py::array_t<double>(std::move(shape), std::move(strides), data, owner);
}

constexpr py::ssize_t kDouble = sizeof(double);

}  // namespace

py::array_t<double, py::array::c_style> real_array(const py::handle& object, const std::string& name) {
    return cast_to<double>(array_of(object, name, "fiu", "real numbers"), name);
}

Eigen::Matrix3Xd points(const py::handle& object, const std::string& name, Eigen::Index rows) {
    const auto array = real_array(object, name);
    if (array.ndim() != 2 || array.shape(1) != 3 || (rows >= 0 && array.shape(0) != rows))
        fail_shape(array, name, "(" + rows_text(rows) + ", 3)");
    require_finite(array.data(), array.size(), name);
    return Eigen::Map<const Eigen::Matrix3Xd>(array.data(), 3, array.shape(0));
}

Eigen::VectorXd vectors(const py::handle& object, const std::string& name, Eigen::Index rows) {
    const auto array = real_array(object, name);
    const bool is_one = array.ndim() == 1 && array.shape(0) == 3;
    if (!is_one && (array.ndim() != 2 || array.shape(0) != rows || array.shape(1) != 3))
        fail_shape(array, name, "(" + rows_text(rows) + ", 3), or (3,) for all");
    require_finite(array.data(), array.size(), name);
    if (is_one) return Eigen::Map<const Eigen::Vector3d>(array.data()).replicate(rows, 1);
    return Eigen::Map<const Eigen::VectorXd>(array.data(), array.size());
}

Eigen::MatrixXd many_vectors(const py::handle& object, const std::string& name, Eigen::Index rows) {
    const auto array = real_array(object, name);
    const py::ssize_t n = array.ndim();
    if ((n != 2 && n != 3) || array.shape(n - 1) != 3 || array.shape(n - 2) != rows)
        fail_shape(array, name, "(k, " + rows_text(rows) + ", 3)");
    require_finite(array.data(), array.size(), name);
    return Eigen::Map<const Eigen::MatrixXd>(array.data(), 3 * rows, n == 2 ? 1 : array.shape(0));
}

Eigen::VectorXd numbers(const py::handle& object, const std::string& name, Eigen::Index n) {
    const auto array = real_array(object, name);
    if (array.ndim() != 1 || array.shape(0) != n) fail_shape(array, name, "(" + std::to_string(n) + ",)");
    require_finite(array.data(), array.size(), name);
    return Eigen::Map<const Eigen::VectorXd>(array.data(), n);
}

Eigen::Matrix3Xi triangles(const py::handle& object, const std::string& name, Eigen::Index n_vertices) {
    const auto array = integer_array(object, name);
    if (array.size() > 0 && (array.ndim() != 2 || array.shape(1) != 3)) fail_shape(array, name, "(m, 3)");
    Eigen::Matrix3Xi result(3, array.size() / 3);
    for (Eigen::Index i = 0; i < result.size(); ++i) result(i) = in_range(array.data()[i], n_vertices, name);
    return result;
}

std::vector<int> vertex_list(const py::handle& object, const std::string& name, int n, const std::string& of) {
    const auto array = integer_array(object, name);
    if (array.ndim() != 1) fail_shape(array, name, "a list of numbers");
    std::vector<int> result;
    result.reserve(static_cast<std::size_t>(array.size()));
    for (py::ssize_t i = 0; i < array.size(); ++i) result.push_back(in_range(array.data()[i], n, name, of));
    return result;
}

py::array as_rows(const Eigen::MatrixXd& columns) {
    py::array_t<double> array({static_cast<py::ssize_t>(columns.cols()), static_cast<py::ssize_t>(columns.rows())});
    if (columns.size() > 0)
        std::memcpy(array.mutable_data(), columns.data(), sizeof(double) * static_cast<std::size_t>(columns.size()));
    return array;
}

py::array as_vectors(Eigen::VectorXd&& values) {
    const py::ssize_t n = values.size() / 3;
    return owning(std::move(values), {n, 3}, {3 * kDouble, kDouble});
}

py::array as_many_vectors(Eigen::MatrixXd&& columns) {
    const py::ssize_t n = columns.rows() / 3, k = columns.cols();
    return owning(std::move(columns), {k, n, 3}, {3 * n * kDouble, 3 * kDouble, kDouble});
}

py::array as_matrix(Eigen::MatrixXd&& matrix) {
    const py::ssize_t rows = matrix.rows(), cols = matrix.cols();
    return owning(std::move(matrix), {rows, cols}, {kDouble, rows * kDouble});
}

py::array as_numbers(Eigen::VectorXd&& values) {
    const py::ssize_t n = values.size();
    return owning(std::move(values), {n}, {kDouble});
}

py::array as_integers(const Eigen::MatrixXi& columns) {
    py::array_t<int> array({static_cast<py::ssize_t>(columns.cols()), static_cast<py::ssize_t>(columns.rows())});
    if (columns.size() > 0)
        std::memcpy(array.mutable_data(), columns.data(), sizeof(int) * static_cast<std::size_t>(columns.size()));
    return array;
}

py::array as_integers(const std::vector<int>& values) {
    py::array_t<int> array(static_cast<py::ssize_t>(values.size()));
    if (!values.empty()) std::memcpy(array.mutable_data(), values.data(), sizeof(int) * values.size());
    return array;
}

py::array_t<double> output(const py::object& out, std::vector<py::ssize_t> shape) {
    if (out.is_none()) return py::array_t<double>(std::move(shape));
    if (!py::isinstance<py::array_t<double, py::array::c_style>>(out))
        throw py::type_error("out: is no float64 array in C order. Make one by numpy.empty.");
    auto array = py::reinterpret_borrow<py::array_t<double>>(out);
    if (!std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim())) {
        std::string wanted;
        for (const py::ssize_t n : shape) wanted += (wanted.empty() ? "(" : ", ") + std::to_string(n);
        fail_shape(array, "out", wanted + ")");
    }
    if (!array.writeable()) throw py::value_error("out: is read-only. Give an array that may be written.");
    return array;
}

}  // namespace elastolab::python
