#include "mesh/checks/predicates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace elastolab {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The truth for small integers times a power of two.
int exact_sign(const Eigen::Matrix<std::int64_t, 3, 4>& p) {
    const auto d = [&](int i, int c) { return p(i, c) - p(i, 0); };
    const std::int64_t det = (d(1, 1) * d(2, 2) - d(2, 1) * d(1, 2)) * d(0, 3) +
                             (d(2, 1) * d(0, 2) - d(0, 1) * d(2, 2)) * d(1, 3) +
                             (d(0, 1) * d(1, 2) - d(1, 1) * d(0, 2)) * d(2, 3);
    return (det > 0) - (det < 0);
}

TEST(Orientation, IsExactOnIntegerLattices) {
    std::mt19937 random(1);
    for (const int range : {3, 100, 500000}) {
        std::uniform_int_distribution<std::int64_t> coordinate(-range, range);
        for (int i = 0; i < 20000; ++i) {
            Eigen::Matrix<std::int64_t, 3, 4> p;
            for (auto& x : p.reshaped()) x = coordinate(random);
            const Eigen::Matrix<double, 3, 4> q = p.cast<double>() * 0x1p-40;
            EXPECT_EQ(orientation(q.col(0), q.col(1), q.col(2), q.col(3)), exact_sign(p));
        }
    }
}

TEST(Orientation, SeesTheLastBit) {
    const Vector3d a(0.1, 0.2, 0.3), b(0.7, 0.1, 0.3), c(0.2, 0.9, 0.3);
    Vector3d d(0.123, 0.456, 0.3);
    EXPECT_EQ(orientation(a, b, c, d), 0);
    d.z() = std::nextafter(0.3, 1.0);
    EXPECT_EQ(orientation(a, b, c, d), 1);
    d.z() = std::nextafter(0.3, 0.0);
    EXPECT_EQ(orientation(a, b, c, d), -1);
}

TEST(Orientation, ChangesSignWithAnySwap) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    const auto point = [&] { return Vector3d(coordinate(random), coordinate(random), coordinate(random)); };
    for (int i = 0; i < 2000; ++i) {
        const Vector3d a = point(), b = point(), c = point();
        const Vector3d d = a + 0.3 * (b - a) + 0.4 * (c - a);  // in the plane, up to rounding
        const int s = orientation(a, b, c, d);
        EXPECT_EQ(orientation(b, a, c, d), -s);
        EXPECT_EQ(orientation(a, b, d, c), -s);
        EXPECT_EQ(orientation(d, b, c, a), -s);
    }
}

TEST(Orientation, InThePlaneIsExactNearALine) {
    const Vector2d a(0.5, 0.5), b(12.0, 12.0), c(24.0, 24.0);
    EXPECT_EQ(orientation(a, b, c), 0);
    EXPECT_EQ(orientation(a, b, Vector2d(24.0, std::nextafter(24.0, 30.0))), 1);
    EXPECT_EQ(orientation(a, b, Vector2d(24.0, std::nextafter(24.0, 0.0))), -1);
}

}  // namespace
}  // namespace elastolab
