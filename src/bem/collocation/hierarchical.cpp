#include "bem/collocation/hierarchical.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "bem/collocation/given_loads.hpp"
#include "bem/hierarchical/free_modes.hpp"
#include "bem/hierarchical/item_rows.hpp"
#include "deform/gmres.hpp"
#include "deform/load_columns.hpp"
#include "elasticity/rigid_motion.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace {

/// Tolerance of a far block over that of an integral; its upper bound; eta of cover_matrix. Displacements then differ
/// by 1e-7 from those of the dense matrix (cube of 2906 vertices, integrals to 1e-10); with smaller leaves and nearer
/// blocks, which are in single precision, by 1e-6.
constexpr double kFarError = 10000.0, kMostFarError = 1e-4, kEta = 2.5;
/// Columns that are iterated for at once: each has a basis of its own.
constexpr Eigen::Index kColumnsIterated = 4;

std::vector<int> without(const std::vector<int>& numbers, const std::vector<int>& left_out) {
    std::vector<int> sorted = left_out, kept;
    std::sort(sorted.begin(), sorted.end());
    for (const int number : numbers)
        if (!std::binary_search(sorted.begin(), sorted.end(), number)) kept.push_back(number);
    return kept;
}

std::vector<int> all_numbers(int n) {
    std::vector<int> numbers(static_cast<std::size_t>(n));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

}  // namespace

HierarchicalCollocation::HierarchicalCollocation(std::shared_ptr<const Boundary> boundary, const Material& material,
                                                 double tolerance, Control& control)
    : boundary_(std::move(boundary)),
      material_(material),
      tolerance_(tolerance),
      options_{.tolerance = std::min(kFarError * tolerance, kMostFarError), .eta = kEta},
      modes_(std::make_shared<const Eigen::MatrixXd>(rigid_modes(boundary_->mesh().vertices))),
      elements_(*boundary_, vertex_elements(*boundary_)),
      H_(*boundary_, vertex_collocation_points(*boundary_), elements_, modes_, material_, tolerance_, options_,
         control) {}

Eigen::MatrixXd HierarchicalCollocation::given_at_vertices(std::span<const UnitLoad> loads, Control& control) const {
    const auto compute = [&](std::span<const UnitLoad> missing) {
        return given_single_layer(*boundary_, vertex_collocation_points(*boundary_), material_, tolerance_, missing,
                                  control);
    };
    return load_columns(given_, loads, 3 * elements_.n_slots(), compute, control).middle(0, std::ssize(loads));
}

std::unique_ptr<const HierarchicalDoubleLayer> HierarchicalCollocation::seen_from(CollocationPoints points,
                                                                                  Control& control) const {
    return std::make_unique<const HierarchicalDoubleLayer>(*boundary_, std::move(points), elements_, modes_, material_,
                                                           tolerance_, options_, control);
}

CollocationProblem::CollocationProblem(std::shared_ptr<const HierarchicalCollocation> matrices,
                                       const TractionSpace& space, std::vector<int> constrained,
                                       std::span<const UnitLoad> loads, bool must_hold, Control& control)
    : matrices_(std::move(matrices)),
      free_(without(all_numbers(n_vertices()), constrained)),
      constrained_(std::move(constrained)),
      at_(free_),
      traction_scale_(matrices_->material().shear_modulus() / mean_edge(matrices_->boundary().mesh())),
      free_modes_(unseen_modes(*matrices_->modes(), constrained_)) {
    if (must_hold && !holds_the_body()) throw NotHeldError();
    control.begin_stage("integrate tractions");
    const std::vector<int> collocated = without(constrained_, space.dropped_collocation);
    at_.insert(at_.end(), collocated.begin(), collocated.end());
    loads_ = matrices_->loads_of(space, control);
    const CollocationPoints interior = inner_collocation_points(matrices_->boundary(), space.interior_triangles);
    points_.resize(3, std::ssize(at_) + interior.size());
    points_ << matrices_->boundary().mesh().vertices(Eigen::all, at_), interior.positions;
    given_.resize(size(), std::ssize(loads));
    if (!loads.empty())
        given_ << rows_of(matrices_->given_at_vertices(loads, control), at_),
            given_single_layer(matrices_->boundary(), interior, matrices_->material(), matrices_->tolerance(), loads,
                               control);
    // A triangle holds the body: where there is one, with interior points or without, nothing is free.
    assert(holds_the_body() || loads_->n_interior() == 0);
    shift_ = rows_of(free_modes_, at_);
}

