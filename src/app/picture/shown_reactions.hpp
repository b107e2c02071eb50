#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/picture/reaction_runner.hpp"
#include "scene/live/embedded_runner.hpp"
#include "scene/live/live_scene.hpp"

namespace elastolab {

/// Force and moment that the world exerts on the body through one handle or fixed set, and where it is.
struct ShownReaction {
    std::string name;
    bool fixed = false;                    ///< a fixed set
    Eigen::Vector3d force, moment, place;  ///< [force], [force * L] about the origin, mean position as shown [L]
    Eigen::Vector3d middle;                ///< mean position of where forces act: at rest, of linear methods [L]
    Eigen::Vector3d moment_about_middle() const { return moment - middle.cross(force); }
};

/// Of every fixed set, then of every handle, as far as the answer knows them by their names; on a proxy not of a fixed
/// set whose vertices there belong to others. None while the answer's constrained set is another than that of the
/// reactions. known: reactions of answer.surface(); positions: of the shown vertices, as shown.
std::vector<ShownReaction> shown_reactions(const LiveScene& scene, const EmbeddedRunner& answer,
                                           const ReactionRunner& known, const Positions& positions);

}  // namespace elastolab
