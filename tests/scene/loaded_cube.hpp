#pragma once

#include "scene/file/scene_file.hpp"

namespace elastolab {

/// A cube, fixed at its left face, with weight, a pressure above, a force at its right face and a held front edge.
inline constexpr const char* kLoadedCube = R"({"elastolab": 1,
  "mesh": {"primitive": "cube", "resolution": 4},
  "material": {"young_modulus": 1000.0, "poisson_ratio": 0.3},
  "method": "fem",
  "fixed": {"box": {"min": [0, 0, 0], "max": [0, 1, 1]}},
  "handles": [{"name": "held", "select": {"box": {"min": [0.9, 0, 0], "max": [1, 0.3, 0.3]}}, "translate": [0, 0, 0.01]}],
  "gravity": [0, 0, -9.81], "density": 2.0,
  "loads": [{"name": "above", "select": {"box": {"min": [0, 0, 1], "max": [1, 1, 1]}}, "pressure": 3.0},
            {"select": {"box": {"min": [1, 0.5, 0.5], "max": [1, 1, 1]}}, "force": [5, 0, 1]},
            {"name": "side", "select": {"box": {"min": [0.25, 1, 0], "max": [1, 1, 1]}}, "traction": [0, 2, 0]}]})";

inline Document loaded_cube() { return parse_scene(kLoadedCube, "scene.json"); }

}  // namespace elastolab
