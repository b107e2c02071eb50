#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "mesh/surface_mesh.hpp"

namespace elastolab::test {

inline void write_rows(const std::string& file, const Positions& places, const Eigen::MatrixXd& rows) {
    const Eigen::IOFormat comma(6, Eigen::DontAlignCols, ",", ",");
    std::ofstream stream(file);
    stream << "# by ELASTOLAB_COMPUTE_TRUTHS=1\n# x,y,z, then what the test keeps of this vertex\n";
    for (Eigen::Index v = 0; v < places.cols(); ++v)
        stream << places.col(v).transpose().format(comma) << "," << rows.row(v).format(comma) << "\n";
}

/// A truth that takes seconds to compute, from the file of its name in tests/methods/references: a row for each vertex
/// of a surface, in six digits. With the environment variable ELASTOLAB_COMPUTE_TRUTHS set, it is computed anew and
/// written there. compute  returns the rows
template <class Compute>
Eigen::MatrixXd stored_rows(const std::string& name, const Positions& places, Eigen::Index n_columns,
                            const Compute& compute) {
    std::string file = name + ".csv";
    std::ranges::replace(file, ' ', '_');
    file = ELASTOLAB_REFERENCES "/" + file;
    if (std::getenv("ELASTOLAB_COMPUTE_TRUTHS") != nullptr) write_rows(file, places, compute());
    Eigen::MatrixXd rows = Eigen::MatrixXd::Constant(places.cols(), n_columns, std::nan(""));
    std::ifstream stream(file);
    Eigen::Index v = 0;
    for (std::string line; std::getline(stream, line);) {
        if (line.empty() || line.front() == '#') continue;
        std::istringstream numbers(line);
        const auto next = [&] {
            double number = std::nan("");
            numbers >> number;
            numbers.ignore();
            return number;
        };
        Eigen::Vector3d place;
        for (double& x : place) x = next();
        if (v < places.cols()) {
            for (Eigen::Index k = 0; k < n_columns; ++k) rows(v, k) = next();
            EXPECT_LT((places.col(v) - place).norm(), 1e-5 * (1.0 + place.norm())) << name << ", vertex " << v;
        }
        ++v;
    }
    EXPECT_EQ(v, places.cols()) << name << " is of another mesh: compute it anew with ELASTOLAB_COMPUTE_TRUTHS=1";
    EXPECT_TRUE(rows.allFinite()) << name;
    return rows;
}

}  // namespace elastolab::test
