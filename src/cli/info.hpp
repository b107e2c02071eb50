#pragma once

#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "scene/proxy/proxy.hpp"
#include "scene/scene_mesh.hpp"

namespace elastolab {

/// What one method in one mode would cost on the surface that it would simulate; nothing when there is none.
struct MethodCost {
    Method method;
    bool on_proxy = false;
    std::optional<Cost> cost;
};

/// What can be said about a mesh before anything is computed on it.
struct MeshInfo {
    SceneMesh mesh;
    std::shared_ptr<const Proxy> proxy;  ///< that a method would simulate; null when none needs one or none can be made
    std::string proxy_problem;           ///< why none can be made
    std::vector<MethodCost> costs;       ///< every method in every mode that it has
};

/// Makes the proxy when a method needs one, which is all that takes time. Throws Cancelled.
MeshInfo inspect(SceneMesh mesh, const ProxyChoice& choice, Control& control);

/// A table for people.
void print_info(std::ostream& out, const MeshInfo& info);
/// The same as JSON. A number that is not finite becomes null.
void write_info(std::ostream& out, const MeshInfo& info);

}  // namespace elastolab
