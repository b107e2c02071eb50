#include "app/files/export_source.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/input/export.hpp"
#include "scene/field_export.hpp"
#include "scene/figure/gltf.hpp"

namespace elastolab {

namespace fs = std::filesystem;

ExportSource export_source(const LiveScene& scene, const EmbeddedRunner& answer, const Eigen::Vector3d& vertical) {
    ExportSource source{.shown = scene.surface(),
                        .proxy = nullptr,
                        .deformer = nullptr,
                        .values = {},
                        .displacement = answer.displacement(),
                        .simulated_displacement = {},
                        .vertical = vertical,
                        .carried = {}};
    const MethodRunner& runner = answer.runner();
    if (!answer.has_answer() || !answer.shows(scene.mesh()) || !runner.solved()) return source;
    if (answer.proxy() != nullptr) source.proxy = std::make_shared<const Proxy>(*answer.proxy());
    source.deformer = runner.deformer();
    source.values = runner.values();
    source.of_present_set = source.deformer->set() == answer.constraints().set;
    if (source.of_present_set) source.groups = answer.constraints().groups;
    source.simulated_displacement = runner.displacement();
    source.converged = runner.converged();
    source.approach = runner.approach();
    if (!source.converged && answer.carried() != nullptr) source.carried = *answer.carried();
    return source;
}

namespace {

void write_moved_mesh(const fs::path& file, const ExportSource& source) {
    SurfaceMesh mesh = *source.shown;
    if (source.displacement.size() == mesh.vertices.size())
        mesh.vertices += Eigen::Map<const Eigen::Matrix3Xd>(source.displacement.data(), 3, mesh.vertices.cols());
    save_surface(file, mesh);
}

/// What is shown first is not what is written.
ExportSource converged(ExportSource source, Control& control) {
    source.simulated_displacement = source.deformer->displace(source.values, control, kSolveTolerance, source.approach);
    source.displacement =
        source.carried ? source.carried->displacement(source.simulated_displacement) : source.simulated_displacement;
    source.converged = true;
    return source;
}

SolvedBody solved_body(const ExportSource& source, Control& control) {
    const ConstrainedSet& set = source.deformer->set();
    SolvedBody solved{.shown = source.shown,
                      .proxy = source.proxy,
                      .deformer = source.deformer,
                      .values = source.values,
                      .displacement = source.displacement,
                      .simulated_displacement = source.simulated_displacement,
                      .constrained = set.fixed,
                      .forces = source.deformer->answer(source.values, {}, control).reactions.forces};
    solved.constrained.insert(solved.constrained.end(), set.handles.begin(), set.handles.end());
    return solved;
}

}  // namespace

bool takes_solves(const fs::path& file) { return is_field_file(file) || is_figure_file(file) || is_glb_file(file); }

void write_export(const fs::path& file, const ExportSource& source, Control& control) {
    const bool is_figure = source.deformer && (is_figure_file(file) || is_glb_file(file));
    if (is_figure && !source.of_present_set)
        throw Error(file.string() + ": the present handles have no answer yet. Wait until the method is ready.");
    if (!source.converged) return write_export(file, converged(source, control), control);
    if (is_figure)
        return save_figure(
            file, make_figure(solved_body(source, control), source.groups, source.vertical, use_of(file), control));
    if (source.deformer && is_field_file(file)) return save_field_file(file, solved_body(source, control), control);
    if (takes_solves(file) && lower_case(file.extension().string()) != ".ply")
        throw Error(file.string() + ": there is no answer to write yet. Wait until the method is ready.");
    write_moved_mesh(file, source);
}

}  // namespace elastolab
