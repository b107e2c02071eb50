#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>

namespace elastolab {

/// What a six-axis mouse was moved by, in axes of the screen: right, up, towards the eye. Deflection times time: a full
/// deflection for a second is about 1.
struct SixAxisMotion {
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rotation vector
};

/// A six-axis mouse (3Dconnexion and others) by way of the daemon spacenavd and libspnav, where the program was built
/// with it and the daemon runs; else it never moves. One at a time.
class SixAxisMouse {
public:
    /// `wake` is called on a thread of its own when take() will find something.
    explicit SixAxisMouse(std::function<void()> wake);
    ~SixAxisMouse();
    SixAxisMouse(const SixAxisMouse&) = delete;
    SixAxisMouse& operator=(const SixAxisMouse&) = delete;

    /// Whether the program was built with libspnav.
    static bool supported();
    /// Whether there is a daemon: at the socket that the variable SPNAV_SOCKET names, or at its usual place.
    bool connected() const { return connection_ != nullptr; }
    /// The sum of what came since the last call; nothing where nothing did.
    std::optional<SixAxisMotion> take();

private:
    class Connection;
    std::unique_ptr<Connection> connection_;
};

}  // namespace elastolab
