#include "base/version.hpp"

namespace elastolab {

const char* version() { return ELASTOLAB_VERSION; }

}  // namespace elastolab
