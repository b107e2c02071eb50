#include "study/study.hpp"

namespace elastolab {

const std::vector<StudyEntry>& studies() {
    static const std::vector<StudyEntry> all = {
        {"paper", "the paper's Figs. 1, 4, 5 and 6, in its own way and in ours", make_paper_study},
        {"error", "run time against error on problems with known answers, and who is fastest", make_error_study},
        {"stability", "what breaks each method, and what the program says then", make_stability_study},
        {"scale", "time and memory against size, predicted and measured", make_scale_study},
        {"skip", "what each skip of unneeded work saves", make_skip_study},
        {"large", "how far linear theory is off as motions grow", make_large_study},
    };
    return all;
}

}  // namespace elastolab