Eigen::MatrixXd CollocationProblem::rows_of_equations(const Eigen::MatrixXd& everywhere) const {
    Eigen::MatrixXd rows(size(), everywhere.cols());
    rows << rows_of(everywhere, at_), everywhere.bottomRows(3 * loads_->n_interior());
    return rows;
}

/// What displacements alone contribute.
Eigen::MatrixXd CollocationProblem::equations(const Eigen::MatrixXd& displacements) const {
    Eigen::MatrixXd rows(size(), displacements.cols());
    rows << rows_of(matrices_->at_vertices().product(displacements), at_), loads_->double_layer(displacements);
    return rows;
}

Eigen::MatrixXd CollocationProblem::product(const Eigen::MatrixXd& X) const {
    Eigen::MatrixXd displacements = Eigen::MatrixXd::Zero(3 * n_vertices(), X.cols());
    put_rows(X, free_, displacements);
    Eigen::MatrixXd rows = equations(displacements);
    rows -= rows_of_equations(loads_->single_layer(traction_scale_ * X.bottomRows(3 * n_slots())));
    if (!holds_the_body()) rows.noalias() += shift_ * (free_modes_.transpose() * displacements).eval();
    return rows;
}

Eigen::MatrixXd CollocationProblem::sparse_product(const SparseColumns& Z, Control& control) const {
    SparseColumns displacements(3 * n_vertices(), Z.cols()), tractions(3 * n_slots(), Z.cols());
    std::vector<Eigen::Triplet<double>> of_vertices, of_slots;
    for (int row = 0; row < Z.rows(); ++row)
        for (SparseColumns::InnerIterator entry(Z, row); entry; ++entry) {
            const int number = row / 3, k = row % 3, column = static_cast<int>(entry.index());
            if (number < n_free())
                of_vertices.emplace_back(3 * free_[static_cast<std::size_t>(number)] + k, column, entry.value());
            else
                of_slots.emplace_back(row - 3 * n_free(), column, -traction_scale_ * entry.value());
        }
    displacements.setFromTriplets(of_vertices.begin(), of_vertices.end());
    tractions.setFromTriplets(of_slots.begin(), of_slots.end());
    Eigen::MatrixXd rows = rows_of_equations(loads_->single_layer(tractions, control));
    const Eigen::Index n_at = 3 * std::ssize(at_);
    rows.topRows(n_at) += rows_of(matrices_->at_vertices().sparse_product(displacements, control), at_);
    rows.bottomRows(rows.rows() - n_at) += loads_->double_layer(displacements, control);
    if (!holds_the_body()) rows.noalias() += shift_ * (free_modes_.transpose() * displacements).eval();
    return rows;
}

Eigen::MatrixXd CollocationProblem::right_side(const Eigen::MatrixXd& prescribed) const {
    Eigen::MatrixXd displacements = Eigen::MatrixXd::Zero(3 * n_vertices(), prescribed.cols());
    put_rows(prescribed, constrained_, displacements);
    Eigen::MatrixXd right = -equations(displacements);
    if (given_.cols() > 0) right.noalias() += given_ * prescribed.bottomRows(given_.cols());
    return right;
}

Eigen::MatrixXd CollocationProblem::assemble_answer(const Eigen::MatrixXd& prescribed, const Eigen::MatrixXd& X) const {
    Eigen::MatrixXd displacements = Eigen::MatrixXd::Zero(3 * n_vertices(), X.cols());
    put_rows(X, free_, displacements);
    orthogonalise(displacements, free_modes_);
    put_rows(prescribed, constrained_, displacements);
    Eigen::MatrixXd answer(displacements.rows() + 3 * n_slots(), X.cols());
    answer << displacements, traction_scale_ * X.bottomRows(3 * n_slots());
    return answer;
}

