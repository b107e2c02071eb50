#pragma once

#include <nlohmann/json.hpp>

#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// What reports say of the surface that was simulated in place of the mesh's own; null when there is none.
inline nlohmann::ordered_json proxy_json(const Proxy* proxy) {
    if (proxy == nullptr) return nullptr;
    return {{"vertices", proxy->surface->n_vertices()},
            {"faces", proxy->surface->n_triangles()},
            {"largest_distance", proxy->places.distance.maxCoeff()}};
}

}  // namespace elastolab
