#include "scene/wish.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace elastolab {

namespace {

/// A turn further than this has steps between: short of a half, beyond which another rotation is the shortest [degree].
constexpr double kFarTurn = 150.0, kTurnStep = 90.0;

double farthest_turn(const Wish& to, const Wish* from) {
    double farthest = 0.0;
    for (std::size_t h = 0; h < to.motions.size(); ++h)
        farthest = std::max(farthest, turn_between(from ? from->motions[h] : Motion{}, to.motions[h]));
    return farthest;
}

/// Values a part of the way along; nothing where that cannot be told.
std::optional<Eigen::VectorXd> values_between(const Wish& to, const Wish* from, double part, const Positions& rest) {
    Eigen::VectorXd values = to.values;  // loads, which stand behind the handles, are there at once
    int begin = 0;
    for (std::size_t h = 0; h < to.motions.size(); ++h) {
        const int n = to.ends[h] - begin;
        const Positions own = rest.middleCols(begin, n);
        auto slice = values.segment(3 * begin, 3 * n);
        const std::optional<Motion> motion =
            from ? between(from->motions[h], to.motions[h], part) : part_of(to.motions[h], part, own);
        if (motion)
            slice = displacements(*motion, own).reshaped();
        else if (turn_between(from->motions[h], to.motions[h]) > kFarTurn)
            return std::nullopt;
        else
            slice = (1.0 - part) * from->values.segment(3 * begin, 3 * n) + part * to.values.segment(3 * begin, 3 * n);
        begin = to.ends[h];
    }
    return values;
}

}  // namespace

Wish wish_of(const Constraints& constraints) {
    Wish wish{.values = constraints.values, .motions = constraints.motions};
    for (std::size_t h = 0; h < wish.motions.size(); ++h) wish.ends.push_back(constraints.range_of(h).second);
    return wish;
}

bool same(const Wish& a, const Wish& b) {
    if (a.values.size() != b.values.size() || a.values != b.values) return false;
    if (a.motions.size() != b.motions.size()) return true;
    constexpr double kHalf = 180.0;
    return std::equal(a.motions.begin(), a.motions.end(), b.motions.begin(),
                      [](const Motion& x, const Motion& y) { return turn_between(x, y) < kHalf; });
}

Way way_to(const Wish& to, const Wish* from, const Positions& rest) {
    Way way{.from_rest = from == nullptr, .path = Eigen::MatrixXd(to.values.size(), 0)};
    if (from && from->motions.size() != to.motions.size()) return way;
    const double turn = farthest_turn(to, from);
    if (turn <= kFarTurn) return way;
    const int n = static_cast<int>(std::ceil(turn / kTurnStep));
    way.path.resize(Eigen::NoChange, n - 1);
    for (int i = 1; i < n; ++i) {
        const auto values = values_between(to, from, static_cast<double>(i) / n, rest);
        if (!values) return way_to(to, nullptr, rest);
        way.path.col(i - 1) = *values;
    }
    return way;
}

std::optional<Wish> step_towards(const Wish& to, const Wish& from, double degrees, const Positions& rest) {
    if (to.motions.empty() || from.motions.size() != to.motions.size()) return std::nullopt;
    const double steps = std::round(farthest_turn(to, &from) / degrees);
    if (!(steps > 1.0)) return std::nullopt;
    Wish step = to;
    for (std::size_t h = 0; h < to.motions.size(); ++h) {
        const std::optional<Motion> motion = between(from.motions[h], to.motions[h], 1.0 / steps);
        if (motion)
            step.motions[h] = *motion;
        else if (turn_between(from.motions[h], to.motions[h]) > 0.0)
            return std::nullopt;
    }
    const std::optional<Eigen::VectorXd> values = values_between(to, &from, 1.0 / steps, rest);
    if (!values) return std::nullopt;
    step.values = *values;
    return step;
}

}  // namespace elastolab
