#include "fem/solvers.hpp"

#include <algorithm>
#include <cassert>
#include <Eigen/QR>

#include "base/error.hpp"
#include "deform/holds.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/constraints.hpp"
#include "fem/prices.hpp"

namespace elastolab {

namespace {

constexpr std::uint64_t kCacheBudget = 512ull << 20;
/// Vertices whose columns are computed together, then copied into the blocks that are kept.
constexpr std::size_t kVerticesAtOnce = 128;

ReducedSystem reduced_system(const FactorisedBody& body, const std::vector<int>& vertices, Control& control) {
    const Eigen::MatrixXd& R = body.compliance().rigid();
    ReducedSystem reduced;
    reduced.responses = body.responses_of_set(vertices, control);
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

FemMesh make_fem_mesh(TetMesh tets, ElementDegree degree, Control& control) {
    FemMesh mesh;
    mesh.n_elements = tets.n_tetrahedra();
    if (degree == ElementDegree::quadratic) {
        QuadraticMesh quadratic(tets);
        mesh.parts = assemble_stiffness_parts(quadratic, control);
        mesh.tets = quadratic.split();
        mesh.n_surface_nodes = quadratic.n_surface_nodes;
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
                                                                  Control& control) const {
    if (keeps_columns(*system_, std::ssize(vertices)))
        return std::make_shared<const KeptResponses>(responses(vertices, control));
    return std::make_shared<const FactorResponses>(shared_from_this(), vertices);
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
    Eigen::MatrixXd u = compliance_.volume_response(loads);
    if (compliance_.rigid().cols() > 0) {
        // The response is right up to a rigid motion, which the displacements of the surface determine.
        const Eigen::MatrixXd modes = rigid_modes(system_->positions());
        const Eigen::MatrixXd on_surface = modes.topRows(surface.rows());
        u += modes * on_surface.householderQr().solve(surface - u.topRows(surface.rows()));
    }
    u.topRows(surface.rows()) = surface;
    return u;
}

FactorResponses::FactorResponses(std::shared_ptr<const FactorisedBody> body, std::vector<int> vertices)
    : body_(std::move(body)), vertices_(std::move(vertices)) {}

Eigen::MatrixXd FactorResponses::small_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                              Control& control) const {
    assert(nodes == vertices_);
    const Eigen::Index n = cols(), n_border = rigid.cols();
    Eigen::MatrixXd S(n + n_border, n + n_border);
    S.topLeftCorner(n, n) = body_->compliance().block(vertices_, control);
    S.rightCols(n_border) = border_columns(nodes, rigid);
    S.bottomLeftCorner(n_border, n) = S.topRightCorner(n, n_border).transpose();
    return S;
}

void FactorResponses::add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements,
                                  Control& control) const {
    Eigen::MatrixXd at_surface = Eigen::MatrixXd::Zero(3 * body_->system().n_surface(), loads.cols());
    set_prescribed(vertices_, loads, at_surface);
    displacements += body_->compliance().apply(at_surface, control);
}

FactorisedBodySolver::FactorisedBodySolver(std::shared_ptr<const FactorisedBody> body, std::vector<int> vertices,
                                           Control& control)
    : body_(std::move(body)),
      vertices_(std::move(vertices)),
      reduced_(reduced_system(*body_, vertices_, control), control) {
    condition_ = std::max(reduced_.condition(), 1.0 / body_->reciprocal_condition());
    held_ = reduced_.held();
}

NodeSolution FactorisedBodySolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    Control control;
    return solve_watched(prescribed, want_loads, kSolveTolerance, control);
}

NodeSolution FactorisedBodySolver::solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                                                 Control& control) const {
    const Eigen::Index n_base = 3 * std::ssize(body_->base());
    NodeSolution solution =
        reduced_.solve_watched(prescribed.bottomRows(prescribed.rows() - n_base), want_loads, tolerance, control);
    if (!want_loads || n_base == 0) return solution;
    Eigen::MatrixXd surface_loads = Eigen::MatrixXd::Zero(solution.displacements.rows(), prescribed.cols());
    set_prescribed(vertices_, solution.loads, surface_loads);
    control.checkpoint();
    const Eigen::MatrixXd u = body_->volume_displacements(solution.displacements, surface_loads);
    Eigen::MatrixXd loads(prescribed.rows(), prescribed.cols());
    loads << nodal_forces(body_->system().K, u, body_->base()), solution.loads;
    solution.loads = std::move(loads);
    return solution;
}

SparseDirectSolver::SparseDirectSolver(std::shared_ptr<const FemSystem> system, std::vector<int> vertices,
                                       Control& control)
    : system_(std::move(system)),
      vertices_(std::move(vertices)),
      factor_(*system_->mesh->analysis, eliminated_held(*system_, vertices_), "stiffness matrix", &control) {
    control.checkpoint();
    condition_ = 1.0 / factor_.reciprocal_condition();
}

NodeSolution SparseDirectSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    NodeSolution solution;
    solution.displacements = Eigen::MatrixXd::Zero(system_->K.rows(), prescribed.cols());
    set_prescribed(vertices_, prescribed, solution.displacements);
    Eigen::MatrixXd right = -(system_->K * solution.displacements);
    for (const int v : vertices_) right.middleRows<3>(3 * v).setZero();
    solution.displacements += factor_.solve(right);
    if (want_loads) solution.loads = nodal_forces(system_->K, solution.displacements, vertices_);
    return solution;
}

double stiffness_residual(const SparseMatrix& K, const Eigen::VectorXd& u, const std::vector<int>& vertices,
                          const Eigen::VectorXd& forces) {
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(u.size(), 1);
    set_prescribed(vertices, forces, f);
    const Eigen::VectorXd off = K * u - f;
    const Eigen::VectorXd size = K.cwiseAbs() * u.cwiseAbs() + f.cwiseAbs();
    return size.norm() > 0.0 ? off.norm() / size.norm() : 0.0;
}

Eigen::MatrixXd nodal_forces(const SparseMatrix& K, const Eigen::MatrixXd& u, const std::vector<int>& vertices) {
    const Eigen::MatrixXd f = K * u;
    Eigen::MatrixXd at(3 * std::ssize(vertices), u.cols());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        at.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = f.middleRows<3>(3 * vertices[i]);
    return at;
}

}  // namespace elastolab
