#include "study/setups.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"

namespace elastolab {

Body study_body(SurfaceMesh surface, const Material& material, std::string name) {
    return {std::move(name), std::make_shared<const SurfaceMesh>(std::move(surface)), material};
}

Method nonlinear_method(ElementDegree elements) {
    Method method{.kind = kNonlinearFem};
    method.elements = elements;
    return method;
}

std::vector<int> choose_numbers(int n, int count, unsigned seed) {
    std::vector<int> numbers(static_cast<std::size_t>(n));
    std::iota(numbers.begin(), numbers.end(), 0);
    std::mt19937 random(seed);
    // Not std::shuffle, whose result differs from library to library.
    for (int i = 0; i < count; ++i) {
        const auto j = static_cast<std::size_t>(i) + random() % static_cast<unsigned>(n - i);
        std::swap(numbers[static_cast<std::size_t>(i)], numbers[j]);
    }
    numbers.resize(static_cast<std::size_t>(count));
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

std::vector<int> choose_share(int n, double share, unsigned seed) {
    return choose_numbers(n, std::clamp(static_cast<int>(std::lround(share * n)), std::min(3, n), n), seed);
}

Eigen::VectorXd values_at(const Eigen::VectorXd& field, std::span<const int> vertices) {
    Eigen::VectorXd values(3 * std::ssize(vertices));
    for (std::size_t i = 0; i < vertices.size(); ++i)
        values.segment<3>(3 * static_cast<Eigen::Index>(i)) = field.segment<3>(3 * vertices[i]);
    return values;
}

Eigen::MatrixXd translation_basis(std::size_t n_vertices) {
    return Eigen::MatrixXd::Identity(3, 3).replicate(static_cast<Eigen::Index>(n_vertices), 1);
}

double relative_error(const Eigen::VectorXd& u, const Eigen::VectorXd& truth) {
    return (u - truth).stableNorm() / truth.stableNorm();
}

double largest_error(const Eigen::VectorXd& u, const Eigen::VectorXd& truth) {
    return (u - truth).reshaped(3, u.size() / 3).colwise().stableNorm().maxCoeff() /
           truth.reshaped(3, u.size() / 3).colwise().stableNorm().maxCoeff();
}

std::vector<MethodKind> paper_methods() { return {kFem, kConstantBem, kLinearBem}; }

std::string text(MethodKind kind) { return std::string(name(kind)); }

}  // namespace elastolab
