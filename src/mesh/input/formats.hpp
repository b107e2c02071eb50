#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace elastolab {

/// Extensions of the files that are read, in lower case. The first four keep every digit (mesh/input/readers), the
/// others go through assimp: its formats that hold surfaces, but not skeletons, terrains or animations.
constexpr std::array<std::string_view, 43> kMeshFormats = {
    "obj", "ply", "off",   "stl", "3d",  "3ds",     "3mf", "ac",   "ac3d", "acc",  "amf",
    "ase", "b3d", "blend", "cob", "dae", "dxf",     "fbx", "glb",  "gltf", "iqm",  "irrmesh",
    "lwo", "lws", "lxo",   "md2", "md3", "md5mesh", "mdl", "ms3d", "nff",  "ogex", "q3o",
    "q3s", "raw", "scn",   "sib", "smd", "x",       "x3d", "xgl",  "zae",  "zgl"};

inline bool is_mesh_format(std::string_view extension) {
    return std::find(kMeshFormats.begin(), kMeshFormats.end(), extension) != kMeshFormats.end();
}

}  // namespace elastolab
