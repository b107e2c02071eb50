#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "fem/method.hpp"
#include "scene/scene_failure.hpp"
#include "scene/solve.hpp"

namespace elastolab::test {

/// What `solve` answers to a document, once and on demand.
inline Solution solved(const Document& document, MethodKind kind = kFem, bool with_checks = true) {
    Control control;
    return solve({.scene_file = "scene.json",
                  .document = document,
                  .method = {.kind = kind},
                  .solve_once = true,
                  .with_checks = with_checks},
                 control);
}

/// Why the document is refused; "no complaint" where it is not.
inline std::string refusal_of(const Document& document) {
    try {
        solved(document);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no complaint";
}

inline const GroupReaction& named(const std::vector<GroupReaction>& all, const std::string& name) {
    for (const GroupReaction& one : all)
        if (one.name == name) return one;
    throw std::out_of_range(name);
}

}  // namespace elastolab::test
