#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "methods/reference.hpp"
#include "study/error/organic_truth.hpp"

namespace elastolab::test {

/// What tests ask of a truth.
struct KnownTruth {
    Positions displacements;                            ///< of all vertices
    Eigen::Vector3d support = Eigen::Vector3d::Zero();  ///< sum of the forces at the constrained vertices
    double relative_error = 0.0;                        ///< OrganicTruth's
};

inline void write_truth(const std::string& file, const SurfaceMesh& surface, const KnownTruth& truth) {
    std::ofstream stream(file);
    stream.precision(8);
    stream << "# compute_truth (study/error/organic_truth.hpp), by ELASTOLAB_COMPUTE_TRUTHS=1\n"
           << "# relative error, support\n# x,y,z,ux,uy,uz\n";
    const Eigen::IOFormat row(8, Eigen::DontAlignCols, ",", ",");
    stream << truth.relative_error << ",0,0," << truth.support.transpose().format(row) << "\n";
    for (int v = 0; v < surface.n_vertices(); ++v)
        stream << surface.vertices.col(v).transpose().format(row) << ","
               << truth.displacements.col(v).transpose().format(row) << "\n";
}

/// A truth that takes up to a minute to compute, from its file in tests/methods/references. With the environment
/// variable ELASTOLAB_COMPUTE_TRUTHS set, it is computed anew and written there.
/// compute  returns an OrganicTruth for this surface
template <class Compute>
KnownTruth known_truth(const std::string& name, const SurfaceMesh& surface, const Compute& compute) {
    const std::string file = ELASTOLAB_REFERENCES "/" + name;
    if (std::getenv("ELASTOLAB_COMPUTE_TRUTHS") != nullptr) {
        const OrganicTruth truth = compute();
        write_truth(file, surface, {truth.displacements, truth.reactions.forces.rowwise().sum(), truth.relative_error});
    }
    const Reference reference = read_reference(name);
    KnownTruth known{Positions::Zero(3, surface.n_vertices())};
    if (std::ssize(reference.positions) != surface.n_vertices() + 1) {
        ADD_FAILURE() << name << " is of another mesh: compute it anew with ELASTOLAB_COMPUTE_TRUTHS=1";
        return known;
    }
    known.relative_error = reference.positions[0].x();
    known.support = reference.displacements[0];
    for (int v = 0; v < surface.n_vertices(); ++v) {
        const std::size_t row = static_cast<std::size_t>(v) + 1;
        EXPECT_LT((surface.vertices.col(v) - reference.positions[row]).norm(), 1e-6) << name << ", vertex " << v;
        known.displacements.col(v) = reference.displacements[row];
    }
    return known;
}

}  // namespace elastolab::test
