#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/picture/thumbnail.hpp"
#include "base/error.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/solve_outputs.hpp"
#include "scene/constraints.hpp"
#include "scene/file/scene_file.hpp"
#include "scene/scene_mesh.hpp"

namespace elastolab {

namespace {

struct ThumbnailOptions {
    std::string file, picture;
    int size = 256;
};

void run_thumbnail(const ThumbnailOptions& options) {
    Control control;
    const InterruptGuard interrupt(control);
    const bool is_scene = is_scene_file(options.file);
    const MeshSource source = is_scene ? load_scene(options.file).mesh : MeshSource(MeshFile{options.file});
    require_distinct({options.picture}, is_scene ? files_of_scene(options.file, source)
                                                 : std::vector<std::filesystem::path>{options.file});
    const SceneMesh mesh = load_scene_mesh(source, is_scene ? options.file : "", control);
    if (mesh.checked.mesh.n_triangles() == 0)
        throw MeshError(mesh.name + ": it has no triangles to show. Check the file.");
    write_thumbnail(options.picture, mesh.checked.mesh, options.size);
}

}  // namespace

Command add_thumbnail_command(CLI::App& program) {
    const auto options = std::make_shared<ThumbnailOptions>();
    CLI::App* parser = program.add_subcommand("thumbnail", "draws a small picture of a mesh, for file managers");
    parser->add_option("file", options->file, "mesh file, or a scene file (.json) for its mesh")->required();
    parser->add_option("picture", options->picture, "PNG to write")->required();
    parser->add_option("--size", options->size, "its width and height in pixels (default 256)")
        ->check(CLI::Range(kSmallestThumbnail, kLargestThumbnail));
    return {parser, [options] { run_thumbnail(*options); }};
}

}  // namespace elastolab
