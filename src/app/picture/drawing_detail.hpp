#pragma once

#include <array>
#include <cstddef>

namespace elastolab {

/// What is left out of a picture while something moves and drawing takes long.
struct DrawingDetail {
    bool soft_shadows = true;   ///< ambient occlusion and the shadow on the ground
    bool wireframe = true;      ///< and ghosts of the body at rest
    bool all_triangles = true;  ///< of large bodies; else some that stand for them
    int samples = 4;            ///< a pixel
    double resolution = 1.0;    ///< of the screen's

    bool operator==(const DrawingDetail&) const = default;
};

/// Chooses the detail of every picture: all of it at rest and wherever that is quick; else, while something moves, as
/// much as can be drawn in kSlowSeconds. The first picture of a body, which somebody waits for, is drawn without soft
/// shadows and smooth edges, and so are those of a motion until more is known to be quick. Knows no clock of its own.
class DetailKeeper {
public:
    static constexpr double kSlowSeconds = 0.05, kRestSeconds = 0.35;

    /// For the picture that is drawn at `now` [s]. moved: it shows something else than the last one. may_try: a moving
    /// picture may have a detail that nobody has seen the cost of, as its shaders are compiled by cores that compute.
    const DrawingDetail& choose(bool moved, double now, bool may_try = true);
    /// What the picture that was chosen last took.
    void took(double seconds);
    /// When the picture with all detail is due, from now [s]; < 0: it is shown already.
    double due_in(double now) const;
    /// Another body is shown, which may take another time.
    void forget() { *this = {}; }

private:
    static constexpr std::size_t kLevels = 7, kFirstLevel = 2;
    static constexpr double kQuickSeconds = kSlowSeconds / 4.0;  ///< where all detail, too, will not be slow
    static const std::array<DrawingDetail, kLevels>& levels();

    std::array<double, kLevels> cost_{};        ///< [s]; 0: not known
    bool is_first_ = true;                      ///< nothing was drawn yet
    std::size_t shown_ = 0, while_moving_ = 0;  ///< levels
    double rest_since_ = -1e9;                  ///< the end of the last picture that moved [s]
};

}  // namespace elastolab
