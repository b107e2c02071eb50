#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "mesh/input/readers/polygons.hpp"
#include "mesh/input/readers/readers.hpp"
#include "mesh/input/readers/words.hpp"

namespace elastolab {

namespace {

/// What the first lines of the file say.
struct OffHeader {
    bool has_texture = false, has_colours = false, has_normals = false, is_homogeneous = false;
    std::size_t n_vertices = 0, n_faces = 0;
    std::size_t body = 0;  ///< position of the first vertex

    std::size_t words_of_place() const { return is_homogeneous ? 4 : 3; }
    /// Colours count as four numbers; the header does not say how many they have.
    std::size_t words_of_vertex() const {
        return words_of_place() + (has_normals ? 3 : 0) + (has_texture ? 2 : 0) + (has_colours ? 4 : 0);
    }
};

/// How the words after the header are taken. Writers differ, so each way is tried until one fits the whole file.
struct OffLayout {
    bool vertex_is_line;  ///< else vertices follow each other in a stream, each of words_of_vertex() words
    bool face_ends_line;  ///< what follows a face on its line is its colour; else faces too follow in a stream
};

class OffHeaderReader {
public:
    explicit OffHeaderReader(std::string_view bytes) : words_(bytes, true) {}

    OffHeader read() {
        read_magic();
        header_.n_vertices = count("vertices");
        header_.n_faces = count("faces");
        // The number of edges, which nobody needs, is left out by some.
        const std::size_t before = words_.position();
        const std::string_view edges = words_.next_in_line();
        if (!edges.empty() && !to_integer(edges)) words_.go_to(before);
        header_.body = words_.position();
        return header_;
    }

private:
    void read_magic() {
        std::string_view magic = words_.next();
        const std::size_t end = magic.find("OFF");
        if (end == std::string_view::npos || !read_prefix(magic.substr(0, end)))
            refuse_damaged("does not begin with OFF, as files of this format do.");
        // "OFF8 6 0": some writers forget the line break.
        words_.go_to(words_.position() - (magic.size() - end - 3));
        const std::size_t before = words_.position();
        const std::string_view next = words_.next();
        if (next == "BINARY") throw Refusal("is a binary OFF file, which is not read. Export it as text, or as PLY.");
        words_.go_to(before);
        if (has_dimension_ && words_.next() != "3") throw Refusal("is no mesh in three dimensions. Export one.");
    }

    bool read_prefix(std::string_view prefix) {
        const auto take = [&](std::string_view key) {
            const bool found = prefix.starts_with(key);
            if (found) prefix.remove_prefix(key.size());
            return found;
        };
        header_.has_texture = take("ST");
        header_.has_colours = take("C");
        header_.has_normals = take("N");
        header_.is_homogeneous = take("4");
        has_dimension_ = take("n");
        return prefix.empty();
    }

    std::size_t count(const char* what) {
        const std::string_view word = words_.next();
        const std::optional<std::int64_t> number = to_integer(word);
        if (!number || *number < 0) refuse_damaged(in_quotes(word) + " is not a number of " + what + ".");
        // A vertex or a face takes four bytes or more.
        if (static_cast<std::uint64_t>(*number) > words_.text().size())
            refuse_damaged("claims " + std::to_string(*number) + " " + what +
                           ", more than a file of this size can hold.");
        return static_cast<std::size_t>(*number);
    }

    Words words_;
    OffHeader header_;
    bool has_dimension_ = false;
};

class OffBodyReader {
public:
    OffBodyReader(std::string_view bytes, const OffHeader& header, OffLayout layout)
        : words_(bytes, true), header_(header), layout_(layout) {
        words_.go_to(header.body);
    }

    PolygonMesh read() {
        for (std::size_t i = 0; i < header_.n_vertices; ++i) read_vertex(i);
        for (std::size_t i = 0; i < header_.n_faces; ++i) read_face(i);
        const std::string_view rest = words_.next();
        if (!rest.empty())
            refuse_damaged("holds more than the faces that its header counts: " + in_quotes(rest) + line() + ".");
        return std::move(mesh_);
    }

private:
    std::string line() const { return " in line " + std::to_string(line_number(words_.text(), words_.position())); }

    [[noreturn]] void refuse_end(const char* what, std::size_t i, std::size_t count) const {
        refuse_damaged("ends in " + std::string(what) + " " + std::to_string(i + 1) + " of " + std::to_string(count) +
                       ".");
    }

    double number(std::string_view word) const {
        const std::optional<double> value = to_double(word);
        if (!value) refuse_damaged(in_quotes(word) + line() + " is not a number.");
        return *value;
    }

    void read_vertex(std::size_t i) {
        Eigen::Vector4d place(0.0, 0.0, 0.0, 1.0);
        const std::size_t n = layout_.vertex_is_line ? header_.words_of_place() : header_.words_of_vertex();
        for (std::size_t k = 0; k < n; ++k) {
            const std::string_view word = k == 0 || !layout_.vertex_is_line ? words_.next() : words_.next_in_line();
            if (word.empty()) refuse_end("vertex", i, header_.n_vertices);
            const double value = number(word);
            if (k < header_.words_of_place()) place[static_cast<Eigen::Index>(k)] = value;
        }
        if (layout_.vertex_is_line) words_.skip_line();
        if (place.w() == 0.0) refuse_damaged("vertex " + std::to_string(i) + " has weight 0, a point at infinity.");
        mesh_.vertices.emplace_back(place.w() == 1.0 ? place.head<3>().eval() : (place.head<3>() / place.w()).eval());
    }

    std::int64_t whole(std::size_t i) {
        const std::string_view word = words_.next();
        if (word.empty()) refuse_end("face", i, header_.n_faces);
        const std::optional<std::int64_t> value = to_integer(word);
        if (!value) refuse_damaged(in_quotes(word) + line() + " is no whole number.");
        return *value;
    }

    void read_face(std::size_t i) {
        const std::int64_t n = whole(i);
        if (n < 0) refuse_damaged("face " + std::to_string(i) + " has " + std::to_string(n) + " corners.");
        const std::size_t first = mesh_.corners.size();
        for (std::int64_t k = 0; k < n; ++k) mesh_.corners.push_back(checked_index(whole(i), header_.n_vertices));
        if (layout_.face_ends_line) words_.skip_line();
        if (n < 3) mesh_.corners.resize(first);  // a point or a line
        mesh_.close_polygon();
    }

    Words words_;
    const OffHeader& header_;
    OffLayout layout_;
    PolygonMesh mesh_;
};

}  // namespace

SurfaceMesh read_off(std::string_view bytes) {
    const OffHeader header = OffHeaderReader(bytes).read();
    std::optional<Refusal> reason;
    // A line for each vertex and each face first: what else is on it is colour, of as many numbers as the writer liked,
    // announced or not. A stream has fewer lines or shorter ones. It may not come first: colours can be taken for
    // corners (all triangles with the colour 5).
    for (const OffLayout layout : {OffLayout{true, true}, OffLayout{false, true}, OffLayout{false, false}}) {
        try {
            return triangulated(OffBodyReader(bytes, header, layout).read());
        } catch (const Refusal& refusal) {
            if (!reason) reason = refusal;
        }
    }
    throw *reason;
}

}  // namespace elastolab
