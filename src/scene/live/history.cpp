#include "scene/live/history.hpp"

#include <numeric>
#include <utility>

namespace elastolab {

namespace {

/// Enough for an afternoon of edits.
constexpr std::size_t kMaxSteps = 1000;

std::size_t bytes_of(const Selector& selector) {
    if (const auto* list = std::get_if<VertexSelector>(&selector.shape)) return list->vertices.size() * sizeof(int);
    std::size_t bytes = 0;
    if (const auto* members = std::get_if<std::vector<Selector>>(&selector.shape))
        for (const Selector& member : *members) bytes += sizeof(Selector) + bytes_of(member);
    return bytes;
}

std::size_t bytes_of(const Handle& handle) {
    std::size_t bytes = sizeof(Handle) + handle.name.size() + bytes_of(handle.select);
    if (const auto* motion = std::get_if<VertexMotion>(&handle.motion))
        bytes += motion->displacements.size() * sizeof(Eigen::Vector3d);
    return bytes;
}

}  // namespace

std::size_t bytes_of(const Document& document) {
    std::size_t bytes = sizeof(Document);
    for (const FixedSet& set : document.fixed) bytes += sizeof(FixedSet) + set.name.size() + bytes_of(set.select);
    for (const Handle& handle : document.handles) bytes += bytes_of(handle);
    for (const Load& load : document.loads) bytes += sizeof(Load) + load.name.size() + bytes_of(load.select);
    return bytes;
}

History::History(Document start, std::size_t max_bytes) : max_bytes_(max_bytes) {
    const std::size_t bytes = bytes_of(start);
    steps_.push_back({std::move(start), bytes});
}

std::size_t History::bytes() const {
    return std::accumulate(steps_.begin(), steps_.end(), std::size_t{0},
                           [](std::size_t sum, const Step& step) { return sum + step.bytes; });
}

void History::set_method(MethodKind kind, const MethodSettings& settings) {
    for (std::size_t i = present_; i < steps_.size(); ++i) {
        steps_[i].document.method = kind;
        steps_[i].document.settings = settings;
    }
}

void History::commit(const Document& document) {
    if (document == present()) return;
    steps_.resize(present_ + 1);
    steps_.push_back({document, bytes_of(document)});
    while (steps_.size() > kMaxSteps || (steps_.size() > 2 && bytes() > max_bytes_)) steps_.pop_front();
    present_ = steps_.size() - 1;
}

}  // namespace elastolab
