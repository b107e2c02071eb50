#include "study/error/radial_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"

namespace elastolab {

namespace {

/// Energy of the form, differentiated.
struct RadialLaw {
    const RadialForm& form;
    double mu, lambda;

    double log_J(double R, double r, double p) const { return std::log(form.b(R) * p) + form.power * std::log(r); }
    /// p such that weight * (mu p - (mu - lambda ln J) / p) = N, by Newton's method.
    double stretch(double R, double r, double N, double guess) const {
        constexpr int kMostSteps = 60;
        const double wanted = N / form.weight(R);
        double p = guess;
        for (int i = 0; i < kMostSteps; ++i) {
            const double c = mu - lambda * log_J(R, r, p);
            const double step = (mu * p - c / p - wanted) / (mu + (c + lambda) / (p * p));
            p = std::max(p - step, 0.2 * p);
            if (std::abs(step) <= 1e-15 * p) break;
        }
        return p;
    }
    double dN(double R, double r, double p) const {
        return form.weight(R) * (mu * form.a(R) * r + form.power * (lambda * log_J(R, r, p) - mu) / r);
    }
};

}  // namespace

double RadialEquilibrium::integrate(const RadialForm& form, const Material& material, const RadialStart& start) {
    const RadialLaw law{form, material.shear_modulus(), material.lame_lambda()};
    double r = start.r, N = start.N, p = law.stretch(R_.front(), r, N, 1.0);
    r_.assign(1, r);
    p_.assign(1, p);
    for (std::size_t i = 0; i + 1 < R_.size(); ++i) {
        const double R = R_[i], h = R_[i + 1] - R;
        const auto slopes = [&](double at, double radius, double force) {
            const double stretch = law.stretch(at, radius, force, p);
            return std::pair(stretch, law.dN(at, radius, stretch));
        };
        const auto [r1, N1] = slopes(R, r, N);
        const auto [r2, N2] = slopes(R + 0.5 * h, r + 0.5 * h * r1, N + 0.5 * h * N1);
        const auto [r3, N3] = slopes(R + 0.5 * h, r + 0.5 * h * r2, N + 0.5 * h * N2);
        const auto [r4, N4] = slopes(R + h, r + h * r3, N + h * N3);
        r += h / 6.0 * (r1 + 2.0 * r2 + 2.0 * r3 + r4);
        N += h / 6.0 * (N1 + 2.0 * N2 + 2.0 * N3 + N4);
        p = law.stretch(R + h, r, N, p);
        r_.push_back(r);
        p_.push_back(p);
    }
    return N;
}

RadialEquilibrium::RadialEquilibrium(const RadialForm& form, const Material& material, std::vector<double> R,
                                     const std::function<RadialStart(double)>& start, double low, double high)
    : R_(std::move(R)) {
    constexpr int kHalvings = 60;  // as many as a double has digits, and some
    const auto end = [&](double number) { return integrate(form, material, start(number)); };
    const double at_low = end(low), at_high = end(high);
    if (!(at_low * at_high <= 0.0)) throw SolveError("no radial equilibrium in this range");
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        const bool same_side = end(middle) * at_low > 0.0;
        (same_side ? low : high) = middle;
    }
    end(0.5 * (low + high));
}

/// Cubic between two of the given ones, by their values and slopes.
double RadialEquilibrium::operator()(double R) const {
    const auto after = std::upper_bound(R_.begin() + 1, R_.end() - 1, R);
    const auto i = static_cast<std::size_t>(after - R_.begin()) - 1;
    const double h = R_[i + 1] - R_[i], t = (R - R_[i]) / h, s = 1.0 - t;
    return s * s * (1.0 + 2.0 * t) * r_[i] + t * t * (1.0 + 2.0 * s) * r_[i + 1] +
           h * t * s * (s * p_[i] - t * p_[i + 1]);
}

}  // namespace elastolab
