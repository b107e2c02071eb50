#pragma once

namespace elastolab {

/// Begins this program anew with the environment and the limits that it has by now, under its own name. Returns only
/// where that fails.
void restart(char** argv);

}  // namespace elastolab
