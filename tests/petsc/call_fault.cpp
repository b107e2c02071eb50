// Preloaded into a program: on the process ELASTOLAB_FAULT, the symbolic factorisation fails before it begins, so that
// the others wait in it.
#include <dlfcn.h>
#include <petscmat.h>

#include <cstdlib>
#include <cstring>

PetscErrorCode MatCholeskyFactorSymbolic(Mat factor, Mat A, IS ordering, const MatFactorInfo* info) {
    const char* fault = std::getenv("ELASTOLAB_FAULT");
    const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
    if (fault != nullptr && rank != nullptr && std::strcmp(fault, rank) == 0) return PETSC_ERR_LIB;
    const auto real =
        reinterpret_cast<decltype(&MatCholeskyFactorSymbolic)>(dlsym(RTLD_NEXT, "MatCholeskyFactorSymbolic"));
    return real(factor, A, ordering, info);
}
