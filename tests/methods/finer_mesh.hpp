#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "methods/problem.hpp"
#include "methods/stored_rows.hpp"

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

/// Displacements of the vertices of the coarse mesh by a method on the fine one, stored.
inline Eigen::VectorXd truth_of(const CoarseAndFine& example, const Method& judge) {
    const auto compute = [&] {
        ConstrainedSet set;
        const Eigen::VectorXd values = values_of(example, example.fine, set);
        const Eigen::VectorXd u = displaced(precomputed(make_body(example.fine), judge), set, values);
        Eigen::MatrixXd rows(example.coarse.n_vertices(), 3);
        for (int v = 0; v < example.coarse.n_vertices(); ++v) {
            Eigen::Index same = 0;
            const Eigen::Vector3d x = example.coarse.vertices.col(v);
            EXPECT_LT((example.fine.vertices.colwise() - x).colwise().norm().minCoeff(&same), 1e-9);
            rows.row(v) = u.segment<3>(3 * same);
        }
        return rows;
    };
    std::string what = example.name + " by " + std::string(name(judge.kind));
    if (judge.rims > 0) what += " with " + std::to_string(judge.rims) + " rows";
    const Eigen::MatrixXd rows = stored_rows(what, example.coarse.vertices, 3, compute);
    const Eigen::VectorXd u = rows.transpose().reshaped();
    ConstrainedSet set;
    const Eigen::VectorXd values = values_of(example, example.coarse, set);
    EXPECT_LT((at(u, set.handles) - values).norm(), 1e-5 * values.norm()) << what;
    EXPECT_EQ(at(u, set.fixed).norm(), 0.0) << what;
    return u;
}

/// The largest error of a vertex, over the largest displacement.
inline double error_against(const Eigen::VectorXd& truth, const Eigen::VectorXd& u) {
    return (u - truth).reshaped(3, u.size() / 3).colwise().norm().maxCoeff() /
           truth.reshaped(3, u.size() / 3).colwise().norm().maxCoeff();
}

}  // namespace elastolab::test
