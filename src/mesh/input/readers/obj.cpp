#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "mesh/input/readers/polygons.hpp"
#include "mesh/input/readers/readers.hpp"
#include "mesh/input/readers/words.hpp"

namespace elastolab {

namespace {

constexpr std::array kFreeForm = {"curv", "curv2", "surf", "deg", "cstype", "call", "csh"};
/// Ignored statements of numbers, which may be continued. In others a '\\' at the end may be that of a path, and must
/// not swallow the next line.
constexpr std::array kContinued = {"vt", "vn", "vp", "l", "p"};

class ObjReader {
public:
    explicit ObjReader(std::string_view bytes) : words_(bytes, true) { mesh_.first_number = 1; }

    SurfaceMesh read() {
        for (std::string_view key = words_.next(); !key.empty(); key = words_.next()) read_statement(key);
        return triangulated(mesh_);
    }

private:
    [[noreturn]] void refuse(const std::string& finding) const {
        refuse_damaged("line " + std::to_string(line_number(words_.text(), words_.position())) + ": " + finding);
    }

    void read_statement(std::string_view key) {
        if (key == "v") {
            read_vertex();
        } else if (key == "f" || key == "fo") {  // "fo" is the older name
            read_face();
        } else {
            ignore(key);
        }
    }

    /// The next word of this statement, which a '\' at a line's end continues on the next line.
    std::string_view next_in_statement() {
        std::string_view word = words_.next_in_line();
        while (word == "\\" && ends_line()) {
            step_over_line_end();
            word = words_.next_in_line();
        }
        // Without a blank before it, it ends the word: "f 1 2 3\".
        if (word.size() > 1 && word.back() == '\\' && ends_line()) {
            word.remove_suffix(1);
            words_.go_to(words_.position() - 1);
        }
        return word;
    }

    bool ends_line() const {
        const std::string_view text = words_.text();
        const std::size_t end = std::min(text.find_first_not_of(" \t", words_.position()), text.size());
        return end == text.size() || is_line_end(text[end]);
    }

    void step_over_line_end() {
        words_.skip_line();
        const std::string_view rest = words_.text().substr(std::min(words_.position(), words_.text().size()));
        words_.go_to(words_.position() + (rest.starts_with("\r\n") ? 2 : rest.empty() ? 0 : 1));
    }

    void read_vertex() {
        std::array<double, 7> numbers{};
        std::size_t count = 0;
        for (std::string_view word = next_in_statement(); !word.empty(); word = next_in_statement()) {
            const std::optional<double> number = to_double(word);
            if (!number) refuse(in_quotes(word) + " is not a number.");
            if (count == numbers.size()) refuse("a vertex has more than seven numbers.");
            numbers.at(count++) = *number;
        }
        if (count < 3 || count == 5)
            refuse("a vertex has " + std::to_string(count) + " numbers instead of 3, 4, 6 or 7.");
        Eigen::Vector3d place(numbers[0], numbers[1], numbers[2]);
        if ((count == 4 || count == 7) && numbers[3] != 1.0) place /= weight(numbers[3]);
        mesh_.vertices.push_back(place);
    }

    double weight(double w) const {
        if (w == 0.0) refuse("a vertex has weight 0, a point at infinity.");
        return w;
    }

    /// Corners as "7", "7/1", "7//3", "7/1/3".
    void read_face() {
        const std::size_t first = mesh_.corners.size();
        for (std::string_view word = next_in_statement(); !word.empty(); word = next_in_statement()) {
            const std::optional<std::int64_t> number = to_integer(word.substr(0, word.find('/')));
            if (!number) refuse(in_quotes(word) + " is no corner of a face.");
            mesh_.corners.push_back(vertex_index(*number));
        }
        if (mesh_.corners.size() < first + 3) mesh_.corners.resize(first);  // a point or a line
        mesh_.close_polygon();
    }

    /// A vertex may come after the faces that it belongs to, so only `triangulated` knows whether it exists.
    int vertex_index(std::int64_t number) const {
        const auto n = static_cast<std::int64_t>(mesh_.vertices.size());
        constexpr std::int64_t kMost = 100'000'000;
        if (number == 0) refuse("a face refers to vertex 0, but vertices are counted from 1.");
        if (number < -n || number > kMost)
            refuse("a face refers to vertex " + std::to_string(number) + ", which is none.");
        return static_cast<int>(number > 0 ? number - 1 : n + number);
    }

    /// Names, materials, normals and the like; but what a damaged file holds, or another format, is none of these.
    void ignore(std::string_view key) {
        const auto is_name = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
        if (!std::all_of(key.begin(), key.end(), is_name)) refuse(in_quotes(key) + " is not an OBJ statement.");
        if (std::find(kFreeForm.begin(), kFreeForm.end(), key) != kFreeForm.end())
            throw Refusal("holds free-form curves or surfaces (" + in_quotes(key) +
                          "), which are not read. Export it as polygons.");
        if (std::find(kContinued.begin(), kContinued.end(), key) == kContinued.end()) return words_.skip_line();
        while (!next_in_statement().empty()) {
        }
    }

    Words words_;
    PolygonMesh mesh_;
};

}  // namespace

SurfaceMesh read_obj(std::string_view bytes) { return ObjReader(bytes).read(); }

}  // namespace elastolab
