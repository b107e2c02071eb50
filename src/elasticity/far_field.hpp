#pragma once

#include "elasticity/gauss_rules.hpp"

namespace elastolab {

/// Chooses between the closed form and Gauss rules for the integral over one triangle, from the distance of the source
/// and a tolerance on the error relative to the integral. Near the triangle only the closed form is exact; far away it
/// loses digits by cancellation (errors up to 2e-14 d^3 at d edge lengths) while every Gauss rule gains them. The error
/// bounds behind the choice are measured in tests/elasticity/far_field_test.cpp.
class FarField {
public:
    explicit FarField(double tolerance);

    /// The cheapest rule that keeps the tolerance, nullptr for the closed form; where none does, the most accurate one.
    /// distance: of the source from the triangle's centroid, in units of the triangle's longest edge.
    const GaussRule* rule(double distance) const {
        if (distance >= from_3_) return &gauss_rule_3();
        if (distance >= from_7_) return &gauss_rule_7();
        if (distance <= closed_form_until_) return nullptr;
        return distance >= from_16_ ? &gauss_rule_16() : nullptr;
    }

private:
    double from_3_, from_7_, from_16_, closed_form_until_;
};

}  // namespace elastolab
