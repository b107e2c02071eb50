#pragma once

#include <cstdint>

namespace elastolab {

/// What the caller and the helper program elastolab-wrap say to each other over a socket, in the byte order of the
/// machine. Both are built together; `magic` catches a helper of another version.
constexpr std::uint64_t kWrapMagic = 0x656c617374'77'0005;
constexpr std::uint64_t kWrapProgress = 0x656c617374'77'7070;

enum class WrapTask : std::int32_t {
    wrap,         ///< alpha wrap of any triangles
    collapse,     ///< edge collapse of a closed manifold surface
    fill_smooth,  ///< the holes of an oriented manifold surface, with triangles as fine as those around
    fill_flat     ///< the same without further vertices
};

/// Followed by n_vertices x 3 doubles and n_triangles x 3 ints.
struct WrapRequestHeader {
    std::uint64_t magic = kWrapMagic;
    WrapTask task = WrapTask::wrap;
    std::int32_t n_vertices = 0, n_triangles = 0, wanted_vertices = 0;
    std::int32_t known_vertices = 0;  ///< of the wrap with `alpha`, where a number is wanted
    std::int32_t unused = 0;
    double alpha = 0.0;   ///< of a wrap, or where a number of vertices is wanted, of one that is known [L]
    double within = 1.0;  ///< a wrap has wanted_vertices, unless these are 0, within this factor
};

/// Any number of these comes before the reply: how far the work is, in [0, 1].
struct WrapProgress {
    std::uint64_t magic = kWrapProgress;
    double fraction = 0.0;
};

/// Followed by n_vertices x 3 doubles and n_triangles x 3 ints. No triangle: it could not be done.
struct WrapReplyHeader {
    std::uint64_t magic = kWrapMagic;
    std::int32_t n_vertices = 0, n_triangles = 0, n_holes = 0, unused = 0;
    double alpha = 0.0, offset = 0.0;  ///< of a wrap; the distance of its vertices from the surface [L]
};

}  // namespace elastolab
