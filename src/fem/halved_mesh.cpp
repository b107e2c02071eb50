#include "fem/halved_mesh.hpp"

#include <utility>

namespace elastolab {

QuadraticMesh halved_mesh(TetMesh split, int n_surface_nodes) {
    split.n_surface_vertices = n_surface_nodes;
    return QuadraticMesh(split);
}

SparseMatrix from_whole(const QuadraticMesh& halved, const Eigen::MatrixXi& elements) {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<char> seen(static_cast<std::size_t>(halved.n_nodes()), 0);
    for (Eigen::Index t = 0; t < halved.elements.cols(); ++t)
        for (int i = 0; i < 10; ++i) {
            const int node = halved.elements(i, t);
            if (std::exchange(seen[static_cast<std::size_t>(node)], 1) != 0) continue;
            const Eigen::Vector4d at = in_whole(static_cast<int>(t % 8), node_coordinates(i));
            const Eigen::Matrix<double, 10, 1> shapes = quadratic_shapes(at);
            for (int k = 0; k < 10; ++k)
                for (int axis = 0; axis < 3 && shapes[k] != 0.0; ++axis)
                    entries.emplace_back(3 * node + axis, 3 * elements(k, t / 8) + axis, shapes[k]);
        }
    SparseMatrix P(3 * halved.n_nodes(), 3 * (elements.maxCoeff() + 1));
    P.setFromTriplets(entries.begin(), entries.end());
    return P;
}

Triangles quarters(const Triangles& triangles, const Triangles& midpoints) {
    Triangles fine(3, 4 * triangles.cols());
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        const Eigen::Vector3i v = triangles.col(t), m = midpoints.col(t);
        fine.middleCols<4>(4 * t) << v[0], m[0], m[2], m[0],  //
            m[0], v[1], m[1], m[1],                           //
            m[2], m[1], v[2], m[2];
    }
    return fine;
}

std::vector<UnitLoad> on_quarters(std::span<const UnitLoad> loads) {
    std::vector<UnitLoad> fine(loads.begin(), loads.end());
    for (UnitLoad& load : fine) {
        const std::vector<int> whole = std::exchange(load.triangles, {});
        load.tractions = load.tractions.replicate<4, 1>().reshaped(3, 4 * std::ssize(whole)).eval();
        for (const int t : whole)
            for (int k = 0; k < 4; ++k) load.triangles.push_back(4 * t + k);
    }
    return fine;
}

}  // namespace elastolab
