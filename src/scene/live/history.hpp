#pragma once

#include <cstddef>
#include <deque>

#include "scene/document.hpp"

namespace elastolab {

/// Bytes that a document takes, roughly: its lists of vertices and displacements; meshes are not part of it.
std::size_t bytes_of(const Document& document);

/// The steps that led to a document, for undo and redo. The oldest are forgotten when there are more than a thousand,
/// or when together they take more than `max_bytes`; one step can always be taken back.
class History {
public:
    explicit History(Document start, std::size_t max_bytes = std::size_t{64} << 20);

    /// Ends a step with this document; later steps that were undone are forgotten. One that changed nothing is no step.
    void commit(const Document& document);
    /// Gives the present document, and those that were undone, this method: no step.
    void set_method(MethodKind kind, const MethodSettings& settings);
    bool can_undo() const { return present_ > 0; }
    bool can_redo() const { return present_ + 1 < steps_.size(); }
    /// The document before the last step (requires can_undo), or after the next one (requires can_redo).
    const Document& undo() { return steps_[--present_].document; }
    const Document& redo() { return steps_[++present_].document; }
    const Document& present() const { return steps_[present_].document; }
    /// Those of all steps together, roughly.
    std::size_t bytes() const;

private:
    struct Step {
        Document document;
        std::size_t bytes = 0;
    };
    std::deque<Step> steps_;
    std::size_t present_ = 0, max_bytes_ = 0;
};

}  // namespace elastolab
