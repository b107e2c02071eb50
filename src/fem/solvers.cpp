#include "fem/solvers.hpp"

#include <algorithm>
#include <cassert>
#include <Eigen/QR>

#include "base/error.hpp"
#include "deform/holds.hpp"
#include "deform/load_columns.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/constraints.hpp"
#include "fem/load_vectors.hpp"
#include "fem/prices.hpp"

namespace elastolab {

namespace {

constexpr std::uint64_t kCacheBudget = 512ull << 20;
/// Vertices whose columns are computed together, then copied into the blocks that are kept.
constexpr std::size_t kVerticesAtOnce = 128;

ReducedSystem reduced_system(const FactorisedBody& body, const std::vector<int>& vertices,
                             std::span<const UnitLoad> loads, Control& control) {
    const Eigen::MatrixXd& R = body.compliance().rigid();
    ReducedSystem reduced;
    reduced.responses = body.responses_of_set(vertices, loads, control);
    reduced.rigid = Eigen::MatrixXd::Zero(R.rows() + R.cols(), R.cols());
    reduced.rigid.topRows(R.rows()) = R;
    reduced.nodes = vertices;
    reduced.n_loads = 3 * std::ssize(vertices);
    return reduced;
}

SparseMatrix eliminated_held(const FemSystem& system, const std::vector<int>& vertices) {
    if (!holds(system.positions(), vertices)) throw NotHeldError();
    return eliminated(system.K, vertices);
}

}  // namespace

bool keeps_columns(const FemSystem& system, std::ptrdiff_t n_vertices) {
    return 3.0 * static_cast<double>(n_vertices) * system.mesh->prices.solve <= kColumnsWorthKeeping;
}

FemMesh make_fem_mesh(TetMesh tets, const Triangles& surface, ElementDegree degree, Control& control) {
    FemMesh mesh;
    mesh.n_elements = tets.n_tetrahedra();
    mesh.surface = surface;
    if (degree == ElementDegree::quadratic) {
        QuadraticMesh quadratic(tets);
        mesh.parts = assemble_stiffness_parts(quadratic, control);
        mesh.tets = quadratic.split();
        mesh.n_surface_nodes = quadratic.n_surface_nodes;
        mesh.surface_midpoints = midpoints_of(surface, quadratic);
        mesh.midpoints = {std::move(quadratic.triangles), std::move(quadratic.midpoints)};
    } else {
        mesh.parts = assemble_stiffness_parts(tets, control);
        mesh.n_surface_nodes = tets.n_surface_vertices;
        mesh.tets = std::move(tets);
    }
    return mesh;
}

FactorisedBody::FactorisedBody(std::shared_ptr<const FemSystem> system, std::vector<int> base, Control& control)
    : system_(std::move(system)),
      base_(std::move(base)),
      compliance_(system_->K, *system_->mesh->analysis, system_->positions(), system_->n_surface(), base_, control),
      reciprocal_condition_(compliance_.reciprocal_condition()),
      cache_(kCacheBudget) {}

Columns FactorisedBody::responses(const std::vector<int>& vertices, Control& control) const {
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

std::shared_ptr<const Responses> FactorisedBody::responses_of_set(const std::vector<int>& vertices,
                                                                  std::span<const UnitLoad> loads,
                                                                  Control& control) const {
    Columns given = load_responses(loads, control);
    if (keeps_columns(*system_, std::ssize(vertices)))
        return std::make_shared<const KeptResponses>(responses(vertices, control), std::move(given));
    return std::make_shared<const FactorResponses>(shared_from_this(), vertices, std::move(given));
}

Columns FactorisedBody::load_responses(std::span<const UnitLoad> loads, Control& control) const {
    return load_columns(
        cache_, loads, 3 * system_->n_surface() + compliance_.rigid().cols(),
        [&](std::span<const UnitLoad> missing) { return compute_responses(missing); }, control);
}

Eigen::MatrixXd FactorisedBody::motions() const {
    const Eigen::MatrixXd all = rigid_modes(system_->positions()), &R = compliance_.rigid();
    return all * all.topRows(R.rows()).householderQr().solve(R);
}

Eigen::MatrixXd FactorisedBody::compute_responses(std::span<const UnitLoad> loads) const {
    const Eigen::MatrixXd& R = compliance_.rigid();
    const Eigen::Index n = 3 * system_->n_surface(), n_border = R.cols();
    Eigen::MatrixXd f = load_vectors(*system_->mesh, loads), columns(n + n_border, f.cols());
    if (n_border > 0) {
        // What the load lacks of balance is taken by forces R c on the surface, as the bordered inverse has it.
        const Eigen::MatrixXd c = motions().transpose() * f;
        f.topRows(n).noalias() -= R * c;
        columns.bottomRows(n_border) = c;
    }
    Eigen::MatrixXd u = compliance_.volume_response(f).topRows(n);
    if (n_border > 0) u -= R * (R.transpose() * u).eval();
    columns.topRows(n) = u;
    return columns;
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
    const Eigen::MatrixXd& R = compliance_.rigid();
    Eigen::MatrixXd balanced = loads;
    if (R.cols() > 0 && loads.rows() > R.rows())
        balanced.topRows(R.rows()).noalias() -= R * (motions().transpose() * loads).eval();
    Eigen::MatrixXd u = compliance_.volume_response(balanced);
    if (R.cols() > 0) {
        // The response is right up to a rigid motion, which the displacements of the surface determine.
        const Eigen::MatrixXd modes = rigid_modes(system_->positions());
        const Eigen::MatrixXd on_surface = modes.topRows(surface.rows());
        u += modes * on_surface.householderQr().solve(surface - u.topRows(surface.rows()));
    }
    u.topRows(surface.rows()) = surface;
    return u;
}

FactorResponses::FactorResponses(std::shared_ptr<const FactorisedBody> body, std::vector<int> vertices, Columns given)
    : body_(std::move(body)), vertices_(std::move(vertices)), given_(std::move(given)) {}

Eigen::MatrixXd FactorResponses::small_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
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

void FactorResponses::add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements,
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
    const Eigen::Index n_base = 3 * std::ssize(body_->base()), n_given = given_.cols();
    NodeSolution solution =
        reduced_.solve_watched(prescribed.bottomRows(prescribed.rows() - n_base), want_loads, tolerance, control);
    if (!want_loads || n_base == 0) return solution;
    control.checkpoint();
    const Eigen::MatrixXd factors = prescribed.bottomRows(n_given);
    const Eigen::MatrixXd u = volume_displacements(solution.displacements, factors, solution.loads);
    Eigen::MatrixXd loads(prescribed.rows() - n_given, prescribed.cols());
    loads << support_forces(body_->system().K, u, body_->base(), given_ * factors), solution.loads;
    solution.loads = std::move(loads);
    return solution;
}

SparseDirectSolver::SparseDirectSolver(std::shared_ptr<const FemSystem> system, std::vector<int> vertices,
                                       Eigen::MatrixXd given, Control& control)
    : system_(std::move(system)),
      vertices_(std::move(vertices)),
      given_(std::move(given)),
      factor_(*system_->mesh->analysis, eliminated_held(*system_, vertices_), "stiffness matrix", &control) {
    control.checkpoint();
    condition_ = 1.0 / factor_.reciprocal_condition();
}

NodeSolution SparseDirectSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    NodeSolution solution;
    const Eigen::MatrixXd given = given_ * prescribed.bottomRows(given_.cols());
    solution.displacements = Eigen::MatrixXd::Zero(system_->K.rows(), prescribed.cols());
    set_prescribed(vertices_, prescribed, solution.displacements);
    Eigen::MatrixXd right = given - system_->K * solution.displacements;
    for (const int v : vertices_) right.middleRows<3>(3 * v).setZero();
    solution.displacements += factor_.solve(right);
    if (want_loads) solution.loads = support_forces(system_->K, solution.displacements, vertices_, given);
    return solution;
}

