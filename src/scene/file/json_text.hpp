#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace elastolab {

/// Objects keep the order of their keys. Only sources of this layer include this header.
using Json = nlohmann::ordered_json;

/// A value with all that it holds. The library's own destructor allocates, which ends the program where memory is used
/// up; this one empties every list and object first.
struct JsonTree {
    Json value;

    // The library's accessors throw where a value is of another type than the one that was asked for, which it is not.
    // NOLINTBEGIN(bugprone-exception-escape)
    JsonTree() = default;
    JsonTree(JsonTree&& other) noexcept { value.swap(other.value); }
    JsonTree& operator=(JsonTree&&) = delete;
    ~JsonTree();
    // NOLINTEND(bugprone-exception-escape)
};

/// Parses strictly: no duplicate keys, no numbers beyond double precision, no comments, nothing after the value, no
/// more than 100 levels. Throws SceneError naming `file`, and line and column or the JSON path of the finding.
JsonTree parse_json(std::string_view text, const std::string& file);

/// JSON for people: indented by two, with arrays and objects that fit a line on one line. Numbers are read back
/// exactly.
std::string print_json(const Json& value);

/// `path` with one more key, as a JSON pointer.
std::string json_path(const std::string& path, std::string_view key);

/// "file: path: finding", leaving out an empty path.
std::string json_message(const std::string& file, const std::string& path, const std::string& finding);

}  // namespace elastolab
