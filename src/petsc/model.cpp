#include "petsc/model.hpp"

#include "base/memory.hpp"
#include "deform/holds.hpp"
#include "fem/error_estimate.hpp"
#include "fem/load_vectors.hpp"
#include "fem/nodal_field.hpp"
#include "mesh/tets/tetrahedralize.hpp"
#include "petsc/session.hpp"

namespace elastolab {

namespace {

std::shared_ptr<PetscStiffness> distribute(const FemMesh& mesh, double poisson_ratio, Control& control) {
    return std::make_shared<PetscStiffness>(mesh.tets.vertices, mesh.elements(), poisson_ratio, control);
}

/// Bytes of the constrained matrix, of GAMG's coarse ones or MUMPS's front, for each node on average.
constexpr double kBytesOfNode = 8000.0;

}  // namespace

PetscFemModel::PetscFemModel(const SurfaceMesh& surface, const std::string& name, double poisson_ratio,
                             const Method& method, Control& control, ElementDegree degree)
    : poisson_ratio_(poisson_ratio), update_(method.update) {
    {
        const Stage stage("tetrahedralize", control, facts_.stages);
        tets_ = std::make_shared<const TetMesh>(tetrahedralize(surface, name, TetOptions{}, control));
    }
    {
        const Stage stage("integrate", control, facts_.stages);
        mesh_ = std::make_shared<const FemMesh>(elements_on(*tets_, surface.triangles, degree));
        stiffness_ = distribute(*mesh_, poisson_ratio, control);
    }
    facts_.n_triangles = surface.n_triangles();
    facts_.n_vertices = mesh_->tets.n_surface_vertices;
    facts_.n_tetrahedra = mesh_->n_elements;
    facts_.n_degrees_of_freedom = 3 * mesh_->tets.n_vertices();
    facts_.memory_bytes = static_cast<std::uint64_t>(8 * mesh_->tets.vertices.size());
}

PetscFemModel::PetscFemModel(const PetscFemModel& before, const Method& method)
    : poisson_ratio_(before.poisson_ratio_),
      update_(method.update),
      tets_(before.tets_),
      mesh_(before.mesh_),
      stiffness_(before.stiffness_) {
    facts_ = before.facts_;
    facts_.stages.clear();
}

/// On the first process's machine. A set that does not hold the body takes its columns for all nodes, four at a time in
/// PetscFreeSolver.
std::uint64_t PetscFemModel::constrain_memory(std::span<const int> fixed, std::span<const int> handles) const {
    constexpr double kColumns = 4.0 * 8.0 * 9.0;
    const auto n_nodes = static_cast<double>(mesh_->tets.n_vertices());
    std::vector<int> vertices(fixed.begin(), fixed.end());
    vertices.insert(vertices.end(), handles.begin(), handles.end());
    double bytes = kBytesOfNode * n_nodes * Session::current().part_on_this_machine();
    if (!holds(mesh_->tets.vertices, vertices)) bytes += kColumns * n_nodes * static_cast<double>(vertices.size());
    return static_cast<std::uint64_t>(bytes);
}

std::uint64_t PetscFemModel::check_memory(std::span<const int>, std::span<const int>) const {
    const FemSystem system{std::shared_ptr<const FemMesh>(mesh_), {}};
    const std::uint64_t all = degree() == ElementDegree::linear ? quadratic_reference_memory(system, true)
                                                                : halved_reference_memory(system, true);
    return static_cast<std::uint64_t>(static_cast<double>(all) * Session::current().part_on_this_machine());
}

std::unique_ptr<ConstrainedSolid> PetscFemModel::constrain(std::span<const int> fixed, std::span<const int> handles,
                                                           std::span<const UnitLoad> loads, Control& control) const {
    ConstrainedFemNodes constrained = constrain_nodes(mesh_->tets.vertices, mesh_->midpoints, fixed, handles);
    const std::vector<int> nodes = constrained.prescribed.nodes;
    const Eigen::MatrixXd given = load_vectors(*mesh_, loads);
    std::unique_ptr<NodeSolver> solver;
    if (update_ == Update::direct || holds(mesh_->tets.vertices, nodes))
        solver = std::make_unique<PetscHeldSolver>(stiffness_, mesh_->tets.vertices, nodes, given, control);
    else
        solver = std::make_unique<PetscFreeSolver>(*stiffness_, mesh_->tets.vertices, mesh_->n_surface_nodes, nodes,
                                                   given, control);
    SolutionChecks checks;
    checks.residual = [K = stiffness_, nodes, given](const NodeSolution& solution, Control& its_control) {
        return petsc_residual(*K, solution.displacements, nodes, solution.loads, given * solution.factors, its_control);
    };
    checks.reference = [this, vertices = constrained.vertices, all = std::vector<UnitLoad>(loads.begin(), loads.end())](
                           Values values, const NodeSolution&, Control& its_control) {
        return degree() == ElementDegree::linear ? better_answer(vertices, all, values, its_control)
                                                 : halved_answer(vertices, all, values, its_control);
    };
    checks.interior_field = [mesh = mesh_, nu = poisson_ratio_](NodeSolution&& solution, Control&) {
        return std::make_shared<const NodalField>(std::shared_ptr<const TetMesh>(mesh, &mesh->tets), mesh->degree(), nu,
                                                  std::move(solution.displacements));
    };
    return std::make_unique<ConstrainedSolid>(mesh_->tets.n_surface_vertices, std::move(constrained.prescribed),
                                              std::move(constrained.shares), nullptr, std::move(solver),
                                              std::move(checks), static_cast<int>(loads.size()));
}

/// As quadratic_reference. The solver of the constrained set, which is still there, is that of the corners, too.
std::optional<ReferenceAnswer> PetscFemModel::better_answer(const std::vector<int>& vertices,
                                                            std::span<const UnitLoad> loads, Values values,
                                                            Control& control) const {
    if (!holds(mesh_->tets.vertices, vertices) || !can_be_judged(poisson_ratio_)) return {};
    if (check_memory({}, {}) > available_memory_bytes()) return {};
    stiffness_->ensure_eliminated(vertices, control);
    const QuadraticMesh mesh(*tets_);
    const PetscStiffness quadratic(mesh.positions, mesh.elements, poisson_ratio_, control);
    const Eigen::Matrix3Xd diagonal = quadratic.diagonal(control);
    ReferenceOperators apply;
    apply.coarse = [&](Values u) -> Eigen::VectorXd { return stiffness_->multiply(u, control); };
    apply.stiffness = [&](Values u) -> Eigen::VectorXd { return quadratic.multiply(u, control); };
    apply.solve_coarse = [&](Values f) -> Eigen::VectorXd { return stiffness_->solve(f, kPetscTolerance, control); };
    apply.diagonal = [&](int node) -> Eigen::Matrix3d { return diagonal.middleCols<3>(3 * node); };
    return quadratic_reference(mesh, *mesh_, apply, vertices, loads, values, control);
}

/// As halved_reference, likewise.
std::optional<ReferenceAnswer> PetscFemModel::halved_answer(const std::vector<int>& vertices,
                                                            std::span<const UnitLoad> loads, Values values,
                                                            Control& control) const {
    if (!holds(mesh_->tets.vertices, vertices) || !can_be_judged(poisson_ratio_)) return {};
    if (check_memory({}, {}) > available_memory_bytes()) return {};
    const ConstrainedFemNodes nodes = constrain_nodes(mesh_->tets.vertices, mesh_->midpoints, {}, vertices);
    stiffness_->ensure_eliminated(nodes.prescribed.nodes, control);
    return halved_reference(
        *mesh_, poisson_ratio_, [&](Values u) -> Eigen::VectorXd { return stiffness_->multiply(u, control); },
        [&](Values f) -> Eigen::VectorXd { return stiffness_->solve(f, kPetscTolerance, control); }, vertices, loads,
        values, control);
}

const SparseStiffness* PetscFemModel::sparse_stiffness() const {
    std::call_once(assembled_once_, [this] {
        Control control;
        assembled_ = stiffness(assemble_stiffness_parts(mesh_->tets.vertices, mesh_->elements(), control),
                               Material{1.0, poisson_ratio_});
    });
    return &assembled_;
}

std::optional<Interior> PetscFemModel::interior() const {
    return Interior{std::shared_ptr<const TetMesh>(mesh_, &mesh_->tets), mesh_->elements()};
}

}  // namespace elastolab
