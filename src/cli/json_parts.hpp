#pragma once

#include <cmath>
#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// null where it is not finite, which JSON cannot say.
inline nlohmann::ordered_json finite_or_null(double value) {
    if (!std::isfinite(value)) return nullptr;
    return value;
}
inline nlohmann::ordered_json vector_json(const Eigen::Vector3d& v) {
    return nlohmann::ordered_json::array({finite_or_null(v.x()), finite_or_null(v.y()), finite_or_null(v.z())});
}

/// What reports say of the surface that was simulated in place of the mesh's own; null when there is none.
inline nlohmann::ordered_json proxy_json(const Proxy* proxy) {
    if (proxy == nullptr) return nullptr;
    return {{"vertices", proxy->surface->n_vertices()},
            {"faces", proxy->surface->n_triangles()},
            {"largest_distance", proxy->places.distance.maxCoeff()},
            {"closed_holes", proxy->n_closed_holes},
            {"open_holes", proxy->n_open_holes}};
}

}  // namespace elastolab
