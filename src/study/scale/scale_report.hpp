#pragma once

#include "study/study.hpp"

namespace elastolab {

/// Fitted exponents, and predicted beside measured memory and time.
Conclusions conclude_scale(const Table& table);

}  // namespace elastolab
