#include <gtest/gtest.h>

#include "base/blas.hpp"

int main(int argc, char** argv) {
    elastolab::prepare_parallel_libraries(argv);
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
