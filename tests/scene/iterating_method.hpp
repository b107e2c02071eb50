#pragma once

#include "bem/collocation/method.hpp"
#include "bem/collocation/model.hpp"

namespace elastolab::test {

/// Linear BEM that iterates on surfaces of any size.
inline Method iterating_linear_bem() {
    static const MethodTraits traits = [] {
        MethodTraits its = kLinearBemTraits;
        its.precompute = [](const SurfaceMesh& surface, const std::string&, double poisson_ratio, const Method& method,
                            const SolidModel*, Control& control) -> std::shared_ptr<const SolidModel> {
            return std::make_shared<BemModel>(linear_element(), surface, poisson_ratio, method,
                                              BemSystem::Storage::hierarchical, nullptr, control);
        };
        return its;
    }();
    return {.kind = &traits};
}

}  // namespace elastolab::test
