#pragma once

#include <petscsys.h>

#include <string>

#include "base/error.hpp"

namespace elastolab {

/// Throws SolveError where a call of PETSc failed. Where it fails on one process alone, Session ends all of them.
inline void check(PetscErrorCode code) {
    if (code == 0) return;
    const char* text = nullptr;
    PetscErrorMessage(code, &text, nullptr);
    throw SolveError("PETSc: " + std::string(text != nullptr ? text : "unknown error") + " (" +
                     std::to_string(static_cast<int>(code)) + "). Take more processes, or a coarser mesh.");
}

}  // namespace elastolab
