#include "app/x11_client.hpp"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <array>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

namespace elastolab::test {

namespace {

using namespace std::chrono_literals;

constexpr long kXdndVersion = 5;
constexpr auto kPatience = 60s;
constexpr int kMostOtherEvents = 10000;

/// A client of the display, with an invisible window of its own.
class Client {
public:
    Client() : display_(XOpenDisplay(nullptr), &XCloseDisplay) {
        if (!display_) throw std::runtime_error("there is no display");
        own_ = XCreateSimpleWindow(display(), DefaultRootWindow(display()), 0, 0, 1, 1, 0, 0, 0);
    }
    Display* display() const { return display_.get(); }
    Window own() const { return own_; }
    Atom atom(const char* name) const { return XInternAtom(display(), name, False); }

    void send(Window to, const char* type, const std::array<long, 5>& data) const {
        XEvent event{};
        event.xclient = {.type = ClientMessage,
                         .serial = 0,
                         .send_event = True,
                         .display = display(),
                         .window = to,
                         .message_type = atom(type),
                         .format = 32,
                         .data = {}};
        for (std::size_t i = 0; i < data.size(); ++i) event.xclient.data.l[i] = data[i];
        XSendEvent(display(), to, False, NoEventMask, &event);
        XFlush(display());
    }

    /// The next event of ours.
    XEvent next() const {
        const auto deadline = std::chrono::steady_clock::now() + kPatience;
        while (XPending(display()) == 0) {
            if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("the window does not answer");
            std::this_thread::sleep_for(5ms);
        }
        XEvent event;
        XNextEvent(display(), &event);
        return event;
    }
    void wait_for(const char* type) const {
        for (int n_others = 0; n_others < kMostOtherEvents; ++n_others)
            if (const XEvent event = next(); event.type == ClientMessage && event.xclient.message_type == atom(type))
                return;
        throw std::runtime_error("the window says other things only");
    }

    /// Gives the window that asks for it this text.
    void give_selection(const std::string& text) const {
        XEvent event = next();
        while (event.type != SelectionRequest) event = next();
        const XSelectionRequestEvent& request = event.xselectionrequest;
        XChangeProperty(display(), request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
        XEvent answer{};
        answer.xselection = {.type = SelectionNotify,
                             .serial = 0,
                             .send_event = True,
                             .display = display(),
                             .requestor = request.requestor,
                             .selection = request.selection,
                             .target = request.target,
                             .property = request.property,
                             .time = request.time};
        XSendEvent(display(), request.requestor, False, NoEventMask, &answer);
        XFlush(display());
    }

private:
    std::unique_ptr<Display, int (*)(Display*)> display_;
    Window own_ = 0;
};

}  // namespace

void ask_to_close(unsigned long window) {
    const Client client;
    client.send(window, "WM_PROTOCOLS", {static_cast<long>(client.atom("WM_DELETE_WINDOW")), CurrentTime, 0, 0, 0});
    XSync(client.display(), False);
}

/// The drag-and-drop protocol of X ("Xdnd"), as a file manager speaks it.
void drop_file(unsigned long window, const std::filesystem::path& file) {
    const Client client;
    const auto self = static_cast<long>(client.own());
    XSetSelectionOwner(client.display(), client.atom("XdndSelection"), client.own(), CurrentTime);
    client.send(window, "XdndEnter",
                {self, kXdndVersion << 24, static_cast<long>(client.atom("text/uri-list")), None, None});
    client.send(window, "XdndPosition",
                {self, 0, (400L << 16) | 300L, CurrentTime, static_cast<long>(client.atom("XdndActionCopy"))});
    client.wait_for("XdndStatus");
    client.send(window, "XdndDrop", {self, 0, CurrentTime, 0, 0});
    client.give_selection("file://" + file.string() + "\r\n");
    client.wait_for("XdndFinished");
}

}  // namespace elastolab::test
