#include "fem/model.hpp"

#include <algorithm>

#include "base/cancellable_lock.hpp"
#include "base/error.hpp"
#include "base/lapack.hpp"
#include "deform/holds.hpp"
#include "deform/node_rows.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/condensation.hpp"
#include "fem/constraints.hpp"
#include "fem/error_estimate.hpp"
#include "fem/interior.hpp"
#include "fem/load_vectors.hpp"
#include "fem/nodal_field.hpp"
#include "mesh/tets/tetrahedralize.hpp"

namespace elastolab {

namespace {

/// [K R; R^T 0]^-1 = [K^+ R; R^T 0] for symmetric K with the null space R: K^+ = (K + a R R^T)^-1 - R R^T / a.
Eigen::MatrixXd bordered_inverse(const Eigen::MatrixXd& K, const Positions& positions) {
    const Eigen::MatrixXd R = rigid_modes(positions);
    const double a = K.diagonal().mean();
    const Eigen::Index n = K.rows();
    Eigen::MatrixXd grounded = K;
    grounded.noalias() += a * R * R.transpose();
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(n + 6, n + 6);
    inverse.topLeftCorner(n, n) = spd_inverse(std::move(grounded), "stiffness matrix");
    inverse.topLeftCorner(n, n).noalias() -= R * R.transpose() / a;
    inverse.topRightCorner(n, 6) = R;
    inverse.bottomLeftCorner(6, n) = R.transpose();
    return inverse;
}

/// Columns of the nodes' loads out of a bordered inverse in memory.
ReducedSystem reduced_from(const DenseOperators& operators, const std::vector<int>& nodes,
                           const Eigen::MatrixXd& given) {
    ReducedSystem reduced;
    std::vector<Columns::Block> blocks;
    for (const int node : nodes)
        blocks.push_back(std::make_shared<const Eigen::MatrixXd>(operators.Khatinv.middleCols<3>(3 * node)));
    Columns of_given;
    if (given.cols() > 0)
        of_given =
            Columns({std::make_shared<const Eigen::MatrixXd>(operators.Khatinv.leftCols(operators.K.cols()) * given)});
    reduced.compliance_columns =
        std::make_shared<const KeptComplianceColumns>(Columns(std::move(blocks)), std::move(of_given));
    reduced.rigid = operators.Khatinv.rightCols<6>();
    reduced.nodes = nodes;
    reduced.n_loads = 3 * std::ssize(nodes);
    return reduced;
}

std::shared_ptr<const InteriorField> field_of(const FemSystem& system, double poisson_ratio, Eigen::MatrixXd u) {
    return std::make_shared<const NodalField>(std::shared_ptr<const TetMesh>(system.mesh, &system.mesh->tets),
                                              system.mesh->degree(), poisson_ratio, std::move(u));
}

/// Fraction by which a set may cost more than in the cheapest way, where later sets gain by it.
constexpr double kWorthForLater = 0.3;

/// Bytes of one factor above which no second one is kept.
constexpr std::uint64_t kLargeFactor = 256ull << 20;

}  // namespace

FemModel::FemModel(const SurfaceMesh& surface, const std::string& name, double poisson_ratio, const Method& method,
                   Control& control, ElementDegree degree)
    : method_(method) {
    TetMesh tets;
    {
        const Stage stage("tetrahedralize", control, facts_.stages);
        tets = tetrahedralize(surface, name, {.growth = method.growth}, control);
    }
    auto mesh = std::make_shared<FemMesh>();
    {
        const Stage stage("integrate", control, facts_.stages);
        *mesh = make_fem_mesh(std::move(tets), surface.triangles, degree, control);
    }
    {
        const Stage stage("analyse", control, facts_.stages);
        mesh->analysis = std::make_unique<CholeskyAnalysis>(mesh->parts.mu);
        mesh->prices = fem_prices(mesh->analysis->view());
    }
    mesh_ = std::move(mesh);
    facts_.n_triangles = surface.n_triangles();
    precompute(poisson_ratio, control);
}

FemModel::FemModel(const FemModel& before, double poisson_ratio, const Method& method, Control& control)
    : method_(method), mesh_(before.mesh_) {
    facts_.n_triangles = before.facts_.n_triangles;
    if (before.poisson_ratio_ == poisson_ratio && before.method_.mode == method.mode) {
        poisson_ratio_ = poisson_ratio;
        facts_ = before.facts_;
        facts_.stages.clear();
        system_ = before.system_;
        operators_ = before.operators_;
        const std::scoped_lock lock(before.factorised_mutex_);
        free_body_ = before.free_body_;
        factorised_body_ = before.factorised_body_;
    } else {
        precompute(poisson_ratio, control);
    }
}

void FemModel::precompute(double poisson_ratio, Control& control) {
    poisson_ratio_ = poisson_ratio;
    system_ =
        std::make_shared<const FemSystem>(FemSystem{mesh_, stiffness(mesh_->parts, Material{1.0, poisson_ratio})});
    facts_.n_vertices = system_->n_vertices();
    facts_.n_tetrahedra = mesh_->n_elements;
    facts_.n_degrees_of_freedom = 3 * mesh_->tets.n_vertices();
    facts_.memory_bytes = mesh_->analysis->factor_bytes();
    // On demand the first constrained set decides what is factorised: K with its fixed set eliminated, or the free
    // body.
    if (method_.mode == Mode::on_demand) return;
    auto operators = std::make_shared<DenseOperators>();
    {
        const Stage stage("K", control, facts_.stages);
        operators->K = method_.mode == Mode::full ? condense_to_surface(system_->K, system_->n_surface(), control)
                                                  : Eigen::MatrixXd(system_->K);
    }
    {
        const Stage stage("K^-1", control, facts_.stages);
        operators->Khatinv = bordered_inverse(operators->K, system_->positions().leftCols(operators->K.rows() / 3));
    }
    facts_.memory_bytes = 16 * static_cast<std::uint64_t>(operators->Khatinv.size());
    const Eigen::MatrixXd& inverse = operators->Khatinv;
    facts_.condition_estimate =
        operators->K.cwiseAbs().colwise().sum().maxCoeff() *
        inverse.topLeftCorner(operators->K.rows(), operators->K.cols()).cwiseAbs().colwise().sum().maxCoeff();
    operators_ = std::move(operators);
}

std::shared_ptr<const FactorisedBody> FemModel::factorised_on(std::span<const int> fixed, Control& control) const {
    const auto factorising = lock_unless_cancelled(factorising_mutex_, control);
    if (auto body = at_hand(fixed)) return body;
    if (mesh_->analysis->factor_bytes() > kLargeFactor) {
        const std::scoped_lock lock(factorised_mutex_);
        free_body_ = factorised_body_ = nullptr;
    }
    auto body = std::make_shared<const FactorisedBody>(system_, std::vector<int>(fixed.begin(), fixed.end()), control);
    const std::scoped_lock lock(factorised_mutex_);
    return (fixed.empty() ? free_body_ : factorised_body_) = std::move(body);
}

/// The body with this fixed set eliminated, null where it is not factorised yet.
std::shared_ptr<const FactorisedBody> FemModel::at_hand(std::span<const int> fixed) const {
    const std::scoped_lock lock(factorised_mutex_);
    const std::shared_ptr<const FactorisedBody>& body = fixed.empty() ? free_body_ : factorised_body_;
    return body && std::equal(fixed.begin(), fixed.end(), body->fixed().begin(), body->fixed().end()) ? body : nullptr;
}

FemModel::Elimination FemModel::cheapest_elimination(const ConstrainedFemNodes& nodes) const {
    const std::span<const int> all = nodes.prescribed.nodes, fixed = nodes.fixed();
    const bool fixed_set_holds = holds(system_->positions(), fixed);
    if (!holds(system_->positions(), all)) return Elimination::nothing;
    const SupernodalView pattern = mesh_->analysis->view();
    const double afresh = mesh_->prices.factorisation;
    const auto price = [&](std::span<const int> eliminated, std::span<const int> others) {
        return (at_hand(eliminated) ? 0.0 : afresh) +
               (keeps_columns(*system_, std::ssize(others)) ? 0.0 : block_price(pattern, others).price);
    };
    const double with_fixed = fixed_set_holds ? price(fixed, all.subspan(fixed.size())) : price({}, all);
    const double least = std::min(with_fixed, at_hand({}) ? price({}, all) : with_fixed);
    // Where a factorisation serves the next handle too, it may cost more than one that serves this set alone.
    if (least > (1.0 + kWorthForLater) * afresh) return Elimination::all;
    return fixed_set_holds && with_fixed <= least ? Elimination::fixed : Elimination::nothing;
}

FemModel::Elimination FemModel::elimination_of(const ConstrainedFemNodes& nodes) const {
    return method_.update == Update::reduced ? cheapest_elimination(nodes) : Elimination::all;
}

std::uint64_t FemModel::constrain_memory(std::span<const int> fixed, std::span<const int> handles) const {
    const ConstrainedFemNodes nodes = nodes_of(fixed, handles);
    const auto constrained = 3 * static_cast<std::uint64_t>(nodes.prescribed.nodes.size());
    const auto surface = 3 * static_cast<std::uint64_t>(system_->n_surface());
    if (operators_ && method_.update != Update::reduced) {
        const auto all = static_cast<std::uint64_t>(operators_->K.rows()), free = all - constrained;
        return 8 * free * (method_.update == Update::eqn9 ? 2 * free + constrained : all);
    }
    if (operators_) return 8 * (6 + constrained) * (6 + constrained + surface);
    const Elimination elimination = elimination_of(nodes);
    // Beside the factor: K with what is eliminated.
    const std::uint64_t factorisation =
        mesh_->analysis->factor_bytes() + 12 * static_cast<std::uint64_t>(system_->K.nonZeros());
    if (elimination == Elimination::all) return factorisation;
    const std::span<const int> all = nodes.prescribed.nodes;
    const std::span<const int> eliminated = elimination == Elimination::fixed ? nodes.fixed() : std::span<const int>();
    const std::span<const int> others = all.subspan(eliminated.size());
    const auto unknowns = 6 + 3 * static_cast<std::uint64_t>(others.size());
    return (at_hand(eliminated) ? 0 : factorisation) + (keeps_columns(*system_, std::ssize(others))
                                                            ? 8 * unknowns * (2 * unknowns + surface)
                                                            : block_price(mesh_->analysis->view(), others).bytes);
}

std::uint64_t FemModel::check_memory(std::span<const int> fixed, std::span<const int> handles) const {
    const bool has_factor = !operators_ && elimination_of(nodes_of(fixed, handles)) == Elimination::all;
    return degree() == ElementDegree::linear ? quadratic_reference_memory(*system_, has_factor)
                                             : halved_reference_memory(*system_, has_factor);
}

ConstrainedFemNodes FemModel::nodes_of(std::span<const int> fixed, std::span<const int> handles) const {
    return constrain_nodes(system_->positions(), mesh_->midpoints, fixed, handles);
}

std::unique_ptr<ConstrainedSolid> FemModel::make_solid(ConstrainedFemNodes nodes, std::unique_ptr<NodeSolver> solver,
                                                       SolutionChecks checks, Loads loads) const {
    return std::make_unique<ConstrainedSolid>(system_->n_vertices(), std::move(nodes.prescribed),
                                              std::move(nodes.shares), nullptr, std::move(solver), std::move(checks),
                                              static_cast<int>(loads.size()));
}

std::unique_ptr<ConstrainedSolid> FemModel::constrain(std::span<const int> fixed, std::span<const int> handles,
                                                      Loads loads, Control& control) const {
    if (operators_) return constrain_dense(nodes_of(fixed, handles), loads, control);
    ConstrainedFemNodes nodes = nodes_of(fixed, handles);
    const Elimination elimination = elimination_of(nodes);
    if (elimination == Elimination::all) return constrain_direct(std::move(nodes), loads, control);
    const int n_eliminated = elimination == Elimination::fixed ? nodes.n_fixed : 0;
    return constrain_reduced(std::move(nodes), loads, n_eliminated, control);
}

std::unique_ptr<ConstrainedSolid> FemModel::constrain_direct(ConstrainedFemNodes constrained, Loads loads,
                                                             Control& control) const {
    const std::vector<int>& nodes = constrained.prescribed.nodes;
    Eigen::MatrixXd given = load_vectors(*mesh_, loads);
    auto solver = std::make_unique<SparseDirectSolver>(system_, nodes, given, control);
    const auto residual = [system = system_, nodes, given = std::move(given)](const NodeSolution& solution, Control&) {
        return stiffness_residual(system->K, solution.displacements, nodes, solution.loads, given * solution.factors);
    };
    SolutionChecks checks{residual, reference_for(constrained, loads, solver->factor())};
    checks.interior_field = [system = system_, nu = poisson_ratio_](NodeSolution&& solution, Control&) {
        return field_of(*system, nu, std::move(solution.displacements));
    };
    return make_solid(std::move(constrained), std::move(solver), std::move(checks), loads);
}

Eigen::MatrixXd FemModel::dense_load_vectors(Loads loads, Control& control) const {
    const Eigen::MatrixXd f = load_vectors(*mesh_, loads);
    const Eigen::Index n = operators_->K.rows();
    if (f.rows() == n || f.bottomRows(f.rows() - n).isZero(0.0)) return f.topRows(n);
    return FemInterior(system_->K, system_->n_surface(), control).condensed(f);
}

std::unique_ptr<ConstrainedSolid> FemModel::constrain_dense(ConstrainedFemNodes constrained, Loads loads,
                                                            Control& control) const {
    const std::vector<int>& nodes = constrained.prescribed.nodes;
    Eigen::MatrixXd given = dense_load_vectors(loads, control);
    std::unique_ptr<NodeSolver> solver;
    switch (method_.update) {
        case Update::direct:
            solver = std::make_unique<DirectSolver>(operators_, nodes, given, &control);
            break;
        case Update::eqn9:
            solver = make_paper_solver(operators_, nodes, given, control);
            break;
        case Update::reduced:
            solver = std::make_unique<ReducedSolver>(reduced_from(*operators_, nodes, given), control);
            break;
    }
    const auto residual = [operators = operators_, nodes, given](const NodeSolution& solution, Control&) {
        Eigen::MatrixXd f = Eigen::MatrixXd::Zero(operators->K.rows(), 1);
        set_prescribed(nodes, solution.loads, f);
        f += given * solution.factors;
        const Eigen::VectorXd u = solution.displacements;
        const double size = (operators->K.cwiseAbs() * u.cwiseAbs() + f.cwiseAbs()).norm();
        return size > 0.0 ? (operators->K * u - f).norm() / size : 0.0;
    };
    SolutionChecks checks{residual, reference_for(constrained, loads)};
    checks.interior_field = [system = system_, nu = poisson_ratio_, all = load_vectors(*mesh_, loads)](
                                NodeSolution&& solution, Control& its_control) {
        Eigen::MatrixXd& u = solution.displacements;
        if (u.rows() < system->K.rows())
            u = FemInterior(system->K, system->n_surface(), its_control).extend(u, all * solution.factors);
        return field_of(*system, nu, std::move(u));
    };
    return make_solid(std::move(constrained), std::move(solver), std::move(checks), loads);
}

std::unique_ptr<ConstrainedSolid> FemModel::constrain_reduced(ConstrainedFemNodes constrained, Loads loads,
                                                              int n_eliminated, Control& control) const {
    const std::vector<int>& nodes = constrained.prescribed.nodes;
    const auto body = factorised_on(std::span(nodes).first(static_cast<std::size_t>(n_eliminated)), control);
    auto solver = std::make_unique<FactorisedBodySolver>(
        body, std::vector<int>(nodes.begin() + n_eliminated, nodes.end()), loads, control);
    // Displacements of all nodes of a solution, and the given nodal forces.
    const auto inside = [body, nodes, given = solver->given()](const NodeSolution& solution) {
        Eigen::MatrixXd f = given * solution.factors, all = Eigen::MatrixXd::Zero(f.rows(), f.cols());
        put_rows(solution.loads, nodes, all);
        all += f;
        return std::pair(body->volume_displacements(solution.displacements, all), std::move(f));
    };
    const auto residual = [body, nodes, inside](const NodeSolution& solution, Control&) {
        const auto [u, given] = inside(solution);
        return stiffness_residual(body->system().K, u, nodes, solution.loads, given);
    };
    SolutionChecks checks{residual, reference_for(constrained, loads)};
    checks.interior_field = [body, inside, nu = poisson_ratio_](const NodeSolution& solution, Control&) {
        return field_of(body->system(), nu, inside(solution).first);
    };
    return make_solid(std::move(constrained), std::move(solver), std::move(checks), loads);
}

decltype(SolutionChecks::reference) FemModel::reference_for(const ConstrainedFemNodes& nodes, Loads loads,
                                                            const std::shared_ptr<const SparseCholesky>& held) const {
    return [system = system_, degree = degree(), nu = poisson_ratio_, vertices = nodes.vertices, held,
            loads = std::vector<UnitLoad>(loads.begin(), loads.end())](const Eigen::VectorXd& values,
                                                                       const NodeSolution& first, Control& control) {
        const Eigen::VectorXd u = first.displacements.col(0);
        return degree == ElementDegree::linear
                   ? quadratic_reference(*system, nu, vertices, loads, values, u, held, control)
                   : halved_reference(*system, nu, vertices, loads, values, u, held, control);
    };
}

std::optional<Interior> FemModel::interior() const {
    return Interior{std::shared_ptr<const TetMesh>(mesh_, &mesh_->tets), mesh_->elements()};
}

void FemModel::visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const {
    if (!operators_) return;
    visit({"K", operators_->K, {kNodalStiffness}});
    visit({"Kinv", operators_->D(), {kNodalCompliance}});
    visit({"Khatinv",
           operators_->Khatinv,
           {.nodes = kNodalCompliance, .has_border = true, .columns = {}, .rows = {}, .corner = kNodalStiffness}});
}

}  // namespace elastolab
