#pragma once

#include <array>
#include <cstdint>

namespace elastolab {

/// What tetrahedralize() and the helper program elastolab-tetgen say to each other over a socket, in the byte order of
/// the machine. Both are built together; `magic` catches a helper of another version.
constexpr std::uint64_t kTetgenMagic = 0x656c61737465'0004;

/// Followed by n_vertices x 3 doubles, n_triangles x 3 ints, n_holes x 3 doubles.
struct TetgenRequestHeader {
    std::uint64_t magic = kTetgenMagic;
    std::array<char, 64> switches{};  ///< of TetGen's command line, zero-terminated
    std::int32_t n_vertices = 0, n_triangles = 0, n_holes = 0;
    std::int32_t seeded = 0;  ///< 1: begins with points inside (mesh/tets/seed_points.hpp); only with a growth
    /// Bound on a tetrahedron's volume, in units of the regular one with the edge length that the SizeField of this
    /// growth gives; 0: none.
    double relative_volume = 0.0, growth = 0.0;
    std::int32_t cpu_seconds = 0, unused = 0;  ///< of the processor, after which the helper is ended by SIGXCPU
};

/// Followed by n_vertices x 3 doubles and n_tetrahedra x 4 ints when status is 0.
struct TetgenReplyHeader {
    std::uint64_t magic = kTetgenMagic;
    std::int32_t status = 0;  ///< 0, or the number that TetGen threw
    std::int32_t n_vertices = 0, n_tetrahedra = 0, unused = 0;
};

}  // namespace elastolab
