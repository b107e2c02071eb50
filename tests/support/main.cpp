#include <gtest/gtest.h>

#include "base/blas.hpp"

int main(int argc, char** argv) {
    elastolab::select_blas_kernels(argv);
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