Eigen::MatrixXd CollocationProblem::unknowns_of(const Eigen::MatrixXd& answer) const {
    Eigen::MatrixXd X(size(), answer.cols());
    X << rows_of(answer, free_), answer.bottomRows(3 * n_slots()) / traction_scale_;
    return X;
}

Eigen::MatrixXd CollocationProblem::block(const std::vector<int>& numbers) const {
    const int n_at = static_cast<int>(at_.size());
    std::vector<int> vertices, slots, at, interior, everywhere;
    for (const int number : numbers) {
        if (number < n_free())
            vertices.push_back(free_[static_cast<std::size_t>(number)]);
        else
            slots.push_back(number - n_free());
        if (number < n_at)
            at.push_back(at_[static_cast<std::size_t>(number)]);
        else
            interior.push_back(number - n_at);
        everywhere.push_back(number < n_at ? at.back() : n_vertices() + interior.back());
    }
    const Eigen::Index n = 3 * std::ssize(numbers), n_displacements = 3 * std::ssize(vertices);
    Eigen::MatrixXd A(n, n);
    A.topLeftCorner(3 * std::ssize(at), n_displacements) = matrices_->at_vertices().block(at, vertices);
    A.bottomLeftCorner(3 * std::ssize(interior), n_displacements) = loads_->double_layer_block(interior, vertices);
    A.rightCols(n - n_displacements) = -traction_scale_ * loads_->single_layer_block(everywhere, slots);
    if (!holds_the_body())
        A.leftCols(n_displacements).noalias() += rows_of(shift_, numbers) * rows_of(free_modes_, vertices).transpose();
    return A;
}

CollocationSolver::CollocationSolver(std::shared_ptr<const HierarchicalCollocation> matrices,
                                     const TractionSpace& space, const std::vector<int>& constrained,
                                     std::span<const UnitLoad> loads, bool must_hold, Control& control)
    : problem_(std::move(matrices), space, constrained, loads, must_hold, control) {
    held_ = problem_.holds_the_body();
    control.begin_stage("precondition");
    preconditioner_ = make_collocation_preconditioner(problem_, control);
}

CollocationSolver::~CollocationSolver() = default;

NodeSolution CollocationSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    Control control;
    return solve_watched(prescribed, want_loads, kSolveTolerance, control);
}

Eigen::MatrixXd CollocationSolver::iterate(const Eigen::MatrixXd& prescribed, const Eigen::MatrixXd& start,
                                           double tolerance, Control& control) const {
    Eigen::MatrixXd answers(start.rows(), prescribed.cols());
    for (Eigen::Index first = 0; first < prescribed.cols(); first += kColumnsIterated) {
        const Eigen::Index count = std::min(kColumnsIterated, prescribed.cols() - first);
        const Eigen::MatrixXd some = prescribed.middleCols(first, count);
        const Eigen::MatrixXd X =
            gmres(problem_, *preconditioner_, problem_.right_side(some),
                  {.tolerance = tolerance, .start = problem_.unknowns_of(start.middleCols(first, count))},
                  "boundary equations", control);
        answers.middleCols(first, count) = problem_.assemble_answer(some, X);
    }
    return answers;
}

NodeSolution CollocationSolver::solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                                              Control& control) const {
    const Eigen::Index n = 3 * problem_.n_vertices();
    const Eigen::MatrixXd answer = recycled_.get(prescribed, n + 3 * problem_.n_slots(), tolerance,
                                                 [&](const Eigen::MatrixXd& new_ones, const Eigen::MatrixXd& start) {
                                                     return iterate(new_ones, start, tolerance, control);
                                                 });
    NodeSolution solution;
    solution.displacements = answer.topRows(n);
    if (want_loads) solution.loads = answer.bottomRows(answer.rows() - n);
    return solution;
}

}  // namespace elastolab
