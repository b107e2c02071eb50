#include "app/input/interaction_log.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/error.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace {

using Json = nlohmann::json;

constexpr int kVersion = 1;
constexpr int kMaxWindow = 16384;
constexpr int kLargestCode = 0x10FFFF;  ///< of characters; GLFW_KEY_UNKNOWN is -1
/// In the order of InputEvent::Kind.
constexpr std::array<std::string_view, 7> kKinds = {"cursor", "button", "scroll", "key", "text", "focus", "fingers"};

Json to_json(const InputEvent& event) {
    Json json = {std::string(kKinds[static_cast<std::size_t>(event.kind)]),
                 event.cursor.x(),
                 event.cursor.y(),
                 event.code,
                 event.pressed,
                 event.repeated,
                 event.modifiers};
    if (event.kind == InputEvent::Kind::fingers)
        for (const double more : {event.from.x(), event.from.y(), event.zoom}) json.push_back(more);
    return json;
}

int integer(const Json& json, int low, int high) {
    const auto value = json.is_number_integer() ? json.get<std::int64_t>() : high + std::int64_t{1};
    if (value < low || value > high) throw std::runtime_error("a number is out of its range");
    return static_cast<int>(value);
}

InputEvent event_of(const Json& json, double seconds) {
    const auto kind = std::find(kKinds.begin(), kKinds.end(), json.at(0).get<std::string>());
    InputEvent event;
    event.kind = static_cast<InputEvent::Kind>(kind - kKinds.begin());
    const bool of_fingers = event.kind == InputEvent::Kind::fingers;
    if (kind == kKinds.end() || json.size() != (of_fingers ? 10 : 7)) throw std::runtime_error("is not a known event");
    event.cursor = {json.at(1).get<double>(), json.at(2).get<double>()};
    event.code = integer(json.at(3), -1, kLargestCode);
    event.pressed = json.at(4).get<bool>();
    event.repeated = json.at(5).get<bool>();
    event.modifiers = integer(json.at(6), 0, 0xFF);
    if (of_fingers) {
        event.from = {json.at(7).get<double>(), json.at(8).get<double>()};
        event.zoom = json.at(9).get<double>();
        if (!(event.zoom > 0.0)) throw std::runtime_error("a number is out of its range");
    }
    event.seconds = seconds;
    return event;
}

Eigen::Vector2i size_of(const Json& size) {
    return {integer(size.at(0), 1, kMaxWindow), integer(size.at(1), 1, kMaxWindow)};
}

LoggedFrame frame_of(const Json& json) {
    LoggedFrame frame{.seconds = json.at("seconds").get<double>(), .events = {}};
    if (json.contains("window")) frame.window_size = size_of(json.at("window"));
    for (const Json& event : json.at("events")) frame.events.push_back(event_of(event, frame.seconds));
    return frame;
}

Eigen::Vector2i window_size_of(const Json& header) {
    if (header.at("elastolab_interaction") != kVersion) throw std::runtime_error("has another version");
    return size_of(header.at("window"));
}

/// The next line, of a length that a frame can have: a device may have no end of line at all.
bool next_line(std::istream& in, std::string& line) {
    constexpr std::size_t kLongest = 1 << 20;
    line.clear();
    char c = 0;
    while (in.get(c) && c != '\n') {
        if (line.size() == kLongest) throw std::runtime_error("is longer than a frame can be");
        line += c;
    }
    return static_cast<bool>(in) || !line.empty();
}

}  // namespace

InteractionRecorder::InteractionRecorder(const std::filesystem::path& file, const Eigen::Vector2i& window_size)
    : path_(file), file_(std::make_unique<AtomicFile>(file)), window_size_(window_size) {
    file_->stream() << Json{{"elastolab_interaction", kVersion}, {"window", {window_size.x(), window_size.y()}}}
                    << '\n';
}

InteractionRecorder::~InteractionRecorder() {
    try {
        finish();
    } catch (const std::exception&) {  // whoever needs to know calls finish()
    }
}

void InteractionRecorder::add(const LoggedFrame& frame) {
    Json events = Json::array();
    for (const InputEvent& event : frame.events) events.push_back(to_json(event));
    Json line = {{"seconds", frame.seconds}, {"events", std::move(events)}};
    if (frame.window_size && *frame.window_size != window_size_) {
        window_size_ = *frame.window_size;
        line["window"] = {window_size_.x(), window_size_.y()};
    }
    file_->stream() << line << '\n';
}

void InteractionRecorder::finish() {
    if (!file_) return;
    const std::unique_ptr<AtomicFile> file = std::move(file_);
    file->commit();
}

InteractionLog load_interaction(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw SceneError(one_line(file.string() + ": cannot be read. Check the name of the interaction log."));
    constexpr std::size_t kLongestReason = 200;  // it may quote a whole file of one line
    InteractionLog log;
    int number = 1;
    const auto refused = [&](const std::string& why) {
        return SceneError(one_line(file.string() + ": line " + std::to_string(number) + ": not an interaction log (" +
                                   shortened(why, kLongestReason) + "). Record one with elastolab view --record."));
    };
    try {
        std::string line;
        if (!next_line(in, line)) throw std::runtime_error("is empty");
        log.window_size = window_size_of(Json::parse(line));
        for (number = 2; next_line(in, line); ++number) log.frames.push_back(frame_of(Json::parse(line)));
    } catch (const Json::parse_error&) {
        throw refused("it is cut off, or no JSON");
    } catch (const Json::exception&) {
        throw refused("a value is missing or of another kind");
    } catch (const std::exception& error) {
        throw refused(error.what());
    }
    return log;
}

}  // namespace elastolab
