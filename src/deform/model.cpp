#include "deform/model.hpp"

#include <algorithm>
#include <cmath>

#include "deform/solid_model.hpp"

namespace elastolab {

namespace {

/// Factor that takes a quantity of this dimension from unit Young's modulus and coordinates times `scale` to the body.
/// A power of two but for E.
double factor(const Dimension& dimension, double E, double scale) {
    return std::pow(E, dimension.young) * std::pow(scale, -dimension.length);
}

/// As a solid has it -> as the body has it.
void rescale(NamedMatrix& matrix, double E, double scale) {
    const MatrixDimensions& dimensions = matrix.dimensions;
    const Eigen::Index border = dimensions.has_border ? 6 : 0;
    const Eigen::Index n_rows = matrix.values.rows() - border, n_cols = matrix.values.cols() - border;
    matrix.values.topLeftCorner(n_rows, n_cols) *= factor(dimensions.nodes, E, scale);
    matrix.values.topRightCorner(n_rows, border) *= factor(dimensions.columns, E, scale);
    matrix.values.bottomLeftCorner(border, n_cols) *= factor(dimensions.rows, E, scale);
    matrix.values.bottomRightCorner(border, border) *= factor(dimensions.corner, E, scale);
}

}  // namespace

Model::Model(Body body, Method method, std::vector<Part> parts, ModelFacts facts)
    : body_(std::move(body)), method_(method), parts_(std::move(parts)), facts_(std::move(facts)) {}

bool Model::serves_sets() const {
    return std::all_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.solid->serves_sets(); });
}

void Model::visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        parts_[i].solid->visit_matrices([&](const NamedMatrix& unit) {
            NamedMatrix matrix = unit;
            rescale(matrix, body_.material.young_modulus, parts_[i].scale);
            if (parts_.size() > 1) matrix.name += "-solid" + std::to_string(i + 1);
            visit(matrix);
        });
}

void Model::visit_sparse_stiffness(
    const std::function<void(const std::string& name, const SparseStiffness&)>& visit) const {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (const SparseStiffness* K = parts_[i].solid->sparse_stiffness()) {
            const SparseStiffness scaled = *K * factor(kNodalStiffness, body_.material.young_modulus, parts_[i].scale);
            visit(parts_.size() > 1 ? "K-solid" + std::to_string(i + 1) : "K", scaled);
        }
}

}  // namespace elastolab
