#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "deform/deformer.hpp"
#include "deform/model.hpp"
#include "methods/registry.hpp"

namespace elastolab {

/// A body for a study; the surface is one that the program's own checks would pass.
Body study_body(SurfaceMesh surface, const Material& material, std::string name = "body");

/// Large deformations by elements of this degree.
Method nonlinear_method(ElementDegree elements);

/// `count` different numbers below n, ascending; the same for the same seed on every machine.
std::vector<int> choose_numbers(int n, int count, unsigned seed);
/// The same, a share of n, at least 3.
std::vector<int> choose_share(int n, double share, unsigned seed);

template <class Predicate>
std::vector<int> vertices_where(const SurfaceMesh& mesh, Predicate&& wanted) {
    std::vector<int> vertices;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (wanted(Eigen::Vector3d(mesh.vertices.col(v)))) vertices.push_back(v);
    return vertices;
}

/// Values of a field over all vertices (3*n) at some of them.
Eigen::VectorXd values_at(const Eigen::VectorXd& field, std::span<const int> vertices);

/// Three columns: the unit translations of n handle vertices.
Eigen::MatrixXd translation_basis(std::size_t n_vertices);

/// |u - truth| / |truth| over all entries, Euclidean.
double relative_error(const Eigen::VectorXd& u, const Eigen::VectorXd& truth);
/// Largest |u - truth| of a vertex, relative to the largest |truth| of one.
double largest_error(const Eigen::VectorXd& u, const Eigen::VectorXd& truth);

/// The three methods in the order of the paper.
std::vector<MethodKind> paper_methods();
/// "fem", "constant-bem", "linear-bem".
std::string text(MethodKind kind);

}  // namespace elastolab
