#include "deform/iteration.hpp"

#include <string>

#include "base/error.hpp"

namespace elastolab {

void give_up_iteration(const char* name, double residual) {
    throw SolveError(std::string(name) + ": the iteration does not converge (relative residual " +
                     std::to_string(residual) + "). Check the mesh for slivers and thin walls, or choose fem.");
}

}  // namespace elastolab
