#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "mesh/input/readers/ply_header.hpp"
#include "mesh/input/readers/polygons.hpp"
#include "mesh/input/readers/readers.hpp"
#include "mesh/input/readers/words.hpp"

namespace elastolab {

static_assert(std::endian::native == std::endian::little, "the binary formats are read in the machine's byte order");

namespace {

/// Vertex numbers are at most 64 bits, but doubles only hold 53: more than any mesh has.
std::int64_t whole(double value) {
    if (!(std::abs(value) < 9e15) || value != std::floor(value))
        refuse_damaged("has an invalid vertex number or list length.");
    return static_cast<std::int64_t>(value);
}

/// The numbers of a text.
class TextSource {
public:
    explicit TextSource(std::string_view bytes) : words_(bytes, false) {}

    double next(PlyType) {
        const std::string_view word = words_.next();
        if (word.empty()) refuse_damaged("ends before the last of the elements that its header counts.");
        const std::optional<double> number = to_double(word);
        if (!number) refuse_damaged(in_quotes(word) + " is not a number.");
        return *number;
    }
    void skip(PlyType type, std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) next(type);
    }
    bool has_more() { return !words_.next().empty(); }

private:
    Words words_;
};

/// The numbers of a binary table.
class BinarySource {
public:
    BinarySource(std::string_view bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

    double next(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return static_cast<double>(take<std::int8_t>());
            case PlyType::uint8:
                return static_cast<double>(take<std::uint8_t>());
            case PlyType::int16:
                return static_cast<double>(take<std::int16_t>());
            case PlyType::uint16:
                return static_cast<double>(take<std::uint16_t>());
            case PlyType::int32:
                return static_cast<double>(take<std::int32_t>());
            case PlyType::uint32:
                return static_cast<double>(take<std::uint32_t>());
            case PlyType::int64:
                return static_cast<double>(take<std::int64_t>());
            case PlyType::uint64:
                return static_cast<double>(take<std::uint64_t>());
            case PlyType::float32:
                return static_cast<double>(take<float>());
            case PlyType::float64:
                return take<double>();
        }
        return 0.0;
    }
    void skip(PlyType type, std::int64_t count) {
        const auto size = static_cast<std::int64_t>(size_in_bytes(type));
        require(count <= static_cast<std::int64_t>(bytes_.size() - at_) / size);
        at_ += static_cast<std::size_t>(count * size);
    }
    /// Whether anything is left but line ends, which some writers add.
    bool has_more() const { return bytes_.find_first_not_of("\r\n", at_) != std::string_view::npos; }

private:
    static void require(bool has_room) {
        if (!has_room) refuse_damaged("ends before the last of the elements that its header counts.");
    }
    template <class T>
    T take() {
        require(bytes_.size() - at_ >= sizeof(T));
        std::array<char, sizeof(T)> raw;
        std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
        if (swapped_) std::reverse(raw.begin(), raw.end());
        at_ += sizeof(T);
        return std::bit_cast<T>(raw);
    }

    std::string_view bytes_;
    bool swapped_;
    std::size_t at_ = 0;
};

template <class Source>
class PlyBodyReader {
public:
    PlyBodyReader(const PlyHeader& header, Source source) : header_(header), source_(source) {
        for (const PlyElement& element : header.elements)
            if (element.name == "vertex") n_vertices_ = element.count;
    }

    PolygonMesh read() {
        for (const PlyElement& element : header_.elements) read(element);
        if (source_.has_more()) refuse_damaged("holds more than its header counts.");
        return std::move(mesh_);
    }

private:
    void read(const PlyElement& element) {
        const int list = element.find({"vertex_indices", "vertex_index"});
        if (element.name == "vertex")
            read_vertices(element);
        else if ((element.name == "face" || element.name == "tristrips") && element.count > 0)
            read_lists(element, list);
        else
            for (std::size_t i = 0; i < element.count; ++i) read_row(element, -1);
    }

    void read_vertices(const PlyElement& element) {
        const std::array place{element.find({"x"}), element.find({"y"}), element.find({"z"})};
        for (const int k : place)
            if (k < 0 || element.properties[static_cast<std::size_t>(k)].is_list)
                refuse_damaged("has vertices without x, y and z.");
        for (std::size_t i = 0; i < element.count; ++i) {
            read_row(element, -1);
            const auto value = [&](int k) { return row_[static_cast<std::size_t>(k)]; };
            mesh_.vertices.emplace_back(value(place[0]), value(place[1]), value(place[2]));
        }
    }

    void read_lists(const PlyElement& element, int list) {
        if (list < 0 || !element.properties[static_cast<std::size_t>(list)].is_list)
            refuse_damaged("has faces without a list 'vertex_indices'.");
        for (std::size_t i = 0; i < element.count; ++i) {
            read_row(element, list);
            if (element.name == "face")
                add_polygon();
            else
                add_strips();
        }
    }

    /// Values of a row into row_, those of property `wanted` into list_; other lists are stepped over.
    void read_row(const PlyElement& element, int wanted) {
        row_.assign(element.properties.size(), 0.0);
        for (std::size_t k = 0; k < element.properties.size(); ++k) {
            const PlyProperty& property = element.properties[k];
            if (!property.is_list)
                row_[k] = source_.next(property.value);
            else
                read_list(property, static_cast<int>(k) == wanted);
        }
    }

    void read_list(const PlyProperty& property, bool is_wanted) {
        const std::int64_t count = whole(source_.next(property.count));
        if (count < 0) refuse_damaged("has a list of negative length.");
        if (!is_wanted) return source_.skip(property.value, count);
        list_.clear();
        for (std::int64_t i = 0; i < count; ++i) list_.push_back(whole(source_.next(property.value)));
    }

    void add_corner(std::int64_t index) { mesh_.corners.push_back(checked_index(index, n_vertices_)); }

    void add_polygon() {
        if (list_.size() >= 3)  // else a point or a line
            for (const std::int64_t index : list_) add_corner(index);
        mesh_.close_polygon();
    }

    /// Strips follow each other with -1 between them. Every triangle shares two corners with the one before, and every
    /// second one is turned round; those with a corner twice only lead on to other places.
    void add_strips() {
        std::size_t begin = 0;  // of the strip
        for (std::size_t i = 0; i < list_.size(); ++i) {
            if (list_[i] == -1) {
                begin = i + 1;
            } else if (i >= begin + 2) {
                const bool turned = (i - begin) % 2 == 1;
                add_triangle(list_[i - 2], list_[turned ? i : i - 1], list_[turned ? i - 1 : i]);
            }
        }
    }

    void add_triangle(std::int64_t a, std::int64_t b, std::int64_t c) {
        if (a == b || b == c || c == a) return;
        for (const std::int64_t index : {a, b, c}) add_corner(index);
        mesh_.close_polygon();
    }

    const PlyHeader& header_;
    Source source_;
    std::size_t n_vertices_ = 0;
    PolygonMesh mesh_;
    std::vector<double> row_;
    std::vector<std::int64_t> list_;
};

}  // namespace

SurfaceMesh read_ply(std::string_view bytes) {
    const PlyHeader header = read_ply_header(bytes);
    const std::string_view body = bytes.substr(header.size);
    if (header.format == PlyFormat::text) return triangulated(PlyBodyReader(header, TextSource(body)).read());
    const bool swapped = header.format == PlyFormat::big_endian;
    return triangulated(PlyBodyReader(header, BinarySource(body, swapped)).read());
}

}  // namespace elastolab
