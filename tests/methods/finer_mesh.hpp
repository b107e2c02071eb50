#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "methods/problem.hpp"

namespace elastolab::test {

/// A box held at one part and moved at another, and the same on a finer mesh that has all its vertices.
struct CoarseAndFine {
    std::string name;
    SurfaceMesh coarse, fine;
    std::function<bool(const Eigen::Vector3d&)> held, moved;
    Eigen::Vector3d motion;
};

inline Eigen::VectorXd values_of(const CoarseAndFine& example, const SurfaceMesh& mesh, ConstrainedSet& set) {
    set = {vertices_where(mesh, example.held), vertices_where(mesh, example.moved)};
    return example.motion.replicate(std::ssize(set.handles), 1);
}

/// Displacements of the fine mesh.
inline Eigen::VectorXd truth_of(const CoarseAndFine& example, const Method& judge) {
    ConstrainedSet set;
    const Eigen::VectorXd values = values_of(example, example.fine, set);
    return displaced(precomputed(make_body(example.fine), judge), set, values);
}

/// The largest error of a vertex of the coarse mesh, over the largest displacement, with the fine mesh for the truth.
inline double error_against(const Eigen::VectorXd& truth, const CoarseAndFine& example, const Eigen::VectorXd& u) {
    double worst = 0.0, size = 0.0;
    for (int v = 0; v < example.coarse.n_vertices(); ++v) {
        Eigen::Index same = 0;
        const Eigen::Vector3d x = example.coarse.vertices.col(v);
        EXPECT_LT((example.fine.vertices.colwise() - x).colwise().norm().minCoeff(&same), 1e-9);
        worst = std::max(worst, (u.segment<3>(3 * v) - truth.segment<3>(3 * same)).norm());
        size = std::max(size, truth.segment<3>(3 * same).norm());
    }
    return worst / size;
}

}  // namespace elastolab::test
