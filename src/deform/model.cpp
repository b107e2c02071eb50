#include "deform/model.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "bem/model.hpp"
#include "findings/cost.hpp"
#include "fem/model.hpp"
#include "findings/guards.hpp"
#include "mesh/solids.hpp"

namespace elastolab {

namespace {

using SolidPointer = std::shared_ptr<const SolidModel>;

/// Sums the facts of the solids; the condition is that of the worst.
ModelFacts sum_up(const std::vector<Model::Part>& parts, const SurfaceMesh& surface) {
    ModelFacts sum;
    std::vector<std::vector<int>> vertices;
    for (const Model::Part& part : parts) vertices.push_back(part.vertices);
    sum.warnings = warn_of_contact(surface, vertices);
    for (const Model::Part& part : parts) {
        const ModelFacts& facts = part.solid->facts();
        sum.n_vertices += facts.n_vertices;
        sum.n_triangles += facts.n_triangles;
        sum.n_tetrahedra += facts.n_tetrahedra;
        sum.n_degrees_of_freedom += facts.n_degrees_of_freedom;
        sum.memory_bytes += facts.memory_bytes;
        sum.condition_estimate = std::max(sum.condition_estimate, facts.condition_estimate);
        for (const std::string& warning : facts.warnings)  // that of the material is the same for all
            if (std::find(sum.warnings.begin(), sum.warnings.end(), warning) == sum.warnings.end())
                sum.warnings.push_back(warning);
        for (const StageTime& stage : facts.stages) {
            const auto same = std::find_if(sum.stages.begin(), sum.stages.end(),
                                           [&](const StageTime& other) { return other.name == stage.name; });
            if (same == sum.stages.end())
                sum.stages.push_back(stage);
            else
                same->seconds += stage.seconds;
        }
    }
    return sum;
}

SolidPointer precompute_solid(const Solid& solid, const Body& body, const Method& method, Control& control) {
    const double nu = body.material.poisson_ratio;
    if (method.kind == MethodKind::fem)
        return std::make_shared<FemModel>(solid.surface, body.name, nu, method, control);
    return std::make_shared<BemModel>(solid.surface, nu, method, control);
}

/// Null when nothing of the old model serves.
SolidPointer reuse_solid(const SolidModel& before, double nu, const Method& method, Control& control) {
    if (const auto* fem = dynamic_cast<const FemModel*>(&before); fem && method.kind == MethodKind::fem)
        return std::make_shared<FemModel>(*fem, nu, method, control);
    if (const auto* bem = dynamic_cast<const BemModel*>(&before); bem && method.kind != MethodKind::fem)
        return std::make_shared<BemModel>(*bem, nu, method, control);
    return nullptr;
}

void require_sensible(const Method& method) {
    if (method.mode == Mode::full_volume && method.kind != MethodKind::fem)
        throw SolveError("mode full-volume: boundary elements have no volume. Choose the mode full, or FEM.");
}

}  // namespace

Model::Model(Body body, Method method, std::vector<Part> parts, ModelFacts facts)
    : body_(std::move(body)), method_(method), parts_(std::move(parts)), facts_(std::move(facts)) {}

void Model::visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const {
    const double E = body_.material.young_modulus;
    for (std::size_t i = 0; i < parts_.size(); ++i)
        parts_[i].solid->visit_matrices([&](const NamedMatrix& unit) {
            NamedMatrix matrix = unit;  // of unit Young's modulus: K grows with E, G and K^-1 shrink
            const Eigen::Index n = matrix.values.rows() - 6;
            if (matrix.name == "K") matrix.values *= E;
            if (matrix.name == "G" || matrix.name == "Kinv") matrix.values /= E;
            if (matrix.name == "Khatinv") {
                matrix.values.topLeftCorner(n, n) /= E;
                matrix.values.bottomRightCorner(6, 6) *= E;
            }
            if (parts_.size() > 1) matrix.name += "-solid" + std::to_string(i + 1);
            visit(matrix);
        });
}

bool Model::has_inside() const { return !parts_.empty() && parts_.front().solid->tetrahedra() != nullptr; }

void Model::visit_sparse_stiffness(
    const std::function<void(const std::string& name, const SparseStiffness&)>& visit) const {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (const SparseStiffness* K = parts_[i].solid->sparse_stiffness()) {
            const SparseStiffness scaled = *K * body_.material.young_modulus;
            visit(parts_.size() > 1 ? "K-solid" + std::to_string(i + 1) : "K", scaled);
        }
}

std::shared_ptr<const Model> precompute(const Body& body, const Method& method, Control& control) {
    require_sensible(method);
    require_memory(predict_cost(*body.surface, method), method);
    std::vector<Model::Part> parts;
    for (Solid& solid : split_solids(*body.surface)) {
        const Eigen::Vector3d origin = computing_origin(solid.surface);
        solid.surface.vertices.colwise() -= origin;
        parts.push_back({precompute_solid(solid, body, method, control), solid.vertices, origin});
    }
    ModelFacts facts = sum_up(parts, *body.surface);
    return std::make_shared<const Model>(body, method, std::move(parts), std::move(facts));
}

std::shared_ptr<const Model> precompute_again(const Model& before, const Material& material, const Method& method,
                                              Control& control) {
    Body body = before.body();
    body.material = material;
    require_sensible(method);
    if (method.kind != before.method().kind || method.mode != before.method().mode)
        require_memory(predict_cost(*body.surface, method), method);
    std::vector<Model::Part> parts;
    for (const Model::Part& part : before.parts()) {
        SolidPointer solid = reuse_solid(*part.solid, material.poisson_ratio, method, control);
        if (!solid) return precompute(body, method, control);
        parts.push_back({std::move(solid), part.vertices, part.origin});
    }
    ModelFacts facts = sum_up(parts, *body.surface);
    return std::make_shared<const Model>(std::move(body), method, std::move(parts), std::move(facts));
}

}  // namespace elastolab
