#include "elasticity/pair_rules.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "elasticity/gauss_rules.hpp"

namespace elastolab {

namespace {

/// Appends orbits. A point is given in the complex plane whose origin is the centroid of an equilateral triangle with
/// corners at 1, e^(2 pi i/3), e^(-2 pi i/3): rho e^(i theta), with cos(3 theta) given.
class PairRuleBuilder {
public:
    explicit PairRuleBuilder(int degree) { rule_.degree = degree; }
    /// All combinations of the points of both orbits (and exchanged, if they differ) share this weight.
    PairRuleBuilder& add(double weight, double rho_x, double rho_y, double cosine_y = 1.0) {
        const Orbit x = orbit(rho_x, 1.0), y = rho_x == rho_y ? x : orbit(rho_y, cosine_y);
        const int n = x.n * y.n * (rho_x == rho_y ? 1 : 2);
        rule_.terms.push_back({x.first, x.n, y.first, y.n, weight / n});
        if (rho_x != rho_y) rule_.terms.push_back({y.first, y.n, x.first, x.n, weight / n});
        rule_.n_pairs += n;
        return *this;
    }
    PairRule build() const { return rule_; }

private:
    struct Orbit {
        int first, n;
    };
    /// The centroid, three points on the lines to the corners, or six.
    Orbit orbit(double rho, double cosine) {
        const Orbit result{static_cast<int>(rule_.points.size()), rho == 0.0 ? 1 : cosine == 1.0 ? 3 : 6};
        for (int i = 0; i < result.n; ++i) {
            const double turn = 2.0 * std::numbers::pi / 3.0;
            const double angle = (i < 3 ? 1.0 : -1.0) * std::acos(cosine) / 3.0 + turn * (i % 3);
            std::array<double, 3> point;
            for (int k = 0; k < 3; ++k)
                point[static_cast<std::size_t>(k)] = (1.0 + 2.0 * rho * std::cos(angle - turn * k)) / 3.0;
            rule_.points.push_back(point);
        }
        return result;
    }
    PairRule rule_;
};

PairRule product(const GaussRule& rule) {
    PairRule result{rule.degree, rule.n_points * rule.n_points, {}, {}};
    for (int i = 0; i < rule.n_points; ++i) result.points.push_back(rule.points[static_cast<std::size_t>(i)]);
    for (int i = 0; i < rule.n_points; ++i)
        for (int j = 0; j < rule.n_points; ++j)
            result.terms.push_back(
                {i, 1, j, 1, rule.weights[static_cast<std::size_t>(i)] * rule.weights[static_cast<std::size_t>(j)]});
    return result;
}

/// Newton's method on the Legendre polynomial.
LineRule make_legendre_rule(int n) {
    LineRule rule;
    for (int i = 0; i < n; ++i) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0.0;
        for (int step = 0; step < 100; ++step) {
            double p0 = 1.0, p1 = x;
            for (int k = 2; k <= n; ++k) {
                const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
                p0 = p1;
                p1 = p2;
            }
            slope = n * (x * p1 - p0) / (x * x - 1.0);
            const double change = p1 / slope;
            x -= change;
            if (std::abs(change) < 1e-15) break;
        }
        rule.nodes.push_back(0.5 * (1.0 - x));
        rule.weights.push_back(1.0 / ((1.0 - x * x) * slope * slope));
    }
    return rule;
}

CollapsedRule make_collapsed_rule(int n) {
    CollapsedRule rule;
    const LineRule& line = legendre_rule(n);
    for (std::size_t i = 0; i < line.nodes.size(); ++i)
        for (std::size_t j = 0; j < line.nodes.size(); ++j) {
            const double u = line.nodes[i], v = line.nodes[j];
            rule.points.push_back({1.0 - u, u * (1.0 - v), u * v});
            rule.weights.push_back(2.0 * u * line.weights[i] * line.weights[j]);
        }
    return rule;
}

template <class Rule>
std::vector<Rule> all_rules(Rule (*make)(int)) {
    std::vector<Rule> rules(1);
    for (int n = 1; n <= kMaxLegendre; ++n) rules.push_back(n == 1 ? Rule{} : make(n));
    return rules;
}

}  // namespace

const PairRule& pair_rule_5() {
    static const PairRule rule = PairRuleBuilder(5)
                                     .add(0.17722800925925972, 0.0, 0.0)
                                     .add(0.13894675925925956, 0.0, 6.0 / 7.0)
                                     .add(0.30502216060615861, -0.44656161314697768, -0.44656161314697768)
                                     .add(0.37880307087532195, 0.60386498393349475, 0.60386498393349475)
                                     .build();
    return rule;
}

const PairRule& pair_rule_7() {
    static const PairRule rule = PairRuleBuilder(7)
                                     .add(0.089793242839320359, 0.0, 0.98001035045174811)
                                     .add(-0.33229722841251502, 0.0, 0.85584964205358072)
                                     .add(0.41513918075983319, 0.0, -0.77157869711227123, -0.90361714656328385)
                                     .add(0.129532780132393, 0.70447197653383697, 0.70447197653383697)
                                     .add(0.29154957783109203, 0.34103302497671845, 0.34103302497671845)
                                     .add(0.19888794305318902, -0.39574366907167641, -0.39574366907167641)
                                     .add(0.20739450379668697, 0.72974186423723875, -0.44402757852295305)
                                     .build();
    return rule;
}

const PairRule& pair_rule_8() {
    static const PairRule rule = product(gauss_rule_16());
    return rule;
}

const LineRule& legendre_rule(int n) {
    assert(n >= 2 && n <= kMaxLegendre);
    static const std::vector<LineRule> rules = all_rules(&make_legendre_rule);
    return rules[static_cast<std::size_t>(n)];
}

const CollapsedRule& collapsed_rule(int n) {
    assert(n >= 2 && n <= kMaxLegendre);
    static const std::vector<CollapsedRule> rules = all_rules(&make_collapsed_rule);
    return rules[static_cast<std::size_t>(n)];
}

}  // namespace elastolab
