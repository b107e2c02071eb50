#pragma once

#include <functional>
#include <vector>

#include "elasticity/material.hpp"

namespace elastolab {

/// Deformations of a neo-Hookean body of which equilibrium leaves one function unknown, the present radius r(R) of what
/// was at R, with p = dr/dR:
///   F:F = p^2 + a(R) r^2 + constant,    J = b(R) p r^power,    rest volume weight(R) dR
/// Bars bent to a sector, twisted cylinders and spheres that swell are of this kind.
struct RadialForm {
    std::function<double(double R)> a, b, weight;
    int power = 1;
};

/// One end of the range of R: what r and the radial force N = weight * P_rR are there, in terms of one number that the
/// other end decides.
struct RadialStart {
    double r = 0.0, N = 0.0;
};

/// Their equilibrium dN/dR = weight * d psi / dr, by Runge and Kutta's method of fourth order, such that N = 0 at the
/// last of the given R. It shares nothing with finite elements but the energy (elasticity/neo_hookean.hpp).
class RadialEquilibrium {
public:
    /// R      ascending, so near each other that the error of the method is small
    /// start  r and N at R.front() for a number between `low` and `high`, of which N at the end is monotonic
    /// Throws SolveError where no number between them frees the last end.
    RadialEquilibrium(const RadialForm& form, const Material& material, std::vector<double> R,
                      const std::function<RadialStart(double)>& start, double low, double high);

    /// r at R, between the given ones.
    double operator()(double R) const;

private:
    /// N at the end; keeps r and p on the way.
    double integrate(const RadialForm& form, const Material& material, const RadialStart& start);

    std::vector<double> R_, r_, p_;
};

}  // namespace elastolab
