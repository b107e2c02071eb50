#pragma once

#include <sys/types.h>

#include <fstream>
#include <string>

namespace elastolab::test {

/// Whether a helper program (mesh/input/helper_io.hpp) has begun: until then it is a copy of its caller, which waits
/// for it. The last thing that it sets up is its score, to be killed first when memory runs out.
inline bool helper_has_begun(pid_t helper) {
    int score = 0;
    return std::ifstream("/proc/" + std::to_string(helper) + "/oom_score_adj") >> score && score == 1000;
}

}  // namespace elastolab::test
