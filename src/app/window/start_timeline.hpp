#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace elastolab {

/// Writes when a person who starts the viewer first sees what (`event,seconds` since the process began, to a
/// hundredth), each event when it happens.
class StartTimeline {
public:
    enum Event {
        window,  ///< the first frame
        loaded,  ///< the first frame with the body of the file
        answer,  ///< the first frame that shows an answer, of the preview or of the method
        moved,   ///< the first frame in which a pulled body has moved
        exact    ///< the first such frame by the chosen method itself, converged
    };

    /// Throws Error when the file cannot be written.
    explicit StartTimeline(const std::filesystem::path& file);
    /// Nothing happens when it was marked already.
    void mark(Event event);

private:
    static constexpr std::array<std::string_view, 5> kNames = {"window", "loaded", "answer", "moved", "exact"};
    std::ofstream file_;
    std::array<bool, kNames.size()> marked_{};
};

/// Seconds since this process began; 0 where the system does not tell.
double process_seconds();

}  // namespace elastolab
