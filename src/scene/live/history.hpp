#pragma once

#include <vector>

#include "scene/document.hpp"

namespace elastolab {

/// The steps that led to a document, for undo and redo. Documents are small: meshes are not part of them.
class History {
public:
    explicit History(Document start) : steps_{std::move(start)} {}

    /// Ends a step with this document; later steps that were undone are forgotten. A step that changed nothing is none.
    void commit(const Document& document);
    bool can_undo() const { return present_ > 0; }
    bool can_redo() const { return present_ + 1 < steps_.size(); }
    /// The document before the last step (requires can_undo), or after the next one (requires can_redo).
    const Document& undo() { return steps_[--present_]; }
    const Document& redo() { return steps_[++present_]; }
    const Document& present() const { return steps_[present_]; }

private:
    std::vector<Document> steps_;
    std::size_t present_ = 0;
};

}  // namespace elastolab
