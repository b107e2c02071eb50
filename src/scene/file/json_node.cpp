#include "scene/file/json_node.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace elastolab {

namespace {

std::string joined(std::initializer_list<std::string_view> words) {
    std::string text;
    for (const std::string_view word : words) text += (text.empty() ? "" : ", ") + std::string(word);
    return text;
}

}  // namespace

std::string JsonNode::quoted() const {
    constexpr std::size_t kLongest = 40;
    const std::string text = value_->dump(-1, ' ', true);
    return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

void JsonNode::fail(const std::string& finding) const { throw SceneError(json_message(*file_, path_, finding)); }

void JsonNode::fail_type(const char* expected) const {
    fail(std::string("must be ") + expected + ", is " + quoted() + ". Correct it.");
}

void JsonNode::require_keys(std::initializer_list<std::string_view> allowed) const {
    if (!value_->is_object()) fail_type("an object");
    for (const auto& item : value_->items())
        if (std::find(allowed.begin(), allowed.end(), item.key()) == allowed.end())
            JsonNode(item.value(), json_path(path_, item.key()), *file_)
                .fail("is not a key that belongs here. Known ones: " + joined(allowed) + ".");
}

bool JsonNode::has(std::string_view key) const { return value_->contains(key); }

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
    const auto found = value_->find(key);
    if (found == value_->end()) return std::nullopt;
    return JsonNode(*found, json_path(path_, key), *file_);
}

JsonNode JsonNode::at(std::string_view key, std::string_view hint) const {
    if (const auto member = find(key)) return *member;
    JsonNode(*value_, json_path(path_, key), *file_).fail("is missing. " + std::string(hint));
}

int JsonNode::array_size(int size) const {
    if (!value_->is_array()) fail_type("an array");
    const int present = static_cast<int>(value_->size());
    if (size >= 0 && present != size)
        fail("must have " + std::to_string(size) + " entries, has " + std::to_string(present) + ". Correct it.");
    return present;
}

JsonNode JsonNode::operator[](int i) const {
    const auto index = static_cast<std::size_t>(i);
    return {value_->at(index), json_path(path_, std::to_string(i)), *file_};
}

std::string JsonNode::text() const {
    if (!value_->is_string()) fail_type("a string");
    return value_->get<std::string>();
}

bool JsonNode::boolean() const {
    if (!value_->is_boolean()) fail_type("true or false");
    return value_->get<bool>();
}

double JsonNode::number() const {
    if (!value_->is_number()) fail_type("a number");
    const double number = value_->get<double>();
    if (!std::isfinite(number)) fail("must be a finite number. Correct it.");
    return number;
}

double JsonNode::positive_number() const {
    const double value = number();
    if (value <= 0.0) fail("must be positive, is " + quoted() + ". Give a number above zero.");
    return value;
}

int JsonNode::integer(int min, int max) const {
    if (!value_->is_number_integer()) fail_type("a whole number");
    const bool too_large = value_->is_number_unsigned() && value_->get<std::uint64_t>() > std::uint64_t(INT64_MAX);
    const std::int64_t value = too_large ? INT64_MAX : value_->get<std::int64_t>();
    if (value < min || value > max)
        fail("must lie between " + std::to_string(min) + " and " + std::to_string(max) + ", is " + quoted() +
             ". Correct it.");
    return static_cast<int>(value);
}

Eigen::Vector3d JsonNode::vector3() const {
    array_size(3);
    return {(*this)[0].number(), (*this)[1].number(), (*this)[2].number()};
}

Eigen::Matrix3d JsonNode::matrix3() const {
    array_size(3);
    Eigen::Matrix3d matrix;
    for (int row = 0; row < 3; ++row) matrix.row(row) = (*this)[row].vector3();
    return matrix;
}

}  // namespace elastolab
