#include "app/names.hpp"

namespace elastolab {

std::string title(MethodKind kind) { return std::string(kind->label); }

}  // namespace elastolab
