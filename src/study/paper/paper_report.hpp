#pragma once

#include "study/study.hpp"

namespace elastolab {

/// Which of the paper's claims hold, and the plots of its Figs. 4 to 6.
Conclusions conclude_paper(const Table& table);

}  // namespace elastolab
