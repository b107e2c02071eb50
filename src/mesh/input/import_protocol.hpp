#pragma once

#include <cstdint>

namespace elastolab {

/// What import_surface() and the helper program elastolab-import say to each other, like mesh/tets/tetgen_protocol.hpp.
constexpr std::uint64_t kImportMagic = 0x656c61696d70'0002;

/// Followed by the path.
struct ImportRequestHeader {
    std::uint64_t magic = kImportMagic;
    std::int32_t path_size = 0;
    // Damaged files make assimp loop, or take all memory: then the system ends the helper, or refuses it more.
    std::int32_t cpu_seconds = 0;
    std::int64_t memory_bytes = 0;
};

/// Followed by n_vertices x 3 doubles, n_triangles x 3 ints, and a text that says what is wrong with the file, if
/// anything. The helper has read a file that nobody vouches for: the caller trusts no number of this.
struct ImportReplyHeader {
    std::uint64_t magic = kImportMagic;
    std::int32_t n_vertices = 0, n_triangles = 0, text_size = 0;
    std::int32_t is_single_precision = 0;
};

}  // namespace elastolab
