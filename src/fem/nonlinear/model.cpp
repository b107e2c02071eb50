#include "fem/nonlinear/model.hpp"

#include "base/error.hpp"
#include "deform/holds.hpp"
#include "deform/ten_node_elements.hpp"
#include "fem/nodal_field.hpp"
#include "fem/quadratic_mesh.hpp"
#include "mesh/tets/tetrahedralize.hpp"

namespace elastolab {

namespace {

/// Error that ten-node elements leave, over how much they change the answer of four-node ones; that of linear theory
/// (fem/error_estimate.cpp).
constexpr double kLeftByTenNodes = 0.45;
/// Factors that are held at once: at rest, of the equilibria that are remembered, and the next one.
constexpr std::uint64_t kHeldFactors = 5;
constexpr int kCheckIterations = 30;

std::shared_ptr<const TetMesh> tets_of(const std::shared_ptr<const NonlinearMesh>& mesh) { return {mesh, &mesh->tets}; }

/// The inside from the surface: an equilibrium that was found with this surface, or else the one with all vertices of
/// the surface prescribed.
class NonlinearInterior : public Interior {
public:
    NonlinearInterior(std::shared_ptr<const NonlinearMesh> mesh, const Material& material,
                      std::shared_ptr<const FoundStates> found)
        : mesh_(std::move(mesh)), material_(material), found_(std::move(found)) {}
    const TetMesh& tetrahedra() const override { return mesh_->tets; }
    Eigen::VectorXd extend(const Eigen::VectorXd& surface) const override {
        if (std::optional<Eigen::VectorXd> known = found_->with_surface(surface)) return *std::move(known);
        std::vector<int> vertices(static_cast<std::size_t>(mesh_->n_vertices()));
        for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = static_cast<int>(v);
        const ConstrainedFemNodes nodes = constrain_nodes(mesh_->tets.vertices, mesh_->midpoints, {}, vertices);
        Control control;
        const NonlinearSolver solver(mesh_->elements, material_, {nodes.prescribed.nodes, 0, true}, control);
        return solver.solve(nodes.prescribed.prescribe * surface, false).displacements;
    }

private:
    std::shared_ptr<const NonlinearMesh> mesh_;
    Material material_;
    std::shared_ptr<const FoundStates> found_;
};

class TenNodeNonlinearInterior : public NonlinearInterior, public TenNodeElements {
public:
    using NonlinearInterior::NonlinearInterior;
    Eigen::MatrixXi ten_node_elements() const override { return rejoined(tetrahedra()); }
};

/// A solver that tells a model what it found.
class RememberingSolver : public NonlinearSolver {
public:
    RememberingSolver(const NonlinearMesh& mesh, const Material& material, PrescribedNodes nodes,
                      std::shared_ptr<FoundStates> found, Control& control)
        : NonlinearSolver(mesh.elements, material, std::move(nodes), control), found_(std::move(found)) {}
    NodeSolution solve_task(const NodeTask& task, double tolerance, Control& control) const override {
        NodeSolution solution = NonlinearSolver::solve_task(task, tolerance, control);
        if (task.prescribed.cols() == 1) found_->add(solution.displacements.col(0));
        return solution;
    }

private:
    std::shared_ptr<FoundStates> found_;
};

/// Four nodes an element on the same tetrahedra, from where the ten nodes' corners are.
std::optional<ReferenceAnswer> linear_answer(const NonlinearMesh& mesh, const Material& material,
                                             const std::vector<int>& vertices, const NodeSolution& solution,
                                             Control& control) {
    if (!mesh.linear || !holds(mesh.tets.vertices, vertices)) return {};
    const Newton newton(std::make_shared<const FreeTangent>(mesh.linear, vertices, control), material, 0.0);
    ElementWork work = mesh.linear->make_work();
    Eigen::VectorXd u(3 * mesh.linear->n_nodes());
    for (int v = 0; v < mesh.linear->n_nodes(); ++v)
        u.segment<3>(3 * v) =
            solution.displacements.col(0).segment<3>(3 * mesh.corner_nodes[static_cast<std::size_t>(v)]);
    if (!(newton.energy(u, work, control).least_J > 0.0)) return {};
    const NewtonState state = newton.run(std::move(u), kSolveTolerance, kCheckIterations, work, control);
    if (!state.converged) return {};
    const Eigen::VectorXd forces = mesh.linear->forces(state.u, material, work, control);
    const Positions present = mesh.linear->positions() + state.u.reshaped(3, mesh.linear->n_nodes());
    Eigen::VectorXd at_vertices(3 * std::ssize(vertices));
    for (std::size_t i = 0; i < vertices.size(); ++i)
        at_vertices.segment<3>(3 * static_cast<Eigen::Index>(i)) = forces.segment<3>(3 * vertices[i]);
    return ReferenceAnswer{
        state.u.head(3 * mesh.n_vertices()),
        gathered_reactions(nodal_shares(present, vertices), static_cast<int>(vertices.size()), at_vertices),
        -kLeftByTenNodes};
}

}  // namespace

NonlinearModel::NonlinearModel(const SurfaceMesh& surface, const std::string& name, double poisson_ratio,
                               const Method& method, Control& control)
    : poisson_ratio_(poisson_ratio) {
    TetMesh tets;
    {
        const Stage stage("tetrahedralize", control, facts_.stages);
        tets = tetrahedralize(surface, name, TetOptions{}, control);
    }
    facts_.n_vertices = tets.n_surface_vertices;
    facts_.n_triangles = surface.n_triangles();
    facts_.n_tetrahedra = tets.n_tetrahedra();
    mesh_ = make_nonlinear_mesh(std::move(tets), method.elements);
    facts_.n_degrees_of_freedom = 3 * mesh_->elements->n_nodes();
    {
        const Stage stage("analyse", control, facts_.stages);
        factor_bytes_ = FreeTangent(mesh_->elements, {}, control).analysis().factor_bytes();
    }
    facts_.memory_bytes = factor_bytes_;
}

NonlinearModel::NonlinearModel(const NonlinearModel& before, double poisson_ratio)
    : poisson_ratio_(poisson_ratio), mesh_(before.mesh_), factor_bytes_(before.factor_bytes_) {
    facts_ = before.facts_;
    facts_.stages.clear();
}

std::unique_ptr<ConstrainedSolid> NonlinearModel::constrain(std::span<const int> base, std::span<const int> handles,
                                                            std::span<const UnitLoad> loads, Control& control) const {
    if (!loads.empty())
        throw SolveError("loads: nonlinear-fem does not take them. Choose quadratic-fem, or prescribe displacements.");
    ConstrainedFemNodes nodes = constrain_nodes(mesh_->tets.vertices, mesh_->midpoints, base, handles);
    const bool held = holds(mesh_->tets.vertices, nodes.vertices);
    auto solver = std::make_unique<RememberingSolver>(
        *mesh_, material(), PrescribedNodes{nodes.prescribed.nodes, nodes.n_base, held}, found_, control);
    SolutionChecks checks;
    checks.residual = [its = solver.get()](const NodeSolution& solution, Control& its_control) {
        ElementWork work = its->elements().make_work();
        const Eigen::VectorXd u = solution.displacements.col(0);
        return its->newton().residual(u.lpNorm<Eigen::Infinity>(),
                                      its->elements().forces(u, its->newton().material(), work, its_control));
    };
    checks.reference = [mesh = mesh_, its = material(), vertices = nodes.vertices](
                           const Eigen::VectorXd&, const NodeSolution& solution, Control& its_control) {
        return linear_answer(*mesh, its, vertices, solution, its_control);
    };
    checks.inside = [mesh = mesh_, nu = poisson_ratio_](NodeSolution&& solution, Control&) {
        return std::make_shared<const NodalField>(tets_of(mesh), mesh->elements->degree(), nu,
                                                  std::move(solution.displacements), true);
    };
    return std::make_unique<ConstrainedSolid>(mesh_->n_vertices(), std::move(nodes.prescribed), std::move(nodes.shares),
                                              nullptr, std::move(solver), std::move(checks));
}

std::uint64_t NonlinearModel::constrain_memory(std::span<const int>, std::span<const int>) const {
    const auto n = static_cast<std::uint64_t>(mesh_->elements->nodes_per_element());
    // The element blocks of an assembly, the tangent, and factors.
    const std::uint64_t work = static_cast<std::uint64_t>(mesh_->elements->n_elements()) * 8 * (9 * n * n + 6 * n);
    return kHeldFactors * factor_bytes_ + 2 * work;
}

std::uint64_t NonlinearModel::check_memory(std::span<const int>, std::span<const int>) const {
    return mesh_->linear ? factor_bytes_ / 4 : 0;
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

std::shared_ptr<const Interior> NonlinearModel::interior(Control&) const {
    if (degree() == ElementDegree::quadratic)
        return std::make_shared<const TenNodeNonlinearInterior>(mesh_, material(), found_);
    return std::make_shared<const NonlinearInterior>(mesh_, material(), found_);
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
