#include "app/touch_display.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace elastolab::test {

namespace {

constexpr int kWidth = 1280, kHeight = 960;
constexpr int kPatienceMs = 20000;  ///< for the server to start
constexpr const char* kServer = "/usr/lib/xorg/Xorg";

// The driver's protocol: xf86-input-inputtest-protocol.h of the server. Types of touches are those of XInput 2.
constexpr std::int32_t kClientVersion = 0, kWaitForSync = 1, kTouch = 6, kPinch = 7;
constexpr int kBegin = 18, kUpdate = 19, kEnd = 20;
constexpr std::uint16_t kPinchBegin = 27, kPinchUpdate = 28, kPinchEnd = 29;
constexpr double kAxisRange = 65535.0;

struct Header {
    std::uint32_t length;
    std::int32_t type;
};
struct Version {
    Header header;
    std::uint16_t major, minor;
};
struct Touch {
    Header header;
    std::uint32_t finger, type;
    std::uint32_t has_unaccelerated;
    std::array<std::uint8_t, 8> mask;
    alignas(8) std::array<double, 64> valuators;
    std::array<double, 64> unaccelerated;
};

struct Pinch {
    Header header;
    std::uint16_t type, n_fingers;
    std::uint32_t flags;
    std::array<double, 4> shift;
    double scale, turn;
};

std::string device(const std::string& name, const std::string& type, const std::string& socket) {
    return "Section \"InputDevice\"\n  Identifier \"" + name +
           "\"\n  Driver \"inputtest\"\n  Option \"DeviceType\" \"" + type +
           "\"\n  Option \"TouchCount\" \"5\"\n  Option \"SocketPath\" \"" + socket + "\"\nEndSection\n";
}

std::string configuration(const std::string& screen, const std::string& trackpad) {
    return device("fingers", "Touch", screen) + device("trackpad", "PointerGesture", trackpad) +
           R"(Section "ServerFlags"
  Option "AutoAddDevices" "false"
  Option "AutoAddGPU" "false"
  Option "DontVTSwitch" "true"
EndSection
Section "Device"
  Identifier "device"
  Driver "dummy"
  VideoRam 32768
EndSection
Section "Monitor"
  Identifier "monitor"
  HorizSync 5-1000
  VertRefresh 5-200
  Modeline "1280x960" 101.25 1280 1360 1488 1696 960 963 967 996
EndSection
Section "Screen"
  Identifier "screen"
  Device "device"
  Monitor "monitor"
  DefaultDepth 24
  SubSection "Display"
    Depth 24
    Modes "1280x960"
  EndSubSection
EndSection
Section "ServerLayout"
  Identifier "layout"
  Screen "screen"
  InputDevice "fingers"
  InputDevice "trackpad"
EndSection
)";
}

/// A socket of the driver that agrees on the protocol's version; -1: there is none.
int connected(const std::filesystem::path& file) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    file.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    const int driver = socket(AF_UNIX, SOCK_STREAM, 0);
    const Version version{{sizeof(Version), kClientVersion}, 1, 1};
    Version answer{};
    if (connect(driver, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 &&
        write(driver, &version, sizeof(version)) == ssize_t{sizeof(version)} &&
        read(driver, &answer, sizeof(answer)) == ssize_t{sizeof(answer)})
        return driver;
    close(driver);
    return -1;
}

template <class Event>
void send_event(int driver, const Event& event) {
    const Header wait{sizeof(Header), kWaitForSync};
    Header done{};
    if (write(driver, &event, sizeof(event)) != ssize_t{sizeof(event)} ||
        write(driver, &wait, sizeof(wait)) != ssize_t{sizeof(wait)} ||
        read(driver, &done, sizeof(done)) != ssize_t{sizeof(done)})
        throw std::runtime_error("the X server's input is gone");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // as often as devices tell of fingers
}

}  // namespace

TouchDisplay::TouchDisplay() {
    if (const char* before = std::getenv("DISPLAY")) display_before_ = before;
    missing_ = start();
    if (!missing_.empty()) return;
    screen_ = connected(folder_.path() / "screen");
    trackpad_ = connected(folder_.path() / "trackpad");
    if (screen_ < 0 || trackpad_ < 0) missing_ = "Xorg has no driver inputtest that speaks protocol 1.1";
}

TouchDisplay::~TouchDisplay() {
    for (const int driver : {screen_, trackpad_})
        if (driver >= 0) close(driver);
    if (server_ > 0) {
        kill(server_, SIGTERM);
        waitpid(server_, nullptr, 0);
    }
    if (display_before_)
        setenv("DISPLAY", display_before_->c_str(), 1);
    else
        unsetenv("DISPLAY");
}

std::string TouchDisplay::start() {
    if (access(kServer, X_OK) != 0) return "Xorg is not installed";
    if (getuid() != 0) return "only root may start Xorg with a configuration of its own";
    const std::string file =
        folder_.write("xorg.conf", configuration(folder_.path() / "screen", folder_.path() / "trackpad"));
    const std::string log = folder_.path() / "xorg.log";
    std::array<int, 2> number{};
    if (pipe(number.data()) != 0) return "no pipe";
    server_ = fork();
    if (server_ == 0) {
        const int nowhere = open("/dev/null", O_WRONLY);
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        const std::string descriptor = std::to_string(number[1]);
        execl(kServer, "Xorg", "-displayfd", descriptor.c_str(), "-config", file.c_str(), "-logfile", log.c_str(),
              "-noreset", "-nolisten", "tcp", "-novtswitch", "-sharevts", nullptr);
        _exit(127);
    }
    close(number[1]);
    std::string display;
    pollfd told{.fd = number[0], .events = POLLIN, .revents = 0};
    for (char c = 0; poll(&told, 1, kPatienceMs) > 0 && read(number[0], &c, 1) == 1 && c != '\n';) display += c;
    close(number[0]);
    if (display.empty()) return "Xorg does not start";
    setenv("DISPLAY", (":" + display).c_str(), 1);
    return {};
}

void TouchDisplay::begin(int finger, const Eigen::Vector2d& at) { touch(kBegin, finger, at); }
void TouchDisplay::move(int finger, const Eigen::Vector2d& to) { touch(kUpdate, finger, to); }
void TouchDisplay::end(int finger, const Eigen::Vector2d& at) { touch(kEnd, finger, at); }

void TouchDisplay::touch(int type, int finger, const Eigen::Vector2d& at) {
    Touch event{};
    event.header = {sizeof(Touch), kTouch};
    event.finger = static_cast<std::uint32_t>(finger);
    event.type = static_cast<std::uint32_t>(type);
    event.mask[0] = 0b11;
    event.valuators[0] = at.x() * kAxisRange / kWidth;
    event.valuators[1] = at.y() * kAxisRange / kHeight;
    send_event(screen_, event);
}

void TouchDisplay::pinch(double factor) {
    Pinch event{{sizeof(Pinch), kPinch}, kPinchBegin, 2, 0, {}, 1.0, 0.0};
    send_event(trackpad_, event);
    event.type = kPinchUpdate;
    for (int step = 1; step <= 10; ++step) {
        event.scale = std::pow(factor, 0.1 * step);
        send_event(trackpad_, event);
    }
    event.type = kPinchEnd;
    send_event(trackpad_, event);
}

}  // namespace elastolab::test
