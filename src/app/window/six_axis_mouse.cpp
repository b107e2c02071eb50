#include "app/window/six_axis_mouse.hpp"

#ifdef ELASTOLAB_HAS_SPNAV

#include <poll.h>
#include <spnav.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <utility>

namespace elastolab {

namespace {

constexpr double kFullDeflection = 350.0;  ///< of the numbers that devices send
constexpr int kPatienceMs = 100;           ///< between looks at whether to stop
constexpr double kLongestEvent = 0.1;      ///< [s] the first after a pause tells of the pause

/// The device's z axis points away from the eye.
SixAxisMotion motion_of(const spnav_event_motion& event) {
    const double amount = std::min(1e-3 * event.period, kLongestEvent) / kFullDeflection;
    return {amount * Eigen::Vector3d(event.x, event.y, -event.z),
            amount * Eigen::Vector3d(event.rx, event.ry, -event.rz)};
}

}  // namespace

/// The open connection, and the thread that listens.
class SixAxisMouse::Connection {
public:
    explicit Connection(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { listen(); }) {}
    ~Connection() {
        stop_ = true;
        thread_.join();
        spnav_close();
    }
    std::optional<SixAxisMotion> take() {
        const std::scoped_lock lock(mutex_);
        return std::exchange(motion_, std::nullopt);
    }

private:
    void listen() {
        pollfd socket{.fd = spnav_fd(), .events = POLLIN, .revents = 0};
        while (!stop_) {
            const int ready = poll(&socket, 1, kPatienceMs);
            if (ready > 0 && (socket.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) return;  // the daemon has ended
            if (ready > 0 && take_events()) wake_();
        }
    }
    bool take_events() {
        bool moved = false;
        for (spnav_event event; spnav_poll_event(&event) != 0;) {
            if (event.type != SPNAV_EVENT_MOTION) continue;
            const SixAxisMotion more = motion_of(event.motion);
            const std::scoped_lock lock(mutex_);
            if (!motion_) motion_.emplace();
            motion_->shift += more.shift;
            motion_->turn += more.turn;
            moved = true;
        }
        return moved;
    }

    std::function<void()> wake_;
    std::mutex mutex_;
    std::optional<SixAxisMotion> motion_;
    std::atomic<bool> stop_ = false;
    std::thread thread_;  // last: it uses what is above
};

bool SixAxisMouse::supported() { return true; }

SixAxisMouse::SixAxisMouse(std::function<void()> wake) {
    if (spnav_open() == 0) connection_ = std::make_unique<Connection>(std::move(wake));
}

}  // namespace elastolab

#else

namespace elastolab {

class SixAxisMouse::Connection {
public:
    std::optional<SixAxisMotion> take() { return std::nullopt; }
};

bool SixAxisMouse::supported() { return false; }

SixAxisMouse::SixAxisMouse(std::function<void()>) {}

}  // namespace elastolab

#endif

namespace elastolab {

SixAxisMouse::~SixAxisMouse() = default;

std::optional<SixAxisMotion> SixAxisMouse::take() { return connection_ ? connection_->take() : std::nullopt; }

}  // namespace elastolab
