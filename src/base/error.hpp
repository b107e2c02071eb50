#pragma once

#include <stdexcept>
#include <string>

namespace elastolab {

/// A problem in the user's data or in a computation on it. The message names the object, the finding and a way
/// forward, in one line. Bugs in our own calls are asserts, not exceptions.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A mesh that cannot be read, is not a solid, or cannot be filled with tetrahedra.
class MeshError : public Error {
public:
    using Error::Error;
};

/// A scene file or a command line that does not describe a scene.
class SceneError : public Error {
public:
    using Error::Error;
};

/// A linear system that is singular, not finite, or too large for the machine.
class SolveError : public Error {
public:
    using Error::Error;
};

/// A matrix that is exactly singular.
class SingularMatrixError : public SolveError {
public:
    using SolveError::SolveError;
};

}  // namespace elastolab
