#include <algorithm>

#include "bodies/solid.hpp"

namespace elastolab::bodies {

using Eigen::Vector3d;

namespace {

Eigen::AlignedBox3d box(const Vector3d& min, const Vector3d& max) { return {min, max}; }

}  // namespace

std::function<double(const Vector3d&)> sizing(double coarse, const std::vector<FineSpot>& spots) {
    return [=](const Vector3d& p) {
        double length = coarse;
        for (const FineSpot& spot : spots) {
            const double away = std::max((p - spot.center).norm() - spot.radius, 0.0);
            length = std::min(length, spot.edge_length + 0.2 * away);
        }
        return length;
    };
}

Solid make_liver() {
    const Field lobes =
        unite({ellipsoid({-0.5, 0.0, -0.05}, {0.62, 0.5, 0.72}), ellipsoid({0.05, -0.02, 0.2}, {0.6, 0.46, 0.46}),
               ellipsoid({0.8, -0.08, 0.2}, {0.28, 0.38, 0.62}, {1.0, 0.0, -0.22})},
              0.3);
    const Field hollow = ellipsoid({0.3, 0.55, -0.75}, {1.2, 0.7, 0.75});
    const Field notch = limb({{{0.36, -0.9, -0.16}, 0.2}, {{0.36, 0.4, -0.06}, 0.12}});
    const Field groove = limb({{{0.34, -0.44, -0.1}, 0.1}, {{0.27, -0.48, 0.3}, 0.09}, {{0.22, -0.3, 0.66}, 0.06}});
    const Field bladder = limb({{{-0.1, 0.05, -0.3}, 0.07}, {{-0.12, -0.14, -0.58}, 0.13}});
    const Field body = subtract(subtract(subtract(lobes, hollow, 0.2), notch, 0.14), groove, 0.12);
    return {"liver",
            {unite({body, bladder}, 0.06)},
            box({-1.4, -0.8, -1.0}, {1.7, 0.8, 0.9}),
            sizing(0.085, {{{0.33, -0.3, -0.1}, 0.3, 0.06}, {{-0.12, -0.1, -0.55}, 0.2, 0.055}}),
            0.05};
}

Solid make_heart() {
    const Field left = limb({{{0.08, 0.05, 0.5}, 0.5}, {{0.3, -0.1, -0.1}, 0.36}, {{0.4, -0.15, -0.4}, 0.22}}, 0.3);
    const Field right = limb({{{-0.32, -0.2, 0.5}, 0.34}, {{0.1, -0.25, -0.15}, 0.24}}, 0.2);
    const Field atria = unite(
        {ellipsoid({-0.42, 0.08, 0.86}, {0.27, 0.3, 0.3}), ellipsoid({0.46, 0.24, 0.84}, {0.26, 0.28, 0.25})}, 0.1);
    const Field aorta = limb({{{-0.02, 0.02, 0.8}, 0.18},
                              {{-0.04, 0.0, 1.3}, 0.17},
                              {{0.12, 0.06, 1.56}, 0.16},
                              {{0.36, 0.16, 1.6}, 0.15},
                              {{0.54, 0.26, 1.42}, 0.14}},
                             0.12);
    const Field trunk =
        limb({{{-0.16, -0.3, 0.7}, 0.17}, {{0.1, -0.32, 1.06}, 0.15}, {{0.42, -0.26, 1.24}, 0.12}}, 0.1);
    const Field vein = limb({{{-0.44, 0.12, 0.9}, 0.14}, {{-0.46, 0.14, 1.42}, 0.13}});
    const Field muscle = unite({left, right, atria}, 0.16);
    const std::vector<FineSpot> vessels{{{0.05, 0.0, 1.3}, 0.25, 0.06},
                                        {{0.4, 0.2, 1.55}, 0.25, 0.055},
                                        {{-0.45, 0.13, 1.4}, 0.25, 0.05},
                                        {{0.35, -0.28, 1.2}, 0.25, 0.05}};
    return {"heart",
            {unite({muscle, aorta, trunk, vein}, 0.08)},
            box({-0.9, -0.8, -0.8}, {0.9, 0.75, 1.9}),
            sizing(0.085, vessels),
            0.045};
}

Solid make_hand() {
    const Field palm = rounded_box({0.0, 0.0, 0.5}, {0.42, 0.14, 0.47}, 0.13);
    const Field wrist = ellipsoid({0.02, 0.0, -0.25}, {0.29, 0.18, 0.9});
    const Field fingers =
        unite({limb({{{-0.33, 0.0, 0.88}, 0.115}, {{-0.41, -0.01, 1.28}, 0.105}, {{-0.46, -0.1, 1.62}, 0.085}}, 0.08),
               limb({{{-0.11, 0.0, 0.92}, 0.115}, {{-0.13, -0.01, 1.38}, 0.105}, {{-0.14, -0.1, 1.78}, 0.085}}, 0.08),
               limb({{{0.12, 0.0, 0.9}, 0.11}, {{0.16, -0.01, 1.34}, 0.102}, {{0.19, -0.1, 1.68}, 0.083}}, 0.08),
               limb({{{0.33, 0.0, 0.84}, 0.1}, {{0.43, -0.01, 1.16}, 0.09}, {{0.5, -0.08, 1.42}, 0.075}}, 0.08)},
              0.03);
    const Field thumb =
        limb({{{-0.22, -0.03, 0.25}, 0.17}, {{-0.58, -0.1, 0.62}, 0.13}, {{-0.74, -0.2, 0.98}, 0.1}}, 0.1);
    const Field hand = unite({unite({palm, wrist, thumb}, 0.2), fingers}, 0.07);
    const std::vector<FineSpot> digits{{{-0.46, -0.1, 1.62}, 0.12, 0.04},  {{-0.14, -0.1, 1.78}, 0.12, 0.04},
                                       {{0.19, -0.1, 1.68}, 0.12, 0.04},   {{0.5, -0.08, 1.42}, 0.12, 0.038},
                                       {{-0.74, -0.2, 0.98}, 0.14, 0.045}, {{-0.58, -0.1, 0.62}, 0.15, 0.055},
                                       {{-0.2, 0.0, 1.2}, 0.4, 0.05},      {{0.25, 0.0, 1.1}, 0.4, 0.05}};
    return {"hand",
            {hand, half_space({0.0, 0.0, -0.35}, -Vector3d::UnitZ())},
            box({-0.95, -0.4, -0.5}, {0.7, 0.3, 1.95}),
            sizing(0.075, digits),
            0.035};
}

Solid make_rabbit() {
    const Field trunk = unite(
        {ellipsoid({0.0, 0.12, 0.5}, {0.46, 0.52, 0.46}), ellipsoid({0.0, -0.22, 0.64}, {0.33, 0.33, 0.46})}, 0.25);
    const Field head = unite(
        {ellipsoid({0.0, -0.4, 1.22}, {0.29, 0.32, 0.28}), ellipsoid({0.0, -0.68, 1.12}, {0.17, 0.17, 0.14})}, 0.12);
    const Field ear = ellipsoid({0.2, -0.27, 1.8}, {0.145, 0.08, 0.5}, {0.2, 0.12, 1.0});
    const Field haunch = ellipsoid({0.37, 0.16, 0.36}, {0.19, 0.36, 0.34});
    const Field foot = limb({{{0.38, 0.1, 0.12}, 0.12}, {{0.42, -0.42, 0.11}, 0.11}});
    const Field paw = limb({{{0.17, -0.42, 0.6}, 0.14}, {{0.17, -0.58, 0.11}, 0.105}});
    const Field tail = ellipsoid({0.0, 0.68, 0.4}, {0.17, 0.17, 0.17});
    const Field limbs = unite({trunk, mirrored(haunch), mirrored(foot), mirrored(paw), tail}, 0.1);
    const std::vector<FineSpot> spots{
        {{0.2, -0.27, 1.6}, 0.2, 0.055},   {{-0.2, -0.27, 1.6}, 0.2, 0.055},   {{0.28, -0.22, 2.1}, 0.25, 0.04},
        {{-0.28, -0.22, 2.1}, 0.25, 0.04}, {{0.17, -0.58, 0.1}, 0.15, 0.055},  {{-0.17, -0.58, 0.1}, 0.15, 0.055},
        {{0.42, -0.42, 0.1}, 0.15, 0.055}, {{-0.42, -0.42, 0.1}, 0.15, 0.055}, {{0.0, -0.7, 1.12}, 0.15, 0.065}};
    return {"rabbit",
            {unite({unite({limbs, head}, 0.14), mirrored(ear)}, 0.06)},
            box({-0.7, -1.0, -0.15}, {0.7, 0.95, 2.4}),
            sizing(0.085, spots),
            0.04};
}

}  // namespace elastolab::bodies