double stiffness_residual(const SparseMatrix& K, const Eigen::VectorXd& u, const std::vector<int>& vertices,
                          const Eigen::VectorXd& forces, const Eigen::VectorXd& given) {
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(u.size(), 1);
    set_prescribed(vertices, forces, f);
    const Eigen::VectorXd off = K * u - f.col(0) - given;
    const Eigen::VectorXd size = K.cwiseAbs() * u.cwiseAbs() + f.cwiseAbs() + given.cwiseAbs();
    return size.norm() > 0.0 ? off.norm() / size.norm() : 0.0;
}

Eigen::MatrixXd support_forces(const SparseMatrix& K, const Eigen::MatrixXd& u, const std::vector<int>& vertices,
                               const Eigen::MatrixXd& given) {
    Eigen::MatrixXd forces = nodal_forces(K, u, vertices);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        forces.middleRows<3>(3 * static_cast<Eigen::Index>(i)) -= given.middleRows<3>(3 * vertices[i]);
    return forces;
}

Eigen::MatrixXd nodal_forces(const SparseMatrix& K, const Eigen::MatrixXd& u, const std::vector<int>& vertices) {
    const Eigen::MatrixXd f = K * u;
    Eigen::MatrixXd at(3 * std::ssize(vertices), u.cols());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        at.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = f.middleRows<3>(3 * vertices[i]);
    return at;
}

}  // namespace elastolab
