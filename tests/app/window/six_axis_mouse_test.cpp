// The connection to a six-axis mouse's daemon, which is a fake here: a socket that speaks as spacenavd's first
// protocol.
#include "app/window/six_axis_mouse.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "support/temporary_folder.hpp"
#include "support/wait_until.hpp"

namespace elastolab::test {
namespace {

/// Listens where SPNAV_SOCKET then points.
class FakeDaemon {
public:
    FakeDaemon() {
        const std::string path = (folder_.path() / "spnav.sock").string();
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        path.copy(address.sun_path, sizeof(address.sun_path) - 1);
        listening_ = socket(AF_UNIX, SOCK_STREAM, 0);
        EXPECT_EQ(bind(listening_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
        EXPECT_EQ(listen(listening_, 1), 0);
        setenv("SPNAV_SOCKET", path.c_str(), 1);
    }
    ~FakeDaemon() {
        hang_up();
        close(listening_);
        unsetenv("SPNAV_SOCKET");
    }
    void take_client() { client_ = accept(listening_, nullptr, nullptr); }
    /// x, y, z, rx, ry, rz, and milliseconds since the event before.
    void send_motion(const std::array<std::int32_t, 7>& motion) const {
        std::array<std::int32_t, 8> packet{};
        std::copy(motion.begin(), motion.end(), packet.begin() + 1);
        EXPECT_EQ(write(client_, packet.data(), sizeof(packet)), static_cast<ssize_t>(sizeof(packet)));
    }
    void hang_up() {
        if (client_ >= 0) close(client_);
        client_ = -1;
    }

private:
    TemporaryFolder folder_;
    int listening_ = -1, client_ = -1;
};

TEST(SixAxisMouse, SumsUpWhatItsDaemonSends) {
    if (!SixAxisMouse::supported()) GTEST_SKIP() << "built without libspnav";
    FakeDaemon daemon;
    std::atomic<int> woken = 0;
    SixAxisMouse mouse([&] { ++woken; });
    ASSERT_TRUE(mouse.connected());
    daemon.take_client();
    EXPECT_FALSE(mouse.take().has_value());
    for (int i = 0; i < 3; ++i) daemon.send_motion({350, 0, 70, 0, -35, 0, 10});
    SixAxisMotion sum;
    ASSERT_TRUE(wait_until([&] {
        if (const auto motion = mouse.take()) {
            sum.shift += motion->shift;
            sum.turn += motion->turn;
        }
        return sum.shift.x() > 0.029;
    }));
    EXPECT_LT((sum.shift - Eigen::Vector3d(0.03, 0.0, -0.006)).norm(), 1e-12) << "towards the eye is positive";
    EXPECT_LT((sum.turn - Eigen::Vector3d(0.0, -0.003, 0.0)).norm(), 1e-12);
    EXPECT_GT(woken, 0);
    daemon.hang_up();  // a daemon that ends moves nothing any more, and ends no program
    EXPECT_FALSE(mouse.take().has_value());
}

TEST(SixAxisMouse, IsStillWithoutADaemon) {
    setenv("SPNAV_SOCKET", "/nonexistent/spnav.sock", 1);
    SixAxisMouse mouse([] {});
    unsetenv("SPNAV_SOCKET");
    EXPECT_FALSE(mouse.connected());
    EXPECT_FALSE(mouse.take().has_value());
}

}  // namespace
}  // namespace elastolab::test
