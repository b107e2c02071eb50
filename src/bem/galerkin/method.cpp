#include "bem/galerkin/method.hpp"

#include "bem/cost.hpp"
#include "bem/galerkin/cost.hpp"
#include "bem/galerkin/hierarchical_model.hpp"
#include "bem/galerkin/model.hpp"

namespace elastolab {

namespace {

std::shared_ptr<const SolidModel> precompute(const SurfaceMesh& surface, const std::string&, double poisson_ratio,
                                             const Method& method, const SolidModel* before, Control& control) {
    if (has_hierarchical_model(surface, method))
        return std::make_shared<HierarchicalGalerkinModel>(
            surface, poisson_ratio, method, dynamic_cast<const HierarchicalGalerkinModel*>(before), control);
    return std::make_shared<GalerkinModel>(surface, poisson_ratio, method, dynamic_cast<const GalerkinModel*>(before),
                                           control);
}

constexpr std::array kModes = {Mode::on_demand, Mode::full};
constexpr std::array kUpdates = {Update::direct, Update::reduced};

}  // namespace

constinit const MethodTraits kGalerkinBemTraits = {
    .name = "galerkin-bem",
    .label = "Galerkin BEM",
    .colour = 3,
    .matrix = "hypersingular matrix",
    .cheaper = "fem, whose matrix is sparse",
    .against_coarseness = "Choose finer rims: they add thin triangles along the rims of the constrained patches.",
    .modes = kModes,
    .updates = kUpdates,
    .chooses_rims = true,
    .full_serves_sets = false,
    .integral_tolerance = 1e-8,
    .integrates_boundary = true,
    .reported_error = kReportedError,
    .precompute = precompute,
    .predict = predict_galerkin_bem,
};

}  // namespace elastolab
