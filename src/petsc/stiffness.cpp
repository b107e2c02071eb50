#include "petsc/stiffness.hpp"

#include <algorithm>
#include <Eigen/SparseCore>
#include <functional>

#include "deform/node_rows.hpp"
#include "fem/inverse_norm.hpp"
#include "petsc/distributed_system.hpp"
#include "petsc/session.hpp"

namespace elastolab {

using What = Order::What;

PetscStiffness::PetscStiffness(const Positions& positions, const Eigen::Ref<const Eigen::MatrixXi>& elements,
                               double poisson_ratio, Control& control)
    : positions_(positions), partition_(partition_nodes(positions, Session::current().n_processes())) {
    Session& session = Session::current();
    number_ = session.new_number();
    const std::function<Share(int)> cut = [&](int process) {
        Share share = share_of(process, partition_, positions, elements, poisson_ratio);
        if (process == 0)
            for (std::size_t p = 1; p < partition_.begin.size(); ++p)
                share.own_counts.push_back(partition_.begin[p] - partition_.begin[p - 1]);
        return share;
    };
    session.together(
        {.what = What::create, .system = number_}, [&] { session.create(number_, cut); }, control);
}

PetscStiffness::~PetscStiffness() {
    Control control;
    try {
        Session& session = Session::current();
        session.together(
            {.what = What::release, .system = number_}, [&] { session.remove(number_); }, control);
    } catch (const Cancelled&) {
    } catch (const std::exception&) {  // nothing is left to be done
    }
}

const SolverFacts& PetscStiffness::facts() const { return Session::current().system(number_).facts(); }

Eigen::MatrixXd PetscStiffness::to_numbers(const Eigen::MatrixXd& of_mesh) const {
    return rows_of(of_mesh, partition_.order);
}

Eigen::MatrixXd PetscStiffness::to_mesh(const Eigen::MatrixXd& of_numbers) const {
    Eigen::MatrixXd result(of_numbers.rows(), of_numbers.cols());
    put_rows(of_numbers, partition_.order, result);
    return result;
}

std::vector<int> PetscStiffness::numbers_of(std::span<const int> nodes) const {
    std::vector<int> numbers;
    for (const int node : nodes) numbers.push_back(partition_.number[static_cast<std::size_t>(node)]);
    return numbers;
}

Eigen::MatrixXd PetscStiffness::ask(Order order, const Eigen::MatrixXd& in, Control& control) const {
    Session& session = Session::current();
    const Eigen::MatrixXd given = to_numbers(in);
    Eigen::MatrixXd result(in.rows(), in.cols());
    order.system = number_;
    order.n = in.cols();
    session.together(
        order, [&] { session.system(number_).follow(order, {.in = &given, .out = &result}); }, control);
    return to_mesh(result);
}

Eigen::MatrixXd PetscStiffness::multiply(const Eigen::MatrixXd& u, Control& control) const {
    return ask({.what = What::multiply}, u, control);
}

Eigen::MatrixXd PetscStiffness::multiply_sizes(const Eigen::MatrixXd& u, Control& control) const {
    return ask({.what = What::multiply_sizes}, u.cwiseAbs(), control);
}

Eigen::Matrix3Xd PetscStiffness::diagonal(Control& control) const {
    Session& session = Session::current();
    const Order order{.what = What::diagonal, .system = number_};
    Eigen::MatrixXd columns(size(), 3);
    session.together(
        order, [&] { session.system(number_).follow(order, {.out = &columns}); }, control);
    columns = to_mesh(columns);
    Eigen::Matrix3Xd blocks(3, size());
    for (Eigen::Index node = 0; node < size() / 3; ++node)
        blocks.middleCols<3>(3 * node) = columns.middleRows<3>(3 * node);
    return blocks;
}

double PetscStiffness::eliminate(std::span<const int> nodes, Control& control) {
    prepare_eliminated(nodes, control);
    return condition(control);
}

void PetscStiffness::prepare_eliminated(std::span<const int> nodes, Control& control) {
    Session& session = Session::current();
    const std::vector<int> numbers = numbers_of(nodes);
    eliminated_.clear();
    const Order order{.what = What::eliminate, .system = number_, .n = std::ssize(numbers), .engine = session.engine};
    session.together(
        order, [&] { session.system(number_).follow(order, {.nodes = &numbers}); }, control);
    eliminated_.assign(nodes.begin(), nodes.end());
}

void PetscStiffness::ensure_eliminated(std::span<const int> nodes, Control& control) {
    if (!std::equal(nodes.begin(), nodes.end(), eliminated_.begin(), eliminated_.end()))
        prepare_eliminated(nodes, control);
}

double PetscStiffness::ground(const StaticSupport& support, Control& control) {
    Session& session = Session::current();
    const Eigen::Matrix3Xd blocks = diagonal(control);
    eliminated_.clear();
    // The springs of grounded() depend on the diagonal of the three nodes alone.
    SparseMatrix K(9, 9);
    Positions at(3, 3);
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < 3; ++i) {
        at.col(i) = positions_.col(support[static_cast<std::size_t>(i)]);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                entries.emplace_back(3 * i + row, 3 * i + column,
                                     blocks(row, 3 * support[static_cast<std::size_t>(i)] + column));
    }
    K.setFromTriplets(entries.begin(), entries.end());
    const Eigen::MatrixXd with_springs = grounded(K, at, {0, 1, 2}) - K;
    Eigen::Matrix3Xd springs(3, 9);
    for (int i = 0; i < 3; ++i) springs.middleCols<3>(3 * i) = with_springs.block<3, 3>(3 * i, 3 * i);
    const std::vector<int> numbers = numbers_of(support);
    const Order order{.what = What::ground, .system = number_, .n = 3, .engine = session.engine};
    session.together(
        order, [&] { session.system(number_).follow(order, {.nodes = &numbers, .springs = &springs}); }, control);
    return condition(control);
}

Eigen::MatrixXd PetscStiffness::solve(const Eigen::MatrixXd& loads, double tolerance, Control& control) const {
    return ask({.what = What::solve, .tolerance = tolerance}, loads, control);
}

/// As SparseCholesky::reciprocal_condition: an estimate, for which conjugate gradients need not be exact.
double PetscStiffness::condition(Control& control) const {
    constexpr double kForEstimate = 1e-8;
    const auto solve_one = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return solve(x, kForEstimate, control); };
    return facts().norm * estimate_inverse_norm(static_cast<int>(size()), solve_one);
}

}  // namespace elastolab
