#pragma once

namespace elastolab {

/// Raises the limit of the stack to what OpenBLAS's threaded factorisations need (they put arrays on the stack for
/// every thread that OpenBLAS was built for), as far as the hard limit allows, and starts the program anew so that the
/// threads that libraries make get it, too. To be called first in main; argv as main got it.
/// Throws Error, with the limit and a way forward, where it cannot be raised far enough.
void ensure_stack(char** argv);

}  // namespace elastolab
