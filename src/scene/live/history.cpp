#include "scene/live/history.hpp"

namespace elastolab {

namespace {

/// Enough for an afternoon of edits.
constexpr std::size_t kMaxSteps = 1000;

}  // namespace

void History::commit(const Document& document) {
    if (document == present()) return;
    steps_.resize(present_ + 1);
    if (steps_.size() == kMaxSteps) steps_.erase(steps_.begin());
    steps_.push_back(document);
    present_ = steps_.size() - 1;
}

}  // namespace elastolab
