#include "fuzz/json_mutator.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "fuzz/token_mutator.hpp"

namespace elastolab::fuzz {

namespace {

using Json = nlohmann::ordered_json;

/// A string between these marks is put into the text without its quotes.
const std::string kOpen = "\"<raw:", kClose = ":raw>\"";

constexpr std::array kWords = {"",
                               "fem",
                               "constant-bem",
                               "linear-bem",
                               "cube",
                               "beam",
                               "sphere",
                               "box.obj",
                               "none.obj",
                               "..",
                               "/",
                               "/dev/zero",
                               "/dev/full",
                               "/proc/self/mem",
                               "key",
                               "text",
                               "scroll",
                               "data:;base64,AAAA",
                               "\x1b[31m\x07",
                               "\xc2\x9b"
                               "2J",
                               "line\nline",
                               "\xe2\x80\xae",
                               "\u00fc",
                               "a\tb",
                               "%s%n",
                               "{\"a\":"};

void collect(Json& node, std::vector<Json*>& nodes) {
    nodes.push_back(&node);
    if (!node.is_structured()) return;
    for (auto& child : node) collect(child, nodes);
}

std::vector<Json*> nodes_of(Json& json) {
    std::vector<Json*> nodes;
    collect(json, nodes);
    return nodes;
}

Json long_text(Random& random) { return std::string(1 + random.below(5000), random.once_in(2) ? 'x' : '\x01'); }

Json odd_value(Random& random) {
    switch (random.below(9)) {
        case 0:
            return nullptr;
        case 1:
            return random.once_in(2);
        case 2:
            return Json::array();
        case 3:
            return Json::object();
        case 4:
            return std::string(random.pick(kWords));
        case 5:
            return long_text(random);
        default:
            return "<raw:" + odd_number(random) + ":raw>";
    }
}

Json wrapped(const Json& json, Random& random) {
    const std::size_t depth = random.once_in(4) ? 300 : 1 + random.below(4);
    Json result = json;
    for (std::size_t i = 0; i < depth; ++i) result = Json::array({std::move(result)});
    return result;
}

void rename_key(Json& object, Random& random) {
    Json renamed = Json::object();
    const std::size_t which = random.below(object.size());
    std::size_t i = 0;
    for (const auto& [key, value] : object.items()) {
        const std::string other = random.once_in(2) ? std::string(random.pick(kWords)) : key + "_";
        renamed[i++ == which ? other : key] = value;
    }
    object = renamed;
}

void remove_child(Json& node, Random& random) {
    const std::size_t which = random.below(node.size());
    if (node.is_array())
        node.erase(which);
    else
        node.erase(std::next(node.begin(), static_cast<std::ptrdiff_t>(which)));
}

/// An element of an array, some or many times more.
void repeat_child(Json& array, Random& random) {
    const Json child = array[random.below(array.size())];
    const std::size_t n = random.once_in(8) ? random.below(3000) : 1 + random.below(3);
    for (std::size_t i = 0; i < n; ++i) array.push_back(child);
}

void change(Json& json, Random& random) {
    std::vector<Json*> nodes = nodes_of(json);
    Json& node = *random.pick(nodes);
    const bool has_children = node.is_structured() && !node.empty();
    switch (random.below(has_children ? 7 : 4)) {
        case 0:
            node = Json(*random.pick(nodes));
            break;
        case 1:
            node = wrapped(node, random);
            break;
        case 2:
        case 3:
            node = odd_value(random);
            break;
        case 4:
            remove_child(node, random);
            break;
        case 5:
            if (node.is_object()) rename_key(node, random);
            break;
        default:
            if (node.is_array()) repeat_child(node, random);
    }
}

std::string with_raw_parts(std::string text) {
    for (std::size_t at = text.find(kOpen); at != std::string::npos; at = text.find(kOpen, at)) {
        text.erase(at, kOpen.size());
        const std::size_t end = text.find(kClose, at);
        if (end != std::string::npos) text.erase(end, kClose.size());
    }
    return text;
}

std::string printed(const Json& json, int indent) {
    return with_raw_parts(json.dump(indent, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

std::string mutate_json(const std::string& text, Random& random) {
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return text;
    change(json, random);
    return printed(json, 1);
}

std::string mutate_json_lines(const std::string& text, Random& random) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (lines.empty()) return text;
    std::string& line = lines[random.below(lines.size())];
    Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded()) return text;
    change(json, random);
    line = printed(json, -1);
    std::string result;
    for (const std::string& one : lines) result += one + "\n";
    return result;
}

}  // namespace elastolab::fuzz
