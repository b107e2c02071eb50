#include "elasticity/far_field.hpp"

#include <algorithm>
#include <cmath>

namespace elastolab {

namespace {

/// A bound error(d) = factor * d^exponent on the relative error at d edge lengths.
struct ErrorBound {
    double factor, exponent;
    double distance_at(double error) const { return std::pow(error / factor, 1.0 / exponent); }
};

constexpr ErrorBound kClosedForm{2e-14, 3.0};
constexpr ErrorBound kGauss3{3e-2, -2.0};
constexpr ErrorBound kGauss7{1e-1, -6.0};
constexpr ErrorBound kGauss16{2.0, -9.0};

/// Where two bounds, one rising and one falling, are equal.
double crossing(const ErrorBound& rising, const ErrorBound& falling) {
    return std::pow(falling.factor / rising.factor, 1.0 / (rising.exponent - falling.exponent));
}

}  // namespace

FarField::FarField(double tolerance)
    : from_3_(kGauss3.distance_at(tolerance)),
      from_7_(kGauss7.distance_at(tolerance)),
      from_16_(crossing(kClosedForm, kGauss16)),
      closed_form_until_(kClosedForm.distance_at(tolerance)) {}

}  // namespace elastolab
