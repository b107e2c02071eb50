#include "fem/method.hpp"

#include "fem/cost.hpp"
#include "fem/model.hpp"

namespace elastolab {

namespace {

std::shared_ptr<const SolidModel> precompute(const SurfaceMesh& surface, const std::string& name, double poisson_ratio,
                                             const Method& method, const SolidModel* before, Control& control) {
    if (const auto* fem = dynamic_cast<const FemModel*>(before))
        return std::make_shared<FemModel>(*fem, poisson_ratio, method, control);
    return std::make_shared<FemModel>(surface, name, poisson_ratio, method, control);
}

}  // namespace

constinit const MethodTraits kLinearFemTraits = {
    .name = "fem",
    .label = "FEM",
    .colour = 0,
    .matrix = "stiffness matrix",
    .cheaper = "a coarser mesh",
    .modes = kAllModes,
    .updates = kAllUpdates,
    .has_inside = true,
    .sparse = true,
    .takes_incompressible = false,
    .locks = true,
    .precompute = precompute,
    .predict = predict_linear_fem,
};

}  // namespace elastolab
