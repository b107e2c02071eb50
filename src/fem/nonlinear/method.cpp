#include "fem/nonlinear/method.hpp"

#include "fem/nonlinear/cost.hpp"
#include "fem/nonlinear/model.hpp"

namespace elastolab {

namespace {

constexpr std::array kNonlinearModes = {Mode::on_demand};
constexpr std::array kNonlinearUpdates = {Update::direct, Update::reduced};

}  // namespace

constinit const MethodTraits kNonlinearFemTraits = {
    .name = "nonlinear-fem",
    .label = "Nonlinear FEM",
    .colour = 5,
    .matrix = "tangent stiffness",
    .cheaper = "four-node elements, which have an eighth of the unknowns",
    .against_coarseness = "Halve the triangles along the rims of the constrained patches.",
    .modes = kNonlinearModes,
    .updates = kNonlinearUpdates,
    .linear = false,
    .chooses_elements = true,
    .has_inside = true,
    .full_serves_sets = false,
    .sparse = true,
    .takes_incompressible = false,
    .largest_poisson_ratio = 0.499,
    .reported_error = kReportedError,
    .precompute = precompute_nonlinear,
    .predict = predict_nonlinear_fem,
};

}  // namespace elastolab
