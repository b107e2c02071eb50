#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace elastolab::test {

/// The real program in a real window, driven through the display's own mouse and keys (xdotool).
class RealWindow {
public:
    /// Starts `elastolab view` with these arguments in `folder` and returns when its window is there.
    RealWindow(std::vector<std::string> arguments, const std::filesystem::path& folder);

    /// The mouse, in pixels of the window.
    void move(const Eigen::Vector2d& cursor);
    void press(int button = 1) { tell("mousedown " + std::to_string(button)); }
    void release(int button = 1) { tell("mouseup " + std::to_string(button)); }
    void drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int button = 1);
    void click(const Eigen::Vector2d& at) { drag(at, at); }
    /// Keys as xdotool names them: "ctrl+q".
    void key(const std::string& name, int times = 1);
    /// The same as fingers do: what is held is let go last, and the program has answered before the next stroke. Keys
    /// are not held longer, as they would be repeated.
    void stroke(const std::string& name);
    /// Types a text and Enter.
    void type(const std::string& text);
    /// The same into the field at a place, instead of what it has; settles.
    void type_into(const Eigen::Vector2d& field, const std::string& text);
    void resize(int width, int height);
    /// The cross of its title bar, and a file from a file manager.
    void close();
    void drop(const std::filesystem::path& file);

    /// Returns when the program sleeps because nothing is left to do.
    void settle();
    /// Ctrl+Q, and what the program left behind.
    ProgramRun quit();
    /// Waits for its end, which something else has brought about.
    ProgramRun wait() { return program_.wait(); }
    /// Processor time that it has used [s].
    double processor_seconds() const;
    bool ended() { return program_.ended(); }
    pid_t process() const { return program_.id(); }

private:
    /// What it does at a moment.
    struct Activity {
        bool sleeps = true;    ///< all of its threads, and no other program works for it
        double seconds = 0.0;  ///< of processor time that its threads have used
    };

    void tell(const std::string& command) const;
    std::string moved_to(const Eigen::Vector2d& cursor) const;
    Activity activity() const;
    /// Returns when it has slept at so many looks in a row.
    void settle(int sleeping_looks);

    RunningProgram program_;
    std::string id_;  ///< of the window
};

}  // namespace elastolab::test
