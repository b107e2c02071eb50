#include "deform/model.hpp"

#include "deform/solid_model.hpp"

namespace elastolab {

namespace {

void scale(NamedMatrix& matrix, double E) {
    const Eigen::Index n = matrix.values.rows() - 6;
    switch (matrix.scaling) {
        case YoungScaling::none:
            break;
        case YoungScaling::stiffness:
            matrix.values *= E;
            break;
        case YoungScaling::compliance:
            matrix.values /= E;
            break;
        case YoungScaling::bordered_inverse:
            matrix.values.topLeftCorner(n, n) /= E;
            matrix.values.bottomRightCorner(6, 6) *= E;
            break;
    }
}

}  // namespace

Model::Model(Body body, Method method, std::vector<Part> parts, ModelFacts facts)
    : body_(std::move(body)), method_(method), parts_(std::move(parts)), facts_(std::move(facts)) {}

void Model::visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        parts_[i].solid->visit_matrices([&](const NamedMatrix& unit) {
            NamedMatrix matrix = unit;
            scale(matrix, body_.material.young_modulus);
            if (parts_.size() > 1) matrix.name += "-solid" + std::to_string(i + 1);
            visit(matrix);
        });
}

void Model::visit_sparse_stiffness(
    const std::function<void(const std::string& name, const SparseStiffness&)>& visit) const {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (const SparseStiffness* K = parts_[i].solid->sparse_stiffness()) {
            const SparseStiffness scaled = *K * body_.material.young_modulus;
            visit(parts_.size() > 1 ? "K-solid" + std::to_string(i + 1) : "K", scaled);
        }
}

}  // namespace elastolab
