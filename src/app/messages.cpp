#include "app/messages.hpp"

#include <algorithm>

namespace elastolab {

namespace {

constexpr std::size_t kMaxMessages = 4;
constexpr double kNoteSeconds = 4.0;

}  // namespace

void Messages::add(Message message) {
    std::erase_if(messages_, [&](const Message& other) { return other.text == message.text; });
    messages_.push_back(std::move(message));
    if (messages_.size() > kMaxMessages) messages_.pop_front();
}

double Messages::expire(double now) {
    double next = -1.0;
    for (Message& message : messages_)
        if (!message.is_error && message.until < 0.0) message.until = now + kNoteSeconds;
    std::erase_if(messages_, [&](const Message& m) { return !m.is_error && m.until <= now; });
    for (const Message& message : messages_)
        if (!message.is_error) next = next < 0.0 ? message.until - now : std::min(next, message.until - now);
    return next;
}

}  // namespace elastolab
