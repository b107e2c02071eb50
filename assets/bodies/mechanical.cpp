#include <algorithm>
#include <cmath>

#include "bodies/solid.hpp"

namespace elastolab::bodies {

using Eigen::Vector3d;

namespace {

/// 0 below 0, 1 above 1, smooth (twice differentiable) between.
double smooth_step(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

/// The sheets of a plate -half < x[axis] < half.
std::vector<Field> faces(int axis, double low, double high) {
    return {half_space(low * Vector3d::Unit(axis), -Vector3d::Unit(axis)),
            half_space(high * Vector3d::Unit(axis), Vector3d::Unit(axis))};
}

std::vector<Field> joined(std::vector<Field> a, const std::vector<Field>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

}  // namespace

Solid make_dog_bone() {
    const Field flanks = [](const Vector3d& p) {
        const double half_width = 0.24 + 0.26 * smooth_step((std::abs(p[0]) - 0.75) / 0.6);
        return std::abs(p[1]) - half_width;
    };
    return {"dog-bone",
            joined(joined({flanks}, faces(0, -2.0, 2.0)), faces(2, -0.15, 0.15)),
            {Vector3d(-2.11, -0.61, -0.23), Vector3d(2.11, 0.61, 0.23)},
            sizing(0.1),
            0.07};
}

Solid make_ring() {
    const Field slot = [](const Vector3d& p) { return 0.1 - std::abs(p[1]) + 10.0 * std::min(p[0], 0.0); };
    return {"ring",
            joined({round_bar(Vector3d::Zero(), 2, 1.0), outside(round_bar(Vector3d::Zero(), 2, 0.72)), slot},
                   faces(2, -0.17, 0.17)),
            {Vector3d(-1.11, -1.11, -0.23), Vector3d(1.11, 1.11, 0.23)},
            sizing(0.075),
            0.06};
}

Solid make_bracket() {
    constexpr double kThick = 0.22, kFillet = 0.25, kHole = 0.13;
    const Field inner = [](const Vector3d& p) {  // inside the wall leg or the arm, a circle where they meet
        const double x = kThick + kFillet - p[0], z = kThick + kFillet - p[2];
        return x > 0.0 && z > 0.0 ? kFillet - std::sqrt(x * x + z * z) : kFillet - std::max(x, z);
    };
    const std::vector<Field> holes{outside(round_bar({0.0, -0.25, 1.05}, 0, kHole)),
                                   outside(round_bar({0.0, 0.25, 1.05}, 0, kHole)),
                                   outside(round_bar({1.1, 0.0, 0.0}, 2, kHole))};
    const std::vector<Field> block = joined(joined(faces(0, 0.0, 1.4), faces(1, -0.5, 0.5)), faces(2, 0.0, 1.4));
    return {"bracket",
            joined(joined({inner}, holes), block),
            {Vector3d(-0.12, -0.62, -0.12), Vector3d(1.52, 0.62, 1.52)},
            sizing(0.095,
                   {{{0.0, -0.25, 1.05}, 0.16, 0.05}, {{0.0, 0.25, 1.05}, 0.16, 0.05}, {{1.1, 0.0, 0.0}, 0.16, 0.05}}),
            0.05};
}

std::vector<Solid> all_bodies() {
    return {make_liver(), make_heart(), make_hand(), make_rabbit(), make_dog_bone(), make_ring(), make_bracket()};
}

}  // namespace elastolab::bodies
