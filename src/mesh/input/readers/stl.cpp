#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "mesh/input/readers/polygons.hpp"
#include "mesh/input/readers/readers.hpp"
#include "mesh/input/readers/words.hpp"

namespace elastolab {

static_assert(std::endian::native == std::endian::little, "the binary format is read in the machine's byte order");

namespace {

constexpr std::size_t kHeaderSize = 84, kFacetSize = 50;

template <class T>
T value_at(std::string_view bytes, std::size_t position) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes.data() + position, sizeof(T));
    return std::bit_cast<T>(raw);
}

std::size_t binary_count(std::string_view bytes) {
    return bytes.size() < kHeaderSize ? 0 : value_at<std::uint32_t>(bytes, kHeaderSize - 4);
}

/// A binary file may begin with the word "solid", too, but it goes on with other bytes than a text does.
bool is_text(std::string_view bytes) {
    Words words(bytes, false);
    if (lower_case(words.next()) != "solid") return false;
    return bytes.substr(0, kHeaderSize).find_first_of(std::string_view("\0\x01\x02\x03\x04\x05\x06\x07", 8)) ==
           std::string_view::npos;
}

PolygonMesh read_binary(std::string_view bytes) {
    PolygonMesh mesh;
    for (std::size_t facet = kHeaderSize; facet < bytes.size(); facet += kFacetSize) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto coordinate = [&](std::size_t k) {
                return static_cast<double>(value_at<float>(bytes, facet + 12 + 12 * corner + 4 * k));
            };
            mesh.corners.push_back(static_cast<int>(mesh.vertices.size()));
            mesh.vertices.emplace_back(coordinate(0), coordinate(1), coordinate(2));
        }
        mesh.close_polygon();
    }
    return mesh;
}

class StlTextReader {
public:
    explicit StlTextReader(std::string_view bytes) : words_(bytes, false) {}

    PolygonMesh read() {
        while (true) {
            const std::string key = next();
            if (key.empty()) return std::move(mesh_);
            if (key != "solid") refuse_damaged(found(key, "solid"));
            words_.skip_line();  // its name
            read_solid();
        }
    }

private:
    std::string next() { return lower_case(words_.next()); }

    std::string found(const std::string& word, const std::string& expected) const {
        if (word.empty()) return "ends where '" + expected + "' should come.";
        return "line " + std::to_string(line_number(words_.text(), words_.position())) + ": " + in_quotes(word) +
               " stands where '" + expected + "' should.";
    }

    void require(const std::string& expected) {
        const std::string word = next();
        if (word != expected) refuse_damaged(found(word, expected));
    }

    void read_solid() {
        for (std::string key = next(); key != "endsolid"; key = next()) {
            if (key != "facet") refuse_damaged(found(key, "endsolid"));
            read_facet();
        }
        words_.skip_line();
    }

    /// Goes behind "outer". The normal before it is said better by the corners, and may be anything on its line; it may
    /// go on in the next one.
    void skip_normal() {
        std::string word;
        do {
            word = lower_case(words_.next_in_line());
        } while (!word.empty() && word != "outer");
        while (word.empty() || to_double(word)) {
            word = next();
            if (word.empty()) break;
        }
        if (word != "outer") refuse_damaged(found(word, "outer"));
    }

    void read_facet() {
        skip_normal();
        require("loop");
        for (std::string key = next(); key != "endloop"; key = next()) {
            if (key != "vertex") refuse_damaged(found(key, "endloop"));
            read_vertex();
        }
        require("endfacet");
        const std::size_t first = mesh_.ends.empty() ? 0 : mesh_.ends.back();
        if (mesh_.corners.size() < first + 3)
            refuse_damaged("triangle " + std::to_string(mesh_.ends.size() + 1) + " has less than three corners.");
        mesh_.close_polygon();
    }

    void read_vertex() {
        Eigen::Vector3d place;
        for (double& x : place) {
            const std::string_view word = words_.next();
            const std::optional<double> number = to_double(word);
            if (!number) refuse_damaged(found(std::string(word), "a number"));
            x = *number;
        }
        mesh_.corners.push_back(static_cast<int>(mesh_.vertices.size()));
        mesh_.vertices.push_back(place);
    }

    Words words_;
    PolygonMesh mesh_;
};

}  // namespace

bool is_binary_stl(std::string_view bytes) {
    return bytes.size() >= kHeaderSize && bytes.size() == kHeaderSize + kFacetSize * binary_count(bytes);
}

SurfaceMesh read_stl(std::string_view bytes) {
    if (is_binary_stl(bytes)) return triangulated(read_binary(bytes));
    if (is_text(bytes)) return triangulated(StlTextReader(bytes).read());
    if (bytes.size() < kHeaderSize) refuse_damaged("is too short for an STL file.");
    refuse_damaged("counts " + std::to_string(binary_count(bytes)) +
                   " triangles in its header, but its size does not match.");
}

}  // namespace elastolab
