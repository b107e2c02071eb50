#include "scene/file/json_text.hpp"

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

constexpr std::size_t kDeepest = 100;
constexpr std::size_t kLineWidth = 100;

std::string line_and_column(std::string_view text, std::size_t position) {
    const std::string_view before = text.substr(0, std::min(position, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - line_begin);
}

/// What the parser says is wrong, without its own prefix "[json.exception....] parse error at line 1, column 2: ".
std::string parser_reason(const std::string& what) {
    const std::size_t place = what.find("column ");
    const std::size_t colon = place == std::string::npos ? place : what.find(": ", place);
    const std::size_t bracket = what.find("] ");
    std::string reason = what;
    if (colon != std::string::npos)
        reason = what.substr(colon + 2);
    else if (bracket != std::string::npos)
        reason = what.substr(bracket + 2);
    constexpr std::size_t kLongest = 200;  // it may quote a whole file of one line
    return shortened(reason, kLongest);
}

/// An ordered object looks for a key by comparing it with all others, which takes quadratic time for all of them; in
/// its list it does not.
Json::object_t::Container& members_of(Json& object) {
    return static_cast<Json::object_t::Container&>(object.get_ref<Json::object_t&>());
}

/// Takes the members out of all containers, from the innermost on: what is empty is destroyed without an allocation.
/// NOLINTNEXTLINE(misc-no-recursion,bugprone-exception-escape): no deeper than kDeepest; types are asked before
void empty(Json& value) noexcept {
    if (value.is_array()) {
        auto& members = value.get_ref<Json::array_t&>();
        for (Json& member : members) empty(member);
        members.clear();
    } else if (value.is_object()) {
        auto& members = members_of(value);
        for (auto& [key, member] : members) empty(member);
        members.clear();
    }
}

/// Receives the parser's events and builds the value; knows where it is, which the parser's own builder does not.
class Builder final : public nlohmann::json_sax<Json> {
public:
    Builder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    JsonTree take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t&) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        if (!names_.back().insert(name).second)
            throw SceneError(json_message(file_, json_path(path(), name), "appears twice. Remove one of them."));
        key_ = name;
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
        throw SceneError(file_ + ": " + line_and_column(text_, position) + ": " +
                         one_line(parser_reason(error.what())) + ". A scene file is JSON; correct it there.");
    }

private:
    Json* place(Json&& value) {
        if (open_.empty()) return &(root_.value = std::move(value));
        Json& parent = *open_.back();
        if (parent.is_array()) return &parent.emplace_back(std::move(value));
        return &members_of(parent).emplace_back(key_, std::move(value)).second;  // it is known to be new
    }
    bool add(Json value) {
        place(std::move(value));
        return true;
    }
    bool open(Json&& value) {
        if (open_.size() >= kDeepest)
            throw SceneError(file_ + ": nested deeper than " + std::to_string(kDeepest) + " levels. Flatten it.");
        if (!open_.empty()) keys_.push_back(open_.back()->is_array() ? std::to_string(open_.back()->size()) : key_);
        open_.push_back(place(std::move(value)));
        names_.emplace_back();
        return true;
    }
    bool close() {
        open_.pop_back();
        names_.pop_back();
        if (!keys_.empty()) keys_.pop_back();
        return true;
    }
    std::string path() const {
        std::string path;
        for (const std::string& key : keys_) path = json_path(path, key);
        return path;
    }

    std::string_view text_;
    const std::string& file_;
    JsonTree root_;
    std::vector<Json*> open_;  ///< containers from the root to the present one; a parent does not grow meanwhile
    std::vector<std::unordered_set<std::string>> names_;  ///< of the members of each so far
    std::vector<std::string> keys_;
    std::string key_;
};

void print(const Json& value, std::size_t indent, std::string& out) {
    const std::string compact = value.dump();
    if (!value.is_structured() || value.empty() || indent + compact.size() <= kLineWidth) {
        out += compact;
        return;
    }
    out += value.is_object() ? "{" : "[";
    const char* separator = "\n";
    for (const auto& item : value.items()) {
        out.append(separator).append(indent + 2, ' ');
        if (value.is_object()) out += Json(item.key()).dump() + ": ";
        print(item.value(), indent + 2, out);
        separator = ",\n";
    }
    out.append("\n").append(indent, ' ').append(value.is_object() ? "}" : "]");
}

}  // namespace

JsonTree::~JsonTree() { empty(value); }  // NOLINT(bugprone-exception-escape): nor does empty()

JsonTree parse_json(std::string_view text, const std::string& file) {
    Builder builder(text, file);
    Json::sax_parse(text, &builder);
    return builder.take();
}

std::string print_json(const Json& value) {
    std::string out;
    print(value, 0, out);
    return out + "\n";
}

std::string json_path(const std::string& path, std::string_view key) {
    std::string result = path + "/";
    for (const char c : key) {
        if (c == '~')
            result += "~0";
        else if (c == '/')
            result += "~1";
        else
            result += c;
    }
    return result;
}

std::string json_message(const std::string& file, const std::string& path, const std::string& finding) {
    constexpr std::size_t kLongest = 200;  // a key may be as long as its file
    return one_line(file + ": " + (path.empty() ? "" : shortened(path, kLongest) + ": ") + finding);
}

}  // namespace elastolab
