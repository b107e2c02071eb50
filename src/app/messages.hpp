#pragma once

#include <deque>
#include <string>
#include <utility>

namespace elastolab {

/// What the program tells the person, for a few seconds (errors until they are dismissed).
class Messages {
public:
    struct Message {
        std::string text;
        bool is_error = false;
        double until = 0.0;  ///< seconds of the window's clock; negative: set when first shown
    };

    void note(std::string text) { add({std::move(text), false, -1.0}); }
    void error(std::string text) { add({std::move(text), true, -1.0}); }
    void dismiss(std::size_t i) { messages_.erase(messages_.begin() + static_cast<std::ptrdiff_t>(i)); }

    /// Drops what has been there long enough. Seconds until that happens next; negative: never.
    double expire(double now);
    const std::deque<Message>& all() const { return messages_; }

private:
    void add(Message message);
    std::deque<Message> messages_;
};

}  // namespace elastolab
