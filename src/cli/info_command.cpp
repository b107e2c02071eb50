#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "cli/info.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/proxy_options.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab {

namespace {

struct InfoOptions {
    std::string file;
    ProxyOptions proxy;
    bool json = false;
};

MeshInfo inspect_file(const InfoOptions& options, Control& control) {
    const bool is_scene = is_scene_file(options.file);
    Document document;
    if (is_scene)
        document = load_scene(options.file);
    else
        document.mesh = MeshFile{options.file};
    ProxyChoice choice = document.proxy;
    options.proxy.apply(choice);
    SceneMesh mesh = load_scene_mesh(document.mesh, is_scene ? options.file : "", control);
    return inspect(std::move(mesh), choice, control);
}

void run_info(const InfoOptions& options) {
    Control control;
    const InterruptGuard interrupt(control);
    const ProgressBar progress(control, true);
    const MeshInfo info = inspect_file(options, control);
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
    options->proxy.add_to(*parser);
    parser->add_flag("--json", options->json, "as JSON");
    return {parser, [options] { run_info(*options); }};
}

}  // namespace elastolab
