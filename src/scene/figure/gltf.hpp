#pragma once

#include <filesystem>
#include <iosfwd>

#include "scene/figure/figure.hpp"

namespace elastolab {

/// The figure as binary glTF 2.0, for Blender and game engines: the surface at rest with morph targets, one for the
/// scene as it is (weight 1) and six for each handle (weight 0), in single precision. mesh.extras.targetNames has their
/// names, such as "right shift x" and "right turn z". The scene's vertical axis points up. Vertices are about
/// single_precision_origin(), which the node's translation leads to.
void write_glb(std::ostream& out, const Figure& figure);

/// Writes a figure as HTML or, under a name that ends with .glb, as glTF; a file of that name is replaced once the new
/// one is complete. Throws Error.
void save_figure(const std::filesystem::path& file, const Figure& figure);

/// Whether a file is called like binary glTF (.glb).
bool is_glb_file(const std::filesystem::path& file);
/// What a figure in this file is for: those of glTF are shown, others are pulled.
FigureUse use_of(const std::filesystem::path& file);

}  // namespace elastolab
