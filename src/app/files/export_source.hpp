#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/control.hpp"
#include "deform/deformer.hpp"
#include "scene/live/embedded_runner.hpp"
#include "scene/live/live_scene.hpp"

namespace elastolab {

/// The answer of a method as it is now, to be written while the scene goes on.
struct ExportSource {
    std::shared_ptr<const SurfaceMesh> shown;
    std::shared_ptr<const Proxy> proxy;        ///< null: shown itself is simulated
    std::shared_ptr<const Deformer> deformer;  ///< null: there is no answer yet
    Eigen::VectorXd values, displacement, simulated_displacement;
    Approach approach = {};                               ///< of a method that is not linear: how to reach `values`
    bool of_present_set = true;                           ///< else the handles have changed since, and groups are empty
    std::vector<ConstraintGroup> groups = {};             ///< of the deformer's set
    Eigen::Vector3d vertical = Eigen::Vector3d::UnitZ();  ///< the axis that points up
    bool converged = true;                      ///< else displacements are solved for again, to kSolveTolerance
    std::optional<CarriedConstraints> carried;  ///< to the shown vertices, where that is so and there is a proxy
};
ExportSource export_source(const LiveScene& scene, const EmbeddedRunner& answer,
                           const Eigen::Vector3d& vertical = Eigen::Vector3d::UnitZ());

/// Writes the moved mesh or what else the ending of `file` stands for (scene/field_export.hpp, scene/figure); solves
/// for the reactions where fields need them. A mesh is written at rest where there is no answer. Throws Error,
/// Cancelled.
void write_export(const std::filesystem::path& file, const ExportSource& source, Control& control);

/// Whether what is written under this name takes solves, and so more than a frame.
bool takes_solves(const std::filesystem::path& file);

}  // namespace elastolab
