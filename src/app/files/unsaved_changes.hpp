#pragma once

#include <functional>
#include <utility>

namespace elastolab {

/// What a person answers when an action would lose changes.
enum class UnsavedAnswer { save, discard, cancel };

/// Keeps actions that would lose changes until the person has answered.
class UnsavedChanges {
public:
    using Action = std::function<void()>;

    /// Nobody is to be asked: changes are written at the end anyway, or nobody is there.
    void never_ask() { asks_ = false; }
    /// Does it at once when there is nothing to lose; else it is held, in place of one that was held before.
    void guard(bool would_lose, Action action) {
        if (would_lose && asks_)
            held_ = std::move(action);
        else
            action();
    }
    bool asking() const { return held_ != nullptr; }
    /// The changes are saved, or are not wanted: does what was held.
    void proceed() {
        if (const Action action = std::exchange(held_, nullptr)) action();
    }
    /// Everything stays as it is.
    void cancel() { held_ = nullptr; }

private:
    bool asks_ = true;
    Action held_;
};

}  // namespace elastolab
