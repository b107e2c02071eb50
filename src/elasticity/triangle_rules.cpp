#include "elasticity/triangle_rules.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "elasticity/orbit.hpp"

namespace elastolab {

namespace {

struct WeightedOrbit {
    double weight;  ///< of all its points together
    Orbit orbit;
};

/// Orbits of the rules n = 2, 3, ... 8.
const std::vector<std::vector<WeightedOrbit>>& symmetric_orbits() {
    static const std::vector<std::vector<WeightedOrbit>> orbits{
        {},
        {},
        {{1.0, {0.5}}},
        {{0.329855230965965603, {0.72527135947068777}}, {0.670144769034034397, {-0.337845472747894659}}},
        {{0.152534719110620451, {0.810732956525493315}},
         {0.350358827179138098, {0.252139764487268736}},
         {0.497106453710241451, {0.5063770407119655, 0.202961398652525172}}},
        {{0.144315607677787168, {0.0}},
         {0.285274902801853874, {-0.377877764878169468}},
         {0.0973754928695942409, {0.848358315048907074}},
         {0.309652111604154751, {0.48829207674471938}},
         {0.163381885046609966, {0.632455532033675866, 0.481150466497909558}}},
        {{0.0817433291462859664, {0.0}},
         {0.137873890814234184, {0.573516696830306845}},
         {0.0400589064394486988, {0.903833880349169461}},
         {0.205107888977756572, {0.497938048215257275, -0.318632957329632373}},
         {0.151786546243730306, {0.72147921450274915, 0.88256202939109641}},
         {0.383429438378544273, {0.331204600162627724, 0.155956037738698821}}},
        {{0.0771931993213660063, {-0.464652169321414648}},
         {0.131077633614115206, {-0.319173176883380819}},
         {0.188574672653655301, {0.186368844963652233}},
         {0.104388338792126829, {0.617271563375242226}},
         {0.0184987831546770517, {0.936047948640368889}},
         {0.242229346598285577, {0.436120040609425387, 0.563404664451154059}},
         {0.134140639213820674, {0.588030864344106579, 0.388657820029599072}},
         {0.103897386651953354, {0.790915448453606872, 0.955975252608731202}}},
        {{0.0656507441082866719, {-0.466891731086535916}},
         {0.0983650606323760519, {-0.252934158021361768}},
         {0.155322313521874759, {0.179567415073484021}},
         {0.126487766210979053, {0.468383402762369689}},
         {0.0433010990093300028, {0.814600350727382196}},
         {0.014770210807200245, {0.941827116253896855}},
         {0.147994519275382044, {0.663449238073767136, 0.8993076970263033}},
         {0.231429064722364099, {0.413393033569382124, -0.0383971148768208356}},
         {0.086617848681203043, {0.584614395437529215, 0.266216864832406261}},
         {0.0300613730310040306, {0.825950259104181578, 0.931893365997826991}}}};
    return orbits;
}

TriangleRule symmetric_rule(const std::vector<WeightedOrbit>& orbits) {
    TriangleRule rule;
    for (const auto& [weight, orbit] : orbits) {
        const auto points = points_of(orbit);
        rule.points.insert(rule.points.end(), points.begin(), points.end());
        rule.weights.insert(rule.weights.end(), points.size(), weight / static_cast<double>(points.size()));
    }
    return rule;
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

TriangleRule collapsed_rule(int n) {
    TriangleRule rule;
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

TriangleRule make_triangle_rule(int n) {
    const auto i = static_cast<std::size_t>(n);
    return i < symmetric_orbits().size() ? symmetric_rule(symmetric_orbits()[i]) : collapsed_rule(n);
}

}  // namespace

const LineRule& legendre_rule(int n) {
    assert(n >= 2 && n <= kMaxLegendre);
    static const std::vector<LineRule> rules = all_rules(&make_legendre_rule);
    return rules[static_cast<std::size_t>(n)];
}

const TriangleRule& triangle_rule(int n) {
    assert(n >= 2 && n <= kMaxLegendre);
    static const std::vector<TriangleRule> rules = all_rules(&make_triangle_rule);
    return rules[static_cast<std::size_t>(n)];
}

}  // namespace elastolab
