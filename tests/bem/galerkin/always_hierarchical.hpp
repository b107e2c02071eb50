#pragma once

#include <memory>
#include <string>

#include "bem/galerkin/hierarchical_model.hpp"
#include "bem/galerkin/method.hpp"

namespace elastolab::test {

inline std::shared_ptr<const SolidModel> precompute_hierarchical(const SurfaceMesh& surface, const std::string&,
                                                                 double poisson_ratio, const Method& method,
                                                                 const SolidModel* before, Control& control) {
    return std::make_shared<HierarchicalGalerkinModel>(surface, poisson_ratio, method,
                                                       dynamic_cast<const HierarchicalGalerkinModel*>(before), control);
}

/// Galerkin BEM that is hierarchical on surfaces of any size.
inline MethodKind always_hierarchical() {
    static const MethodTraits traits = [] {
        MethodTraits its = kGalerkinBemTraits;
        its.precompute = precompute_hierarchical;
        return its;
    }();
    return &traits;
}

}  // namespace elastolab::test
