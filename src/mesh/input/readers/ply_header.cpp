#include "mesh/input/readers/ply_header.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "mesh/input/readers/readers.hpp"
#include "mesh/input/readers/words.hpp"

namespace elastolab {

namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 18> kTypes{{{"char", PlyType::int8},
                                                                       {"int8", PlyType::int8},
                                                                       {"uchar", PlyType::uint8},
                                                                       {"uint8", PlyType::uint8},
                                                                       {"short", PlyType::int16},
                                                                       {"int16", PlyType::int16},
                                                                       {"ushort", PlyType::uint16},
                                                                       {"uint16", PlyType::uint16},
                                                                       {"int", PlyType::int32},
                                                                       {"int32", PlyType::int32},
                                                                       {"uint", PlyType::uint32},
                                                                       {"uint32", PlyType::uint32},
                                                                       {"int64", PlyType::int64},
                                                                       {"uint64", PlyType::uint64},
                                                                       {"float", PlyType::float32},
                                                                       {"float32", PlyType::float32},
                                                                       {"double", PlyType::float64},
                                                                       {"float64", PlyType::float64}}};

PlyType type_of(std::string_view word) {
    for (const auto& [name, type] : kTypes)
        if (name == word) return type;
    refuse_damaged("has a property of the unknown type " + in_quotes(word) + ".");
}

class PlyHeaderReader {
public:
    explicit PlyHeaderReader(std::string_view bytes) : words_(bytes, false) {}

    PlyHeader read() {
        if (words_.next() != "ply") refuse_damaged("does not begin with 'ply', as files of this format do.");
        line_end_ = line_end();
        bool has_format = false;
        while (true) {
            const std::string_view key = words_.next();
            if (key.empty()) refuse_damaged("is a PLY file whose header does not end.");
            if (key == "end_header") break;
            has_format = has_format || key == "format";
            read_line(key);
            words_.skip_line();
        }
        if (!has_format) refuse_damaged("does not say its format.");
        words_.skip_line();
        header_.size = std::min(words_.position() + line_end_.size(), words_.text().size());
        return std::move(header_);
    }

private:
    /// How lines of this header end: after "end_header" a binary table may begin with a byte that looks like a line
    /// end.
    std::string_view line_end() {
        words_.skip_line();
        const std::string_view rest = words_.text().substr(words_.position());
        return rest.substr(0, rest.starts_with("\r\n") ? 2 : 1);
    }

    void read_line(std::string_view key) {
        if (key == "format")
            read_format();
        else if (key == "element")
            read_element();
        else if (key == "property")
            read_property();
        // Else a comment, announced or not: what should have been read here would be missed below.
    }

    void read_format() {
        const std::string_view name = words_.next_in_line();
        if (name == "ascii")
            header_.format = PlyFormat::text;
        else if (name == "binary_little_endian")
            header_.format = PlyFormat::little_endian;
        else if (name == "binary_big_endian")
            header_.format = PlyFormat::big_endian;
        else
            refuse_damaged("has the unknown format " + in_quotes(name) + ".");
    }

    void read_element() {
        PlyElement element;
        element.name = std::string(words_.next_in_line());
        const std::string_view word = words_.next_in_line();
        const std::optional<std::int64_t> count = to_integer(word);
        if (!count || *count < 0)
            refuse_damaged("has " + in_quotes(word) + " elements of the kind " + in_quotes(element.name) + ".");
        element.count = static_cast<std::size_t>(*count);
        header_.elements.push_back(std::move(element));
    }

    void read_property() {
        if (header_.elements.empty()) refuse_damaged("has a property of no element in its header.");
        PlyProperty property;
        std::string_view type = words_.next_in_line();
        property.is_list = type == "list";
        if (property.is_list) {
            property.count = type_of(words_.next_in_line());
            if (property.count == PlyType::float32 || property.count == PlyType::float64)
                refuse_damaged("has a list whose length is no whole number.");
            type = words_.next_in_line();
        }
        property.value = type_of(type);
        property.name = std::string(words_.next_in_line());
        header_.elements.back().properties.push_back(std::move(property));
    }

    Words words_;
    PlyHeader header_;
    std::string_view line_end_;
};

/// Before memory is asked for, or a number of empty rows walked through.
void require_room(const PlyHeader& header, std::size_t bytes) {
    std::size_t left = bytes - header.size;
    if (header.format == PlyFormat::text) ++left;  // the last word needs no blank after it
    for (const PlyElement& element : header.elements) {
        const std::size_t size = element.least_row_size(header.format);
        if (size == 0 && element.count > 0) refuse_damaged("has elements without properties.");
        if (element.count > 0 && element.count > left / size)
            refuse_damaged("counts " + std::to_string(element.count) + " elements of the kind " +
                           in_quotes(element.name) + " in its header, more than it holds.");
        left -= element.count * size;
    }
}

}  // namespace

std::size_t size_in_bytes(PlyType type) {
    switch (type) {
        case PlyType::int8:
        case PlyType::uint8:
            return 1;
        case PlyType::int16:
        case PlyType::uint16:
            return 2;
        case PlyType::int32:
        case PlyType::uint32:
        case PlyType::float32:
            return 4;
        case PlyType::int64:
        case PlyType::uint64:
        case PlyType::float64:
            return 8;
    }
    return 1;
}

int PlyElement::find(std::initializer_list<std::string_view> names) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (std::find(names.begin(), names.end(), properties[i].name) != names.end()) return static_cast<int>(i);
    return -1;
}

std::size_t PlyElement::least_row_size(PlyFormat format) const {
    std::size_t size = 0;
    for (const PlyProperty& property : properties) {
        const bool is_text = format == PlyFormat::text;
        size += is_text ? 2 : size_in_bytes(property.is_list ? property.count : property.value);
    }
    return size;
}

PlyHeader read_ply_header(std::string_view bytes) {
    PlyHeader header = PlyHeaderReader(bytes).read();
    require_room(header, bytes.size());
    return header;
}

}  // namespace elastolab
