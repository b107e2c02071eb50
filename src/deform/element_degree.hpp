#pragma once

namespace elastolab {

/// Degree of the displacements within a tetrahedron.
enum class ElementDegree { linear = 1, quadratic = 2 };

}  // namespace elastolab
