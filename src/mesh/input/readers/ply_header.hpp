#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace elastolab {

// clang-format off
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };
// clang-format on
enum class PlyFormat { text, little_endian, big_endian };

std::size_t size_in_bytes(PlyType type);

struct PlyProperty {
    std::string name;
    bool is_list = false;
    PlyType count = PlyType::uint8;  ///< of a list's length
    PlyType value = PlyType::float32;
};

/// A table of the file: `count` rows of these properties.
struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;

    /// Place of the first property with one of these names; -1 when there is none.
    int find(std::initializer_list<std::string_view> names) const;
    /// Least number of bytes that a row takes.
    std::size_t least_row_size(PlyFormat format) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::text;
    std::vector<PlyElement> elements;
    std::size_t size = 0;  ///< bytes; the tables follow
};

/// Throws Refusal for what is no sound header, or claims more than the bytes can hold.
PlyHeader read_ply_header(std::string_view bytes);

}  // namespace elastolab
