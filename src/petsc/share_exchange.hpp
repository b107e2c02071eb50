#pragma once

#include <functional>

#include "petsc/share.hpp"

namespace elastolab {

/// On all processes, inside an order: the share of each. The first one cuts all of them and sends them, one at a time;
/// `cut` is null elsewhere. Throws SolveError on all where one of them fails.
Share spread_shares(const std::function<Share(int process)>& cut);

}  // namespace elastolab
