#pragma once

#include <sys/types.h>
#include <Eigen/Core>
#include <optional>
#include <string>

#include "support/temporary_folder.hpp"

namespace elastolab::test {

/// An X server of its own with a touch screen and a trackpad that this process touches (Xorg's drivers "dummy" and
/// "inputtest"); the environment's DISPLAY while it is there.
class TouchDisplay {
public:
    TouchDisplay();
    ~TouchDisplay();
    TouchDisplay(const TouchDisplay&) = delete;
    TouchDisplay& operator=(const TouchDisplay&) = delete;

    /// Empty, or why there is none: Xorg needs root and its drivers.
    const std::string& missing() const { return missing_; }

    /// Places in pixels of the screen. Each returns when the server has handled it.
    void begin(int finger, const Eigen::Vector2d& at);
    void move(int finger, const Eigen::Vector2d& to);
    void end(int finger, const Eigen::Vector2d& at);
    /// Two fingers on the trackpad, apart by this factor at the end.
    void pinch(double factor);

private:
    std::string start();
    void touch(int type, int finger, const Eigen::Vector2d& at);

    TemporaryFolder folder_;
    pid_t server_ = -1;
    int screen_ = -1, trackpad_ = -1;  ///< sockets of the driver
    std::optional<std::string> display_before_;
    std::string missing_;
};

}  // namespace elastolab::test
