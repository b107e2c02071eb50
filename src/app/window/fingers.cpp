#include "app/window/fingers.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

namespace elastolab {

namespace {

constexpr double kTogether = 0.08;         ///< [s] fingers that come within this belong together
constexpr double kRestPixels = 6.0;        ///< a finger that moved no further rests
constexpr double kSecondTap = 0.35;        ///< [s] a tap within this after another, and as near, is at the same place:
constexpr double kSecondTapPixels = 24.0;  ///< a fingertip does not find it to the pixel
constexpr double kLeastSpread = 8.0;       ///< [px] fingers as near as this do not zoom: their distance is mostly noise
/// Where no cursor is: a finger that was lifted points at nothing.
const Eigen::Vector2d kNowhere(-1e6, -1e6);

}  // namespace

void Fingers::begin(std::uint32_t finger, const Eigen::Vector2d& at, double now) {
    if (find(finger) != nullptr) return;
    fingers_.push_back({finger, at});
    if (phase_ == Phase::none) {
        const bool again = now - tapped_ < kSecondTap && (at - tapped_at_).norm() < kSecondTapPixels;
        phase_ = Phase::waiting;
        first_ = finger;
        began_ = now;
        began_at_ = again ? tapped_at_ : at;
        put_cursor(began_at_);
    } else if (phase_ == Phase::waiting) {
        phase_ = Phase::view;
    }
    before_ = spread();
}

void Fingers::move(std::uint32_t finger, const Eigen::Vector2d& to) {
    Finger* moved = find(finger);
    if (moved == nullptr) return;
    moved->at = to;
    if (phase_ == Phase::waiting && (to - began_at_).norm() > kRestPixels) press(true);
    if (phase_ == Phase::pressed && finger == first_) put_cursor(to);
    if (phase_ == Phase::view) move_view();
}

void Fingers::end(std::uint32_t finger, double now) {
    const Finger* lifted = find(finger);
    if (lifted == nullptr) return;
    if (phase_ == Phase::waiting) {
        press(true);
        tapped_ = now;
        tapped_at_ = began_at_;
    }
    if (phase_ == Phase::pressed && finger == first_) press(false);
    std::erase_if(fingers_, [&](const Finger& one) { return one.id == finger; });
    if (phase_ == Phase::view && fingers_.size() < 2) phase_ = Phase::spent;
    if (fingers_.empty()) {
        phase_ = Phase::none;
        put_cursor(kNowhere);
    }
    before_ = spread();
}

void Fingers::advance(double now) {
    if (phase_ == Phase::waiting && now - began_ >= kTogether) press(true);
}

double Fingers::due_in(double now) const {
    return phase_ == Phase::waiting ? std::max(0.0, began_ + kTogether - now) : -1.0;
}

std::vector<InputEvent> Fingers::take() { return std::exchange(events_, {}); }

Fingers::Finger* Fingers::find(std::uint32_t id) {
    const auto found = std::find_if(fingers_.begin(), fingers_.end(), [&](const Finger& one) { return one.id == id; });
    return found != fingers_.end() ? &*found : nullptr;
}

Fingers::Spread Fingers::spread() const {
    Spread result;
    if (fingers_.empty()) return result;
    const auto n = static_cast<double>(fingers_.size());
    for (const Finger& finger : fingers_) result.middle += finger.at / n;
    for (const Finger& finger : fingers_) result.size += (finger.at - result.middle).norm() / n;
    return result;
}

void Fingers::put_cursor(const Eigen::Vector2d& at) {
    events_.push_back({.kind = InputEvent::Kind::cursor, .cursor = at});
}

void Fingers::press(bool down) {
    const Finger* first = find(first_);
    events_.push_back({.kind = InputEvent::Kind::button,
                       .cursor = down ? began_at_ : first->at,
                       .code = GLFW_MOUSE_BUTTON_LEFT,
                       .pressed = down});
    phase_ = down ? Phase::pressed : Phase::spent;
}

void Fingers::move_view() {
    const Spread now = spread();
    const bool zooms = before_.size > kLeastSpread && now.size > kLeastSpread;
    events_.push_back({.kind = InputEvent::Kind::fingers,
                       .cursor = now.middle,
                       .from = before_.middle,
                       .zoom = zooms ? now.size / before_.size : 1.0,
                       .code = static_cast<int>(fingers_.size())});
    before_ = now;
}

}  // namespace elastolab
