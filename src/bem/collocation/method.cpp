#include "bem/collocation/method.hpp"

#include "bem/collocation/cost.hpp"
#include "bem/collocation/model.hpp"
#include "bem/cost.hpp"

namespace elastolab {

namespace {

template <const BoundaryElement& (*element)()>
std::shared_ptr<const SolidModel> precompute(const SurfaceMesh& surface, const std::string&, double poisson_ratio,
                                             const Method& method, const SolidModel* before, Control& control) {
    const bool hierarchical = element == linear_element && is_hierarchical(surface, method);
    return std::make_shared<BemModel>(element(), surface, poisson_ratio, method,
                                      hierarchical ? BemSystem::Storage::hierarchical : BemSystem::Storage::dense,
                                      dynamic_cast<const BemModel*>(before), control);
}

constexpr std::array kSurfaceModes = {Mode::on_demand, Mode::full};

}  // namespace

constinit const MethodTraits kConstantBemTraits = {
    .name = "constant-bem",
    .label = "Constant BEM",
    .colour = 1,
    .matrix = "boundary-element matrix",
    .cheaper = "linear-bem, which needs a quarter",
    .against_coarseness = "Choose galerkin-bem or linear-bem, or refine.",
    .modes = kSurfaceModes,
    .updates = kAllUpdates,
    .shows_averages = true,
    .K_takes_incompressible = false,
    .integral_tolerance = 1e-10,
    .balances_forces = false,
    .integrates_boundary = true,
    .reported_error = kReportedError,
    .precompute = precompute<constant_element>,
    .predict = predict_constant_bem,
};

constinit const MethodTraits kLinearBemTraits = {
    .name = "linear-bem",
    .label = "Linear BEM",
    .colour = 2,
    .matrix = "boundary-element matrix",
    .cheaper = "fem, whose matrix is sparse",
    .against_coarseness = "Choose galerkin-bem, or halve the triangles along the rims of the constrained patches.",
    .modes = kSurfaceModes,
    .updates = kAllUpdates,
    .chooses_tractions = true,
    .integral_tolerance = 1e-10,
    .balances_forces = false,
    .integrates_boundary = true,
    .reported_error = kReportedError,
    .precompute = precompute<linear_element>,
    .predict = predict_linear_bem,
};

}  // namespace elastolab
