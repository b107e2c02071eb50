#pragma once

#include "study/study.hpp"

namespace elastolab {

/// Observed orders, who is fastest at a given error, and where FEM wins.
Conclusions conclude_error(const Table& table);

}  // namespace elastolab
