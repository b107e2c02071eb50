#pragma once

namespace elastolab {

/// Of the program and its libraries, such as "0.2.0".
const char* version();

}  // namespace elastolab
