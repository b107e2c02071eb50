#pragma once

#include "study/study.hpp"

namespace elastolab {

/// The stability table: for every sweep and method how far it stays right, and what is said beyond.
Conclusions conclude_stability(const Table& table);

}  // namespace elastolab
