#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace elastolab::test {

/// Displacements by other code, which a script has written (scripts/reference_turns.py).
struct Reference {
    std::vector<Eigen::Vector3d> positions, displacements;
};

/// By the name of its file in tests/methods/references.
inline Reference read_reference(const std::string& name) {
    std::ifstream file(ELASTOLAB_REFERENCES "/" + name);
    EXPECT_TRUE(file) << name;
    Reference reference;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        std::istringstream row(line);
        double number[6] = {};
        for (double& value : number) {
            row >> value;
            row.ignore();
        }
        reference.positions.emplace_back(number[0], number[1], number[2]);
        reference.displacements.emplace_back(number[3], number[4], number[5]);
    }
    return reference;
}

}  // namespace elastolab::test
