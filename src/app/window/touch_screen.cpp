#include "app/window/touch_screen.hpp"

#ifdef ELASTOLAB_HAS_XINPUT

#include <GLFW/glfw3.h>
#include <poll.h>
#include <X11/extensions/XInput2.h>
#include <X11/Xlib.h>

#include <array>
#include <atomic>
#include <iterator>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <utility>

#include "app/window/fingers.hpp"

/// As glfw3native.h declares it, which wants headers of all that GLFW can use (Xrandr).
extern "C" ::Window glfwGetX11Window(GLFWwindow* window);

namespace elastolab {

namespace {

constexpr int kPatienceMs = 100;  ///< between looks at whether to stop

struct CloseDisplay {
    void operator()(Display* display) const { XCloseDisplay(display); }
};
using DisplayConnection = std::unique_ptr<Display, CloseDisplay>;

/// The version of XInput that client and server agree on, times ten; 0: none.
int version_of_xinput(Display* display, int& opcode) {
    int event = 0, error = 0, major = 2, minor = 4;
    if (XQueryExtension(display, "XInputExtension", &opcode, &event, &error) == False) return 0;
    return XIQueryVersion(display, &major, &minor) == Success ? 10 * major + minor : 0;
}

void select_events(Display* display, ::Window window, int version) {
    std::array<unsigned char, XIMaskLen(XI_LASTEVENT)> mask{};
    for (const int event : {XI_TouchBegin, XI_TouchUpdate, XI_TouchEnd}) XISetMask(mask.data(), event);
    if (version >= 24)
        for (const int event : {XI_GesturePinchBegin, XI_GesturePinchUpdate, XI_GesturePinchEnd})
            XISetMask(mask.data(), event);
    XIEventMask selected{XIAllMasterDevices, static_cast<int>(mask.size()), mask.data()};
    XISelectEvents(display, window, &selected, 1);
    XFlush(display);
}

/// Touches of a trackpad (XIDependentTouch) are no places on the screen. Asks for all devices: that one is gone by now
/// would be an error, by which Xlib ends the program.
bool touches_screen(Display* display, int device) {
    int n = 0;
    XIDeviceInfo* const devices = XIQueryDevice(display, XIAllDevices, &n);
    bool direct = false;
    for (const XIDeviceInfo& info : std::span(devices, devices != nullptr ? static_cast<std::size_t>(n) : 0))
        for (int c = 0; info.deviceid == device && c < info.num_classes; ++c)
            if (info.classes[c]->type == XITouchClass)
                direct = reinterpret_cast<const XITouchClassInfo*>(info.classes[c])->mode == XIDirectTouch;
    if (devices != nullptr) XIFreeDeviceInfo(devices);
    return direct;
}

}  // namespace

/// A connection to the X server besides that of GLFW, and the thread that listens: nobody else uses it.
class TouchScreen::Connection {
public:
    Connection(DisplayConnection display, int opcode, std::function<void()> wake)
        : display_(std::move(display)), opcode_(opcode), wake_(std::move(wake)), thread_([this] { listen(); }) {}
    ~Connection() {
        stop_ = true;
        thread_.join();
    }
    std::vector<InputEvent> take() {
        const std::scoped_lock lock(mutex_);
        return std::exchange(events_, {});
    }

private:
    void listen() {
        pollfd socket{.fd = ConnectionNumber(display_.get()), .events = POLLIN, .revents = 0};
        while (!stop_) {
            const double due = fingers_.due_in(glfwGetTime());
            poll(&socket, 1, due < 0.0 ? kPatienceMs : static_cast<int>(1e3 * due) + 1);
            if ((socket.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) return;  // the server has ended
            while (XPending(display_.get()) > 0) take_event();
            fingers_.advance(glfwGetTime());
            hand_over(fingers_.take());
        }
    }
    void take_event() {
        XEvent event;
        XNextEvent(display_.get(), &event);
        XGenericEventCookie& cookie = event.xcookie;
        if (cookie.type != GenericEvent || cookie.extension != opcode_) return;
        if (XGetEventData(display_.get(), &cookie) == False) return;
        if (cookie.evtype >= XI_TouchBegin && cookie.evtype <= XI_TouchEnd)
            touch(*static_cast<const XIDeviceEvent*>(cookie.data));
        else if (cookie.evtype >= XI_GesturePinchBegin && cookie.evtype <= XI_GesturePinchEnd)
            pinch(*static_cast<const XIGesturePinchEvent*>(cookie.data));
        XFreeEventData(display_.get(), &cookie);
    }
    void touch(const XIDeviceEvent& event) {
        const auto finger = static_cast<std::uint32_t>(event.detail);
        const Eigen::Vector2d at(event.event_x, event.event_y);
        if (event.evtype == XI_TouchBegin && touches_screen(display_.get(), event.sourceid))
            fingers_.begin(finger, at, glfwGetTime());
        if (event.evtype != XI_TouchBegin) fingers_.move(finger, at);
        if (event.evtype == XI_TouchEnd) fingers_.end(finger, glfwGetTime());
    }
    /// The scale is that since the pinch began.
    void pinch(const XIGesturePinchEvent& event) {
        const double before = std::exchange(pinched_, event.evtype == XI_GesturePinchUpdate ? event.scale : 1.0);
        if (event.evtype != XI_GesturePinchUpdate || !(before > 0.0) || !(pinched_ > 0.0)) return;
        const Eigen::Vector2d at(event.event_x, event.event_y);
        hand_over(
            {{.kind = InputEvent::Kind::fingers, .cursor = at, .from = at, .zoom = pinched_ / before, .code = 2}});
    }
    void hand_over(std::vector<InputEvent> events) {
        if (events.empty()) return;
        {
            const std::scoped_lock lock(mutex_);
            events_.insert(events_.end(), std::make_move_iterator(events.begin()),
                           std::make_move_iterator(events.end()));
        }
        wake_();
    }

    DisplayConnection display_;
    int opcode_;
    std::function<void()> wake_;
    Fingers fingers_;
    double pinched_ = 1.0;
    std::mutex mutex_;
    std::vector<InputEvent> events_;
    std::atomic<bool> stop_ = false;
    std::thread thread_;  // last: it uses what is above
};

bool TouchScreen::supported() { return true; }

TouchScreen::TouchScreen(GLFWwindow* window, std::function<void()> wake) {
    DisplayConnection display(XOpenDisplay(nullptr));
    if (!display) return;
    int opcode = 0;
    const int version = version_of_xinput(display.get(), opcode);
    if (version < 22) return;
    select_events(display.get(), glfwGetX11Window(window), version);
    connection_ = std::make_unique<Connection>(std::move(display), opcode, std::move(wake));
}

}  // namespace elastolab

#else

namespace elastolab {

class TouchScreen::Connection {
public:
    std::vector<InputEvent> take() { return {}; }
};

bool TouchScreen::supported() { return false; }

TouchScreen::TouchScreen(GLFWwindow*, std::function<void()>) {}

}  // namespace elastolab

#endif

namespace elastolab {

TouchScreen::~TouchScreen() = default;

std::vector<InputEvent> TouchScreen::take() { return connection_ ? connection_->take() : std::vector<InputEvent>(); }

}  // namespace elastolab
