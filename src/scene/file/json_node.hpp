#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "scene/file/json_text.hpp"

namespace elastolab {

/// A JSON value that knows where it stands, so that every complaint about it names the file and the JSON path. Refers
/// to the value and the file name, which must outlive it. Only sources of this layer include this header.
/// Every reader throws SceneError when the value has another type or lies outside the range asked for.
class JsonNode {
public:
    JsonNode(const Json& value, std::string path, const std::string& file)
        : value_(&value), path_(std::move(path)), file_(&file) {}

    /// Throws SceneError: "file: path: finding".
    [[noreturn]] void fail(const std::string& finding) const;

    /// Requires an object with no other keys than these.
    void require_keys(std::initializer_list<std::string_view> allowed) const;
    bool has(std::string_view key) const;
    /// A member of an object; an error when it is missing, with `hint` as the way forward.
    JsonNode at(std::string_view key, std::string_view hint) const;
    std::optional<JsonNode> find(std::string_view key) const;

    bool is_object() const { return value_->is_object(); }
    bool is_array() const { return value_->is_array(); }
    /// Requires an array, and `size` members unless it is negative.
    int array_size(int size = -1) const;
    JsonNode operator[](int i) const;

    std::string text() const;
    bool boolean() const;
    double number() const;
    double positive_number() const;
    int integer(int min, int max) const;
    Eigen::Vector3d vector3() const;
    Eigen::Matrix3d matrix3() const;

    /// The value as the user wrote it, cut to a length that fits a message.
    std::string quoted() const;

private:
    [[noreturn]] void fail_type(const char* expected) const;

    const Json* value_;
    std::string path_;
    const std::string* file_;
};

}  // namespace elastolab
