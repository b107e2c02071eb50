#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "app/unit_names.hpp"
#include "scene/live/live_scene.hpp"

namespace elastolab {

/// A load as an arrow that can be dragged. It stands on the surface: away from it what pulls, towards it what presses.
/// Gravity points away from the middle of the body.
struct LoadArrow {
    int load = LiveScene::kGravity;                     ///< of the scene
    Eigen::Vector3d place = Eigen::Vector3d::Zero();    ///< where it acts, as shown [L]
    Eigen::Vector3d end = Eigen::Vector3d::Zero();      ///< what the mouse takes hold of [L]
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of the surface at its place, as shown
    bool inward = false;                                ///< points from its end to its place
    /// What the load grows by when the end moves away by one: [force / L], [force / L^3] or [1 / time^2].
    double value_per_length = 1.0;
    bool operator==(const LoadArrow&) const = default;
};

/// A load whose arrow keeps this ratio, and the way it points, while it is dragged; afterwards, as long as it is
/// selected, the way alone, so that its end stays where the mouse has put it.
struct DraggedLoad {
    int load = LiveScene::kGravity;
    std::optional<double> value_per_length = {};
    bool inward = false;
    bool operator==(const DraggedLoad&) const = default;
};

/// About what a force across a body needs, for a unit length of motion, at this distance from where it is held
/// [force / L]: that of a square bar of as much volume and surface, 3EI / distance^3. Infinite where that is unknown.
double bending_stiffness(const LiveScene& scene, double distance);

/// The arrow of a load, or of gravity; nothing where it has no effect. positions: of the surface, as shown; radius: of
/// the scene, which keeps arrows from being too long or too short. A load of size zero has an arrow of no length, whose
/// ratio is such that a force dragged by a length moves its patch by about as much.
std::optional<LoadArrow> load_arrow(const LiveScene& scene, int load, const Positions& positions, double radius);
/// Those of gravity and all loads.
std::vector<LoadArrow> load_arrows(const LiveScene& scene, const Positions& positions, double radius,
                                   const std::optional<DraggedLoad>& dragged = std::nullopt);

/// The arrows at one body: computed anew only when the set, a load or the positions have changed.
class KeptLoadArrows {
public:
    /// As load_arrows(). revision: another one for every change of the positions.
    const std::vector<LoadArrow>& update(const LiveScene& scene, const Positions& positions, std::uint64_t revision,
                                         double radius, const std::optional<DraggedLoad>& dragged);
    int n_computed() const { return n_computed_; }

private:
    struct Key {
        std::uint64_t scene_revision = 0, revision = 0;
        double radius = 0.0;
        std::optional<DraggedLoad> dragged = {};
        bool operator==(const Key&) const = default;
    };
    std::optional<Key> key_;
    std::vector<LoadArrow> arrows_;
    int n_computed_ = 0;
};

/// What a load is given by: three numbers, or one of a pressure.
Eigen::VectorXd load_value(const LiveScene& scene, int load);
/// How large a load is, with its sign if it is a pressure: force, traction, acceleration or pressure.
double load_size(const LiveScene& scene, int load);
/// "force 12", "pressure -3": for rows and marks.
std::string load_text(const LiveScene& scene, int load, const UnitNames& units = {});

}  // namespace elastolab
