#pragma once

#include <petscksp.h>

#include <memory>
#include <type_traits>

#include "petsc/check.hpp"

namespace elastolab {

template <class Object, PetscErrorCode (*destroy)(Object*)>
struct PetscDeleter {
    using pointer = Object;
    void operator()(Object object) const { destroy(&object); }
};

/// Owns an object of PETSc, whatever exceptions pass. Collective: of a distributed object, all processes let go
/// together.
template <class Object, PetscErrorCode (*destroy)(Object*)>
using PetscHandle = std::unique_ptr<std::remove_pointer_t<Object>, PetscDeleter<Object, destroy>>;

using VecHandle = PetscHandle<Vec, VecDestroy>;
using MatHandle = PetscHandle<Mat, MatDestroy>;
using KspHandle = PetscHandle<KSP, KSPDestroy>;
using NullSpaceHandle = PetscHandle<MatNullSpace, MatNullSpaceDestroy>;

/// What a function of PETSc makes, whose last argument says where to: made<VecHandle>(VecDuplicate, v). Throws as
/// check() does.
template <class Handle, class Make, class... Arguments>
Handle made(Make make, Arguments... arguments) {
    typename Handle::pointer object = nullptr;
    const PetscErrorCode code = make(arguments..., &object);
    Handle handle(object);
    check(code);
    return handle;
}

}  // namespace elastolab
