// Probes in the real window.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "app/pixels.hpp"
#include "app/real_window.hpp"
#include "app/screen.hpp"
#include "app/stage.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

/// With the key I, a click on the body keeps a probe, which is marked there; a second click takes it away.
TEST(RealProbe, AClickKeepsItAndItIsMarkedOnTheBody) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    const Screen screen(folder.path() / "cube.json", {640, 480});
    const Eigen::Vector2d place = screen.pixel({0.75, 0.5, 1}), beside(620, 440);
    const auto marked_pixels = [&](int n_clicks) {
        RealWindow window({"cube.json", "--size", "640x480", "--screenshot", "probe.png"}, folder.path());
        window.settle();
        window.key("i");
        for (int i = 0; i < n_clicks; ++i) {
            if (i > 0) std::this_thread::sleep_for(std::chrono::milliseconds(700));  // no double click
            window.click(place);
            window.settle();
        }
        window.move(beside);
        window.settle();
        EXPECT_EQ(window.quit().exit_code, 0);
        const Pixels pixels(folder.path() / "probe.png");
        int marked = 0;
        for (int x = -9; x <= 9; ++x)
            for (int y = -9; y <= 9; ++y) {
                const Eigen::Vector3i colour = pixels.at(place + Eigen::Vector2d(x, y));
                marked += (colour - Eigen::Vector3i(0xf2, 0xc6, 0xff)).cwiseAbs().maxCoeff() < 24;
            }
        return marked;
    };
    EXPECT_EQ(marked_pixels(0), 0);
    EXPECT_GT(marked_pixels(1), 10);
    EXPECT_EQ(marked_pixels(2), 0);
}

}  // namespace
}  // namespace elastolab::test
