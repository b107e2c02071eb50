#include "fem/method.hpp"

#include "fem/cost.hpp"
#include "fem/model.hpp"

namespace elastolab {

constinit const MethodTraits kLinearFemTraits = {
    .name = "fem",
    .label = "FEM",
    .colour = 0,
    .matrix = "stiffness matrix",
    .cheaper = "a coarser mesh",
    .against_coarseness =
        "Choose galerkin-bem or quadratic-fem, or halve the triangles along the rims of the "
        "constrained patches.",
    .modes = kAllModes,
    .updates = kAllUpdates,
    .has_inside = true,
    .sparse = true,
    .takes_incompressible = false,
    .locks = true,
    .reported_error = kReportedError,
    .precompute = precompute_fem<ElementDegree::linear>,
    .predict = predict_linear_fem,
};

}  // namespace elastolab
