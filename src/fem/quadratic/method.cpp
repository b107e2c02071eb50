#include "fem/quadratic/method.hpp"

#include "fem/model.hpp"
#include "fem/quadratic/cost.hpp"

namespace elastolab {

namespace {

constexpr std::array kModes = {Mode::on_demand};
constexpr std::array kUpdates = {Update::direct, Update::reduced};

}  // namespace

constinit const MethodTraits kQuadraticFemTraits = {
    .name = "quadratic-fem",
    .label = "Quadratic FEM",
    .colour = 4,
    .matrix = "stiffness matrix",
    .cheaper = "fem, which has an eighth of the degrees of freedom",
    .against_coarseness = "Halve the triangles along the rims of the constrained patches, or choose galerkin-bem.",
    .modes = kModes,
    .updates = kUpdates,
    .has_inside = true,
    .sparse = true,
    .takes_incompressible = false,
    .reported_error = kReportedError,
    .precompute = precompute_fem<ElementDegree::quadratic>,
    .predict = predict_quadratic_fem,
};

}  // namespace elastolab
