// make_bodies [FOLDER] [NAME...]: writes the meshes that the example scenes use, as OBJ files.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "bodies/clip.hpp"
#include "bodies/remesh.hpp"
#include "bodies/write_obj.hpp"

namespace elastolab::bodies {

void make(const Solid& solid, const std::filesystem::path& folder) {
    Patchwork surface = clip(solid);
    remesh(surface, solid);
    const SurfaceMesh mesh = surface.surface();
    write_obj(folder / (solid.name + ".obj"), mesh);
    std::printf("%s: %d vertices\n", solid.name.c_str(), mesh.n_vertices());
}

}  // namespace elastolab::bodies

int main(int argc, char** argv) try {
    const std::filesystem::path folder = argc > 1 ? argv[1] : ".";
    const std::vector<std::string> names(argv + std::min(argc, 2), argv + argc);
    for (const auto& solid : elastolab::bodies::all_bodies())
        if (names.empty() || std::find(names.begin(), names.end(), solid.name) != names.end())
            elastolab::bodies::make(solid, folder);
} catch (const std::exception& error) {
    std::fprintf(stderr, "make_bodies: %s\n", error.what());
    return 1;
}
