#include "fem/solvers.hpp"

#include <algorithm>
#include <cassert>

#include "base/error.hpp"
#include "deform/holds.hpp"
#include "deform/load_columns.hpp"
#include "deform/node_rows.hpp"
#include "fem/constraints.hpp"
#include "fem/held_nodes.hpp"
#include "fem/load_vectors.hpp"
#include "fem/prices.hpp"

namespace elastolab {

namespace {

constexpr std::uint64_t kCacheBudget = 512ull << 20;
/// Vertices whose columns are computed together, then copied into the blocks that are kept.
constexpr std::size_t kVerticesAtOnce = 128;

ReducedSystem reduced_system(const FactorisedBody& body, const std::vector<int>& vertices,
                             std::span<const UnitLoad> loads, Control& control) {
    return bordered_system(body.columns_of_set(vertices, loads, control), body.compliance().rigid(), vertices);
}

SparseMatrix eliminated_held(const FemSystem& system, const std::vector<int>& vertices) {
    if (!holds(system.positions(), vertices)) throw NotHeldError();
    return eliminated(system.K, vertices);
}

}  // namespace

bool keeps_columns(const FemSystem& system, std::ptrdiff_t n_vertices) {
    return 3.0 * static_cast<double>(n_vertices) * system.mesh->prices.solve <= kColumnsWorthKeeping;
}

Eigen::MatrixXi FemMesh::elements() const {
    if (degree() == ElementDegree::quadratic) return rejoined(tets);
    return tets.tetrahedra;
}

FemMesh elements_on(TetMesh tets, const Triangles& surface, ElementDegree degree) {
    FemMesh mesh;
    mesh.n_elements = tets.n_tetrahedra();
    mesh.surface = surface;
    if (degree == ElementDegree::quadratic) {
        QuadraticMesh quadratic(tets);
        mesh.tets = quadratic.split();
        mesh.n_surface_nodes = quadratic.n_surface_nodes;
        mesh.surface_midpoints = midpoints_of(surface, quadratic);
        mesh.midpoints = {std::move(quadratic.triangles), std::move(quadratic.midpoints)};
    } else {
        mesh.n_surface_nodes = tets.n_surface_vertices;
        mesh.tets = std::move(tets);
    }
    return mesh;
}

FemMesh make_fem_mesh(TetMesh tets, const Triangles& surface, ElementDegree degree, Control& control) {
    FemMesh mesh = elements_on(std::move(tets), surface, degree);
    mesh.parts = assemble_stiffness_parts(mesh.tets.vertices, mesh.elements(), control);
    return mesh;
}

FactorisedBody::FactorisedBody(std::shared_ptr<const FemSystem> system, std::vector<int> fixed, Control& control)
    : system_(std::move(system)),
      fixed_(std::move(fixed)),
      compliance_(system_->K, *system_->mesh->analysis, system_->positions(), system_->n_surface(), fixed_, control),
      reciprocal_condition_(compliance_.reciprocal_condition()),
      cache_(kCacheBudget) {}

Columns FactorisedBody::compliance_columns(const std::vector<int>& vertices, Control& control) const {
    std::vector<ColumnKey> keys;
    for (const int v : vertices) keys.push_back({v});
    const auto block_bytes = 24 * static_cast<std::uint64_t>(3 * system_->n_surface() + compliance_.rigid().cols());
    return cache_.get(
        keys, [&](const ColumnKey&) { return block_bytes; },
        [&](const std::vector<ColumnKey>& missing) {
            std::vector<int> wanted;
            for (const ColumnKey& key : missing) wanted.push_back(key.front());
            std::vector<Columns::Block> blocks;
            for (std::size_t first = 0; first < wanted.size(); first += kVerticesAtOnce)
                add_blocks(std::span(wanted).subspan(first, std::min(kVerticesAtOnce, wanted.size() - first)), blocks,
                           control);
            return blocks;
        },
        control);
}

std::shared_ptr<const ComplianceColumns> FactorisedBody::columns_of_set(const std::vector<int>& vertices,
                                                                        std::span<const UnitLoad> loads,
                                                                        Control& control) const {
    Columns given = columns_of_loads(loads, control);
    if (keeps_columns(*system_, std::ssize(vertices)))
        return std::make_shared<const KeptComplianceColumns>(compliance_columns(vertices, control), std::move(given));
    return std::make_shared<const FactorComplianceColumns>(shared_from_this(), vertices, std::move(given));
}

Columns FactorisedBody::columns_of_loads(std::span<const UnitLoad> loads, Control& control) const {
    return load_columns(
        cache_, loads, 3 * system_->n_surface() + compliance_.rigid().cols(),
        [&](std::span<const UnitLoad> missing) { return compute_columns(missing); }, control);
}

Eigen::MatrixXd FactorisedBody::compute_columns(std::span<const UnitLoad> loads) const {
    return border().compliance_columns(load_vectors(*system_->mesh, loads),
                                       [&](const Eigen::MatrixXd& f) -> Eigen::MatrixXd {
                                           return compliance_.volume_columns(f).topRows(3 * system_->n_surface());
                                       });
}

void FactorisedBody::add_blocks(std::span<const int> vertices, std::vector<Columns::Block>& blocks,
                                Control& control) const {
    const Eigen::MatrixXd columns = compliance_.columns(vertices, control);
    const Eigen::MatrixXd& R = compliance_.rigid();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        Eigen::MatrixXd block(columns.rows() + R.cols(), 3);
        block.topRows(columns.rows()) = columns.middleCols<3>(3 * static_cast<Eigen::Index>(i));
        block.bottomRows(R.cols()) = R.middleRows<3>(3 * vertices[i]).transpose();
        blocks.push_back(std::make_shared<const Eigen::MatrixXd>(std::move(block)));
    }
}

