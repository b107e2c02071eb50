#pragma once

#include <functional>
#include <string>
#include <vector>

#include "deform/deformer.hpp"
#include "methods/precompute.hpp"

namespace elastolab {

/// A cube with a fixed face and a handle, and a method.
struct SkipScene {
    SkipScene(MethodKind kind, int cells, Control& control);

    Body body;
    Method method;
    ConstrainedSet set;
    Control& control;

    std::shared_ptr<const Model> model(Method chosen) const { return precompute(body, chosen, control); }
    /// A deformer with the set constrained.
    Deformer ready(std::shared_ptr<const Model> model) const;
};

/// Work that a scene does not need: seconds with the skip, and without it.
struct Skip {
    std::string name, what;
    MethodKind kind;
    std::function<double(const SkipScene&)> with, without;
};

std::vector<Skip> all_skips();

}  // namespace elastolab
