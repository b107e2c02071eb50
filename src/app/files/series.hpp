#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "mesh/output/field_files.hpp"
#include "scene/live/embedded_runner.hpp"
#include "scene/live/live_scene.hpp"

namespace elastolab {

/// Whether a file has a name that a part of this series (.pvd) may get.
bool is_part_of_series(const std::filesystem::path& list, const std::filesystem::path& file);

/// A replayed drag as ParaView's series: NAME.pvd and, beside it, NAME-0000.vtp, NAME-0001.vtp ..., the surface at rest
/// with the fields of each answer.
class SeriesWriter {
public:
    /// list: the .pvd. Throws Error when it cannot be written.
    explicit SeriesWriter(std::filesystem::path list);

    /// Writes a file where the displacements differ from those written last. Solves for the reactions. Throws Error.
    void add(double seconds, const LiveScene& scene, const EmbeddedRunner& answer);
    /// Writes the list. Throws Error.
    void finish() const;

private:
    std::filesystem::path list_;
    std::vector<SeriesStep> steps_;
    Eigen::VectorXd last_;
};

}  // namespace elastolab
