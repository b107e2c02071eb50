#include "mesh/checks/predicates.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace elastolab {

namespace {

constexpr int sign(double x) { return (x > 0.0) - (x < 0.0); }

/// An exact number: the unevaluated sum of at most N doubles that do not overlap, ascending in magnitude, none zero.
template <std::size_t N>
struct Expansion {
    std::array<double, N> term;
    std::size_t size = 0;

    void push(double x) {
        if (x != 0.0) term[size++] = x;
    }
    int sign_of() const { return size == 0 ? 0 : sign(term[size - 1]); }
};

/// a + b = high + low, exactly.
void two_sum(double a, double b, double& high, double& low) {
    high = a + b;
    const double b_part = high - a;
    low = (a - (high - b_part)) + (b - b_part);
}

Expansion<2> difference(double a, double b) {
    double high, low;
    two_sum(a, -b, high, low);
    Expansion<2> result;
    result.push(low);
    result.push(high);
    return result;
}

/// result + x; Shewchuk's Grow-Expansion.
template <std::size_t N>
void grow(Expansion<N>& result, double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < result.size; ++i) {
        double high, low;
        two_sum(x, result.term[i], high, low);
        if (low != 0.0) result.term[kept++] = low;
        x = high;
    }
    result.size = kept;
    result.push(x);
}

template <std::size_t M, std::size_t N>
Expansion<M + N> sum(const Expansion<M>& a, const Expansion<N>& b) {
    Expansion<M + N> result;
    for (std::size_t i = 0; i < a.size; ++i) result.push(a.term[i]);
    for (std::size_t i = 0; i < b.size; ++i) grow(result, b.term[i]);
    return result;
}

template <std::size_t M, std::size_t N>
Expansion<2 * M * N> product(const Expansion<M>& a, const Expansion<N>& b) {
    Expansion<2 * M * N> result;
    for (std::size_t i = 0; i < a.size; ++i)
        for (std::size_t j = 0; j < b.size; ++j) {
            const double high = a.term[i] * b.term[j];
            grow(result, std::fma(a.term[i], b.term[j], -high));
            grow(result, high);
        }
    return result;
}

template <std::size_t N>
Expansion<N> negated(Expansion<N> a) {
    for (std::size_t i = 0; i < a.size; ++i) a.term[i] = -a.term[i];
    return a;
}

using Difference3 = std::array<Expansion<2>, 3>;

Difference3 differences(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    return {difference(p.x(), q.x()), difference(p.y(), q.y()), difference(p.z(), q.z())};
}

/// u[i] v[j] - u[j] v[i]
Expansion<16> minor(const Difference3& u, const Difference3& v, std::size_t i, std::size_t j) {
    return sum(product(u[i], v[j]), negated(product(u[j], v[i])));
}

int exact_orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& d) {
    const Difference3 u = differences(b, a), v = differences(c, a), w = differences(d, a);
    const auto x = product(minor(u, v, 1, 2), w[0]);
    const auto y = product(minor(u, v, 2, 0), w[1]);
    const auto z = product(minor(u, v, 0, 1), w[2]);
    return sum(sum(x, y), z).sign_of();
}

constexpr double kRounding = 0x1p-53;

}  // namespace

int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d) {
    const Eigen::Vector3d u = b - a, v = c - a, w = d - a;
    const double yz = u.y() * v.z(), zy = u.z() * v.y(), zx = u.z() * v.x(), xz = u.x() * v.z(), xy = u.x() * v.y(),
                 yx = u.y() * v.x();
    const double det = (yz - zy) * w.x() + (zx - xz) * w.y() + (xy - yx) * w.z();
    const double size = (std::abs(yz) + std::abs(zy)) * std::abs(w.x()) +
                        (std::abs(zx) + std::abs(xz)) * std::abs(w.y()) +
                        (std::abs(xy) + std::abs(yx)) * std::abs(w.z());
    if (size == 0.0) return 0;  // every product has an exact zero in it
    constexpr double kBound = (7.0 + 56.0 * kRounding) * kRounding;
    return std::abs(det) > kBound * size ? sign(det) : exact_orientation(a, b, c, d);
}

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    const Eigen::Vector2d u = b - a, v = c - a;
    const double xy = u.x() * v.y(), yx = u.y() * v.x(), det = xy - yx, size = std::abs(xy) + std::abs(yx);
    if (size == 0.0) return 0;
    constexpr double kBound = (3.0 + 16.0 * kRounding) * kRounding;
    if (std::abs(det) > kBound * size) return sign(det);
    const auto ux = difference(b.x(), a.x()), uy = difference(b.y(), a.y());
    const auto vx = difference(c.x(), a.x()), vy = difference(c.y(), a.y());
    return sum(product(ux, vy), negated(product(uy, vx))).sign_of();
}

}  // namespace elastolab
