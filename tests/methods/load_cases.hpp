#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "mesh/measures.hpp"
#include "methods/problem.hpp"

namespace elastolab::test {

inline std::vector<int> triangles_where(const SurfaceMesh& mesh,
                                        const std::function<bool(const Eigen::Vector3d&)>& inside) {
    std::vector<int> triangles;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(mesh, t);
        if (inside(p.a) && inside(p.b) && inside(p.c)) triangles.push_back(t);
    }
    return triangles;
}

/// The larger of both, relative.
inline double relative_difference(const Eigen::VectorXd& u, const Eigen::VectorXd& exact) {
    return (u - exact).norm() / exact.norm();
}

inline std::vector<Method> all_linear(Mode mode = Mode::on_demand, Update update = Update::reduced) {
    std::vector<Method> methods = method_variants(mode, update);
    std::erase_if(methods, [](const Method& method) { return !method.kind->linear; });
    return methods;
}

}  // namespace elastolab::test
