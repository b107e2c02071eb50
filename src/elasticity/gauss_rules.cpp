#include "elasticity/gauss_rules.hpp"

#include <cmath>

namespace elastolab {

namespace {

/// Appends the points that arise from (a, b, c) by permutation, each with this weight.
class RuleBuilder {
public:
    explicit RuleBuilder(int degree) { rule_.degree = degree; }
    RuleBuilder& centroid(double weight) { return add({1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, weight); }
    RuleBuilder& orbit3(double a, double weight) {
        const double b = 0.5 * (1.0 - a);
        return add({a, b, b}, weight).add({b, a, b}, weight).add({b, b, a}, weight);
    }
    RuleBuilder& orbit6(double a, double b, double weight) {
        const double c = 1.0 - a - b;
        return add({a, b, c}, weight)
            .add({b, c, a}, weight)
            .add({c, a, b}, weight)
            .add({a, c, b}, weight)
            .add({c, b, a}, weight)
            .add({b, a, c}, weight);
    }
    GaussRule build() const { return rule_; }

private:
    RuleBuilder& add(const std::array<double, 3>& point, double weight) {
        const auto i = static_cast<std::size_t>(rule_.n_points++);
        rule_.points[i] = point;
        rule_.weights[i] = weight;
        return *this;
    }
    GaussRule rule_;
};

}  // namespace

const GaussRule& gauss_rule_3() {
    static const GaussRule rule = RuleBuilder(2).orbit3(2.0 / 3.0, 1.0 / 3.0).build();
    return rule;
}

const GaussRule& gauss_rule_7() {
    const double root = std::sqrt(15.0);
    static const GaussRule rule = RuleBuilder(5)
                                      .centroid(9.0 / 40.0)
                                      .orbit3((9.0 + 2.0 * root) / 21.0, (155.0 - root) / 1200.0)
                                      .orbit3((9.0 - 2.0 * root) / 21.0, (155.0 + root) / 1200.0)
                                      .build();
    return rule;
}

const GaussRule& gauss_rule_16() {
    static const GaussRule rule = RuleBuilder(8)
                                      .centroid(0.144315607677787168)
                                      .orbit3(0.081414823414553688, 0.095091634267284625)
                                      .orbit3(0.658861384496480146, 0.103217370534718250)
                                      .orbit3(0.898905543365938051, 0.032458497623198080)
                                      .orbit6(0.008394777409957605, 0.263112829634638113, 0.027230314174434995)
                                      .build();
    return rule;
}

}  // namespace elastolab
