#include "fem/nonlinear/model.hpp"

#include "base/error.hpp"
#include "base/memory.hpp"
#include "deform/holds.hpp"
#include "fem/nodal_field.hpp"
#include "fem/nonlinear/halved_answer.hpp"
#include "fem/nonlinear/second_answer.hpp"
#include "fem/quadratic_mesh.hpp"
#include "mesh/tets/tetrahedralize.hpp"

namespace elastolab {

namespace {

/// Factors that are held at once: at rest, and of the last equilibrium or the next one.
constexpr std::uint64_t kHeldFactors = 2;
/// Ten nodes as a second answer to four: on meshes of at most so many tetrahedra, where it takes ten times as long as
/// the answer (cubes of 3142, 6266 tetrahedra: 7 and 10 times); and their factor, over that of four nodes.
constexpr int kMostToCheck = 6000;
constexpr std::uint64_t kTenNodeFactor = 16;

/// Positions, elements, gradients of their shapes, and the elements around each node.
std::uint64_t bytes_of_mesh(const FiniteElements& elements) {
    const auto n = static_cast<std::uint64_t>(elements.nodes_per_element());
    return static_cast<std::uint64_t>(elements.n_elements()) * (104 + 12 * n) +
           static_cast<std::uint64_t>(elements.n_nodes()) * 28;
}

/// What a set takes but for factors: the pattern of the tangent, the tangent and its copy in another order; places of
/// the elements' blocks, and the blocks themselves.
std::uint64_t bytes_of_tangent(const FiniteElements& elements, Eigen::Index entries) {
    const auto n = static_cast<std::uint64_t>(elements.nodes_per_element());
    const std::uint64_t blocks = 8 * (9 * n * (n + 1) / 2 + 3 * n) + 4 * n * n;
    return 3 * 12 * static_cast<std::uint64_t>(entries) + blocks * static_cast<std::uint64_t>(elements.n_elements());
}

std::shared_ptr<const TetMesh> tets_of(const std::shared_ptr<const NonlinearMesh>& mesh) { return {mesh, &mesh->tets}; }

}  // namespace

NonlinearModel::NonlinearModel(const SurfaceMesh& surface, const std::string& name, double poisson_ratio,
                               const Method& method, Control& control)
    : poisson_ratio_(poisson_ratio) {
    TetMesh tets;
    {
        const Stage stage("tetrahedralize", control, facts_.stages);
        tets = tetrahedralize(surface, name, {.growth = method.growth}, control);
    }
    facts_.n_vertices = tets.n_surface_vertices;
    facts_.n_triangles = surface.n_triangles();
    facts_.n_tetrahedra = tets.n_tetrahedra();
    mesh_ = make_nonlinear_mesh(std::move(tets), surface.triangles, method.elements);
    facts_.n_degrees_of_freedom = 3 * mesh_->elements->n_nodes();
    {
        const Stage stage("analyse", control, facts_.stages);
        const FreeTangent all(mesh_->elements, {}, control);
        factor_bytes_ = all.analysis().factor_bytes();
        tangent_bytes_ = bytes_of_tangent(*mesh_->elements, all.make_matrix().nonZeros());
    }
    facts_.memory_bytes = bytes_of_mesh(*mesh_->elements);
}

NonlinearModel::NonlinearModel(const NonlinearModel& before, double poisson_ratio)
    : poisson_ratio_(poisson_ratio),
      mesh_(before.mesh_),
      factor_bytes_(before.factor_bytes_),
      tangent_bytes_(before.tangent_bytes_) {
    facts_ = before.facts_;
    facts_.stages.clear();
}

std::unique_ptr<ConstrainedSolid> NonlinearModel::constrain(std::span<const int> fixed, std::span<const int> handles,
                                                            std::span<const UnitLoad> loads, Control& control) const {
    ConstrainedFemNodes nodes = constrain_nodes(mesh_->tets.vertices, mesh_->midpoints, fixed, handles);
    const bool held = holds(mesh_->tets.vertices, nodes.vertices);
    auto solver = std::make_unique<NonlinearSolver>(
        mesh_->elements, material(), PrescribedNodes{nodes.prescribed.nodes, nodes.n_fixed, held}, control,
        NonlinearLoads{mesh_->elements, mesh_->surface, mesh_->surface_midpoints, loads});
    SolutionChecks checks;
    checks.residual = [its = solver.get()](const NodeSolution& solution, Control& its_control) {
        ElementWork work = its->elements().make_work(false);
        const Eigen::VectorXd u = solution.displacements.col(0);
        const Eigen::VectorXd factors = solution.factors.col(0);
        return its->newton().residual(u.lpNorm<Eigen::Infinity>(), its->newton().forces(u, factors, work, its_control),
                                      u, factors);
    };
    checks.reference = [mesh = mesh_, its = solver.get(), vertices = nodes.vertices,
                        needed = check_memory(fixed, handles),
                        given = std::vector<UnitLoad>(loads.begin(), loads.end())](
                           const Eigen::VectorXd& values, const NodeSolution& solution, Control& its_control) {
        const bool fits = needed > 0 && needed <= available_memory_bytes();
        return second_answer({*mesh, its->newton(), vertices, values, given, solution, fits}, its_control);
    };
    checks.interior_field = [mesh = mesh_, nu = poisson_ratio_](NodeSolution&& solution, Control&) {
        return std::make_shared<const NodalField>(tets_of(mesh), mesh->elements->degree(), nu,
                                                  std::move(solution.displacements), true);
    };
    return std::make_unique<ConstrainedSolid>(mesh_->n_vertices(), std::move(nodes.prescribed), std::move(nodes.shares),
                                              nullptr, std::move(solver), std::move(checks),
                                              static_cast<int>(loads.size()));
}

std::uint64_t NonlinearModel::constrain_memory(std::span<const int>, std::span<const int>) const {
    return kHeldFactors * factor_bytes_ + tangent_bytes_;
}

std::uint64_t NonlinearModel::check_memory(std::span<const int>, std::span<const int>) const {
    if (mesh_->linear) return factor_bytes_ + tangent_bytes_ + halved_answer_memory(*mesh_);
    return mesh_->tets.n_tetrahedra() <= kMostToCheck ? kTenNodeFactor * factor_bytes_ + 8 * tangent_bytes_ : 0;
}

const SparseStiffness* NonlinearModel::sparse_stiffness() const {
    const std::scoped_lock lock(rest_mutex_);
    if (rest_) return rest_.get();
    Control control;
    const FreeTangent all(mesh_->elements, {}, control);
    ElementWork work = mesh_->elements->make_work();
    mesh_->elements->stiffness(Eigen::VectorXd::Zero(all.size()), material(), false, work, control);
    SparseMatrix K = all.make_matrix();
    all.assemble(work, 0.0, K, control);
    rest_ = std::make_unique<const SparseStiffness>(K.selfadjointView<Eigen::Lower>());
    return rest_.get();
}

std::optional<Interior> NonlinearModel::interior() const {
    Interior inside{tets_of(mesh_), mesh_->tets.tetrahedra};
    if (degree() == ElementDegree::quadratic) inside.elements = rejoined(mesh_->tets);
    return inside;
}

std::shared_ptr<const SolidModel> precompute_nonlinear(const SurfaceMesh& surface, const std::string& name,
                                                       double poisson_ratio, const Method& method,
                                                       const SolidModel* before, Control& control) {
    if (const auto* model = dynamic_cast<const NonlinearModel*>(before);
        model != nullptr && model->degree() == method.elements)
        return std::make_shared<const NonlinearModel>(*model, poisson_ratio);
    return std::make_shared<const NonlinearModel>(surface, name, poisson_ratio, method, control);
}

}  // namespace elastolab
