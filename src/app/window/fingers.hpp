#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <vector>

#include "app/window/input_event.hpp"

namespace elastolab {

/// What fingers on a touch screen mean: one is the left button of the mouse, two move and zoom the view, three turn it.
/// The first finger presses once it moves, is lifted, or has rested so long that no second one will follow: two fingers
/// never come at the same instant, and the first must not paint or pull meanwhile. Fingers that come later than that
/// mean nothing until all are lifted. Times in seconds, by any clock; places in logical pixels.
class Fingers {
public:
    void begin(std::uint32_t finger, const Eigen::Vector2d& at, double now);
    void move(std::uint32_t finger, const Eigen::Vector2d& to);
    void end(std::uint32_t finger, double now);
    /// Lets a finger press that has rested long enough.
    void advance(double now);
    /// Seconds until advance() has something to do; negative: nothing is to come.
    double due_in(double now) const;

    /// Events since the last call, in order; their times and modifiers are not set.
    std::vector<InputEvent> take();

private:
    enum class Phase { none, waiting, pressed, view, spent };
    struct Finger {
        std::uint32_t id = 0;
        Eigen::Vector2d at = Eigen::Vector2d::Zero();
    };
    /// Where fingers are as a whole.
    struct Spread {
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        double size = 0.0;  ///< mean distance from the middle
    };

    Finger* find(std::uint32_t id);
    Spread spread() const;
    void put_cursor(const Eigen::Vector2d& at);
    void press(bool down);
    void move_view();

    Phase phase_ = Phase::none;
    std::vector<Finger> fingers_;
    std::uint32_t first_ = 0;  ///< the one that is the left button
    double began_ = 0.0;
    Eigen::Vector2d began_at_ = Eigen::Vector2d::Zero();
    Spread before_;
    double tapped_ = -1e9;
    Eigen::Vector2d tapped_at_ = Eigen::Vector2d::Zero();
    std::vector<InputEvent> events_;
};

}  // namespace elastolab
