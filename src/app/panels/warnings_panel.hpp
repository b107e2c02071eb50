#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "deform/method.hpp"

namespace elastolab {

struct PanelContext;
class ViewerState;

/// Problems and warnings at the bottom of the side panel, so that nothing else in it moves when they come and go.
class WarningsPanel {
public:
    /// While an item is pressed or typed into, they stay as they are, lest they cover it. Returns their height.
    float draw(const PanelContext& context);

    struct Warning {
        std::string text;
        bool is_problem = false;      ///< there is no answer, or a part of it is missing
        MethodKind better = nullptr;  ///< that a button offers instead
    };
    /// What has failed, that changes are not kept, then the warnings of the present answer: first how far displacements
    /// are off, by the mesh or by linear theory, whichever is worse. The body's file stands in place of its whole path,
    /// and methods are called as on their buttons.
    static std::vector<Warning> present(const ViewerState& state);

private:
    std::vector<Warning> warnings_;  ///< as they are shown, of this scene and method:
    std::pair<std::uint64_t, MethodKind> warnings_of_;
    std::set<std::string> unfolded_;  ///< warnings, without their numbers, that are shown with all their lines
};

}  // namespace elastolab
