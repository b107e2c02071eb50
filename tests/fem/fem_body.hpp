#pragma once

#include "base/lapack.hpp"
#include "fem/assembly.hpp"
#include "fem/sparse_cholesky.hpp"
#include "support/tet_box.hpp"

namespace elastolab::test {

/// A jittered box with its stiffness and analysis: what most tests of this folder begin with.
struct FemBody {
    explicit FemBody(const Eigen::Vector3i& cells, const Eigen::Vector3d& size = {1.0, 1.2, 0.8}, double nu = 0.3,
                     double jitter = 0.15)
        : mesh(make_tet_box(cells, size, jitter)),
          K(make_stiffness(mesh, Material{.young_modulus = 2.0, .poisson_ratio = nu})),
          analysis(K) {}

    static SparseMatrix make_stiffness(const TetMesh& mesh, const Material& material) {
        Control control;
        return stiffness(assemble_stiffness_parts(mesh, control), material);
    }
    int n_surface() const { return mesh.n_surface_vertices; }
    std::vector<int> face(int axis, double at) const {
        return vertices_where(mesh.vertices, n_surface(), [&](const Eigen::Vector3d& p) { return p[axis] == at; });
    }

    TetMesh mesh;
    SparseMatrix K;
    CholeskyAnalysis analysis;
};

/// Largest entry of the difference, relative to the largest entry of the truth.
inline double relative_error(const Eigen::MatrixXd& value, const Eigen::MatrixXd& truth) {
    return (value - truth).cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff();
}

/// Textbook Schur complement, dense.
inline Eigen::MatrixXd dense_condensed(const FemBody& body) {
    const Eigen::MatrixXd K(body.K);
    const Eigen::Index n = 3 * body.n_surface(), m = K.rows() - n;
    if (m == 0) return K;
    return K.topLeftCorner(n, n) -
           K.topRightCorner(n, m) * (spd_inverse(K.bottomRightCorner(m, m), "inner part") * K.bottomLeftCorner(m, n));
}

}  // namespace elastolab::test
