#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "cli/info.hpp"
#include "cli/interrupt.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab {

namespace {

struct InfoOptions {
    std::string file;
    bool json = false;
};

SceneMesh load(const std::filesystem::path& file, Control& control) {
    if (is_scene_file(file)) return load_scene_mesh(load_scene(file).mesh, file, control);
    return load_scene_mesh(MeshFile{file.string()}, {}, control);
}

void run_info(const InfoOptions& options) {
    Control control;
    const InterruptGuard interrupt(control);
    const MeshInfo info = inspect(load(options.file, control));
    if (options.json)
        write_info(std::cout, info);
    else
        print_info(std::cout, info);
}

}  // namespace

Command add_info_command(CLI::App& program) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* parser = program.add_subcommand("info", "what a mesh is, its defects, and what each method would cost");
    parser->add_option("file", options->file, "mesh file, or a scene file (.json) for its mesh")->required();
    parser->add_flag("--json", options->json, "as JSON");
    return {parser, [options] { run_info(*options); }};
}

}  // namespace elastolab
