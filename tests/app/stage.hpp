#pragma once

#include <Eigen/Core>
#include <string>

#include "app/panels/layout.hpp"
#include "app/viewer_state.hpp"

namespace elastolab::test {

/// A cube of this many cells, held at x = 0.
Document cube_document(int cells);
/// The same with its face at x = 1 as the handle "end", at rest.
Document cube_document_with_handle(int cells);

/// For the names of tests that run with each method.
std::string test_name(MethodKind kind);

/// Messages that are errors.
int n_errors(const ViewerState& state);

/// The viewer without a window: its state, and what a person's mouse and keys do to it.
class Stage {
public:
    explicit Stage(int cells = 3);

    ViewerState state{[] {}};
    LiveScene& scene() { return state.scene(); }

    /// Opens a document in place of the present one.
    void open(const Document& document);
    /// One frame: takes over what is there.
    void frame();
    /// Frames until nothing is on its way any more.
    void settle();

    /// Where a point, or a vertex as shown, is in the window.
    Eigen::Vector2d pixel(const Eigen::Vector3d& point, std::size_t viewport = 0) const;
    Eigen::Vector2d pixel(int vertex, std::size_t viewport = 0) const;
    Eigen::Vector3d place(int vertex, std::size_t viewport = 0) const;  ///< as shown [L]
    /// In the middle of nothing, within the first viewport.
    Eigen::Vector2d empty_place() const;

    void move(const Eigen::Vector2d& cursor);
    void press(int button = 0);
    void release(int button = 0);
    void key(int code, bool pressed);
    void scroll(double steps);
    void drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int button = 0);
    void click(const Eigen::Vector2d& at);
    int modifiers = 0;     ///< of the events to come
    double seconds = 0.0;  ///< of the clock; every event takes a hundredth
    void wait(double more) { seconds += more; }

    /// The vertex nearest to this point at rest.
    int vertex_near(const Eigen::Vector3d& point) const;
    int hovered() const { return state.gestures.hover().vertex; }
    AffineMotion motion(int handle) const;

private:
    void send(InputEvent event);
    Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
};

}  // namespace elastolab::test
