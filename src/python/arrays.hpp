#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace elastolab::python {

namespace py = pybind11;

// What comes from Python is judged here, once: `name` is that of the argument, for messages. TypeError for what is no
// array of numbers, ValueError for another shape, numbers that are not finite or not in range.

/// Anything that NumPy takes for an array of real numbers.
py::array_t<double, py::array::c_style> real_array(const py::handle& object, const std::string& name);

/// An n x 3 array as 3 x n; n >= 0, or `rows` unless it is negative. All finite.
Eigen::Matrix3Xd points(const py::handle& object, const std::string& name, Eigen::Index rows = -1);

/// An n x 3 array, or three numbers that stand for every row, as 3n numbers, x0 y0 z0 x1 ... All finite.
Eigen::VectorXd vectors(const py::handle& object, const std::string& name, Eigen::Index rows);

/// A k x n x 3 array as 3n x k, an n x 3 array as 3n x 1. All finite.
Eigen::MatrixXd many_vectors(const py::handle& object, const std::string& name, Eigen::Index rows);

/// n finite numbers.
Eigen::VectorXd numbers(const py::handle& object, const std::string& name, Eigen::Index n);

/// An m x 3 array of integers in [0, n_vertices) as 3 x m.
Eigen::Matrix3Xi triangles(const py::handle& object, const std::string& name, Eigen::Index n_vertices);

/// Integers in [0, n): numbers of vertices, or of what `of` says.
std::vector<int> vertex_list(const py::handle& object, const std::string& name, int n,
                             const std::string& of = "vertex");

/// As arrays that own their memory: n x 3 of 3 x n or of 3n numbers, k x n x 3 of 3n x k.
py::array as_rows(const Eigen::MatrixXd& columns);
py::array as_vectors(Eigen::VectorXd&& values);
py::array as_many_vectors(Eigen::MatrixXd&& columns);
py::array as_matrix(Eigen::MatrixXd&& matrix);
py::array as_numbers(Eigen::VectorXd&& values);
py::array as_integers(const Eigen::MatrixXi& columns);
py::array as_integers(const std::vector<int>& values);

/// The memory of `out`: a float64 array of this shape in C order that may be written. None: a new one.
py::array_t<double> output(const py::object& out, std::vector<py::ssize_t> shape);

}  // namespace elastolab::python