Eigen::MatrixXd FactorisedBody::volume_displacements(const Eigen::MatrixXd& surface,
                                                     const Eigen::MatrixXd& loads) const {
    const FreeBorder free = border();
    Eigen::MatrixXd balanced = loads;
    if (loads.rows() > surface.rows()) free.balance(balanced);
    Eigen::MatrixXd u = compliance_.volume_columns(balanced);
    // The response is right up to a rigid motion, which the displacements of the surface determine.
    u.topRows(surface.rows()) -= surface;
    free.remove_motion(u);
    u.topRows(surface.rows()) = surface;
    return u;
}

FactorComplianceColumns::FactorComplianceColumns(std::shared_ptr<const FactorisedBody> body, std::vector<int> vertices,
                                                 Columns given)
    : body_(std::move(body)), vertices_(std::move(vertices)), given_(std::move(given)) {}

Eigen::MatrixXd FactorComplianceColumns::capacitance_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                                            Control& control) const {
    assert(nodes == vertices_);
    const Eigen::Index n = cols(), n_border = rigid.cols();
    Eigen::MatrixXd S(n + n_border, n + n_border + n_given());
    S.topLeftCorner(n, n) = body_->compliance().block(vertices_, control);
    S.middleCols(n, n_border) = border_columns(nodes, rigid);
    S.bottomLeftCorner(n_border, n) = S.block(0, n, n, n_border).transpose();
    if (n_given() > 0) S.rightCols(n_given()) = given_.rows_of(nodes, rigid.rows() - n_border);
    return S;
}

void FactorComplianceColumns::add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements,
                                          Control& control) const {
    Eigen::MatrixXd at_surface = Eigen::MatrixXd::Zero(3 * body_->system().n_surface(), loads.cols());
    set_prescribed(vertices_, loads, at_surface);
    displacements += body_->compliance().apply(at_surface, control);
    given_.add_product(loads.bottomRows(n_given()), displacements);
}

FactorisedBodySolver::FactorisedBodySolver(std::shared_ptr<const FactorisedBody> body, std::vector<int> vertices,
                                           std::span<const UnitLoad> loads, Control& control)
    : body_(std::move(body)),
      vertices_(std::move(vertices)),
      given_(load_vectors(*body_->system().mesh, loads)),
      reduced_(reduced_system(*body_, vertices_, loads, control), control) {
    condition_ = std::max(reduced_.condition(), 1.0 / body_->reciprocal_condition());
    held_ = reduced_.held();
}

Eigen::MatrixXd FactorisedBodySolver::volume_displacements(const Eigen::MatrixXd& surface,
                                                           const Eigen::MatrixXd& factors,
                                                           const Eigen::MatrixXd& loads) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(given_.cols() > 0 ? given_.rows() : surface.rows(), surface.cols());
    set_prescribed(vertices_, loads, all);
    if (given_.cols() > 0) all.noalias() += given_ * factors;
    return body_->volume_displacements(surface, all);
}

NodeSolution FactorisedBodySolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    Control control;
    return solve_watched(prescribed, want_loads, kSolveTolerance, control);
}

NodeSolution FactorisedBodySolver::solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                                                 Control& control) const {
    const Eigen::Index n_fixed = 3 * std::ssize(body_->fixed()), n_given = given_.cols();
    NodeSolution solution =
        reduced_.solve_watched(prescribed.bottomRows(prescribed.rows() - n_fixed), want_loads, tolerance, control);
    if (!want_loads || n_fixed == 0) return solution;
    control.checkpoint();
    const Eigen::MatrixXd factors = prescribed.bottomRows(n_given);
    const Eigen::MatrixXd u = volume_displacements(solution.displacements, factors, solution.loads);
    Eigen::MatrixXd loads(prescribed.rows() - n_given, prescribed.cols());
    loads << support_forces(body_->system().K, u, body_->fixed(), given_ * factors), solution.loads;
    solution.loads = std::move(loads);
    return solution;
}

SparseDirectSolver::SparseDirectSolver(std::shared_ptr<const FemSystem> system, std::vector<int> vertices,
                                       Eigen::MatrixXd given, Control& control)
    : system_(std::move(system)),
      vertices_(std::move(vertices)),
      given_(std::move(given)),
      factor_(std::make_shared<const SparseCholesky>(*system_->mesh->analysis, eliminated_held(*system_, vertices_),
                                                     "stiffness matrix", &control)) {
    control.checkpoint();
    condition_ = 1.0 / factor_->reciprocal_condition();
}

NodeSolution SparseDirectSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    const HeldStiffness K{[&](const Eigen::MatrixXd& u) -> Eigen::MatrixXd { return system_->K * u; },
                          [&](const Eigen::MatrixXd& f) { return factor_->solve(f); }};
    return solve_held(K, vertices_, given_, prescribed, want_loads);
}

double stiffness_residual(const SparseMatrix& K, const Eigen::VectorXd& u, const std::vector<int>& vertices,
                          const Eigen::VectorXd& forces, const Eigen::VectorXd& given) {
    return force_residual(K * u, K.cwiseAbs() * u.cwiseAbs(), vertices, forces, given);
}

Eigen::MatrixXd support_forces(const SparseMatrix& K, const Eigen::MatrixXd& u, const std::vector<int>& vertices,
                               const Eigen::MatrixXd& given) {
    return rows_of(K * u - given, vertices);
}

Eigen::MatrixXd nodal_forces(const SparseMatrix& K, const Eigen::MatrixXd& u, const std::vector<int>& vertices) {
    return rows_of(K * u, vertices);
}

}  // namespace elastolab
