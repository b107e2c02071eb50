#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mesh/refine.hpp"

namespace elastolab {

/// Marks the triangles that touch the rim of a region of coarse triangles.
std::vector<char> around_rim(const RefinedSurface& surface, const std::vector<char>& in_region);

/// Whether a triangle may be cut into one that is `share` times as thin.
using MayBeCut = std::function<bool(const SurfaceMesh& surface, int triangle, double share)>;

/// Adds rows of triangles along the rim of a region of coarse triangles, inside it and outside, ever thinner towards
/// the rim, for fields that are singular there: every edge that leads away from the rim is cut at
/// (i / (rows + 1))^2.5 of its length, i = 1 ... rows. Few vertices are added where most of the error is: none on the
/// rim, but for triangles whose edges all lie on it. Edges from rim to rim through the region or beside it are halved
/// first. reentrant: the same along edges at which faces turn into the body by more than this [rad], as if they lay on
/// the rim.
RefinedSurface add_rows_along_rim(const RefinedSurface& surface, const std::vector<char>& in_region, int rows,
                                  const MayBeCut& may_be_cut, std::optional<double> reentrant = {});

}  // namespace elastolab
