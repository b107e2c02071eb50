#include "study/paper/paper_procedure.hpp"

#include <optional>
#include <utility>

#include "base/lapack.hpp"
#include "fem/method.hpp"
#include "methods/precompute.hpp"
#include "study/report/statistics.hpp"

namespace elastolab {

namespace {

constexpr double kBudget = 0.4;
constexpr int kMostRepeats = 5;

Method paper_method(MethodKind kind) {
    Method method;
    method.kind = kind;
    method.mode = kind == kFem ? Mode::full_volume : Mode::full;
    method.tractions = Tractions::continuous;
    method.update = Update::eqn9;
    return method;
}

/// A frame in the paper: K00^-1 (K01 U1) with both matrices in memory.
PaperUpdate with_matrices(std::string name, double set_change, const Eigen::MatrixXd& K00_inverse,
                          const DenseOperators& operators, const Partition& partition, const Eigen::VectorXd& U1) {
    const Eigen::MatrixXd K01 = operators.K(partition.free, partition.constrained);
    Eigen::VectorXd right(K01.rows()), U0(K01.rows());
    const double frame = median_seconds_of_short([&] {
        right.noalias() = K01 * U1;
        U0.noalias() = K00_inverse * right;
    });
    return {std::move(name), set_change, frame, -U0};
}

/// The collapsed form: U0 = D01 t + E0 c with [D11 E1; F1 J] [t; c] = [U1; 0], the border belonging to part 1.
struct Collapsed {
    Eigen::MatrixXd D01;
    LuFactorization D11;

    Collapsed(const Eigen::MatrixXd& bordered_inverse, const Partition& partition) {
        std::vector<Eigen::Index> rest = partition.constrained;
        for (Eigen::Index i = std::ssize(partition.free) + std::ssize(rest); i < bordered_inverse.rows(); ++i)
            rest.push_back(i);
        D01 = bordered_inverse(partition.free, rest);
        D11 = LuFactorization(bordered_inverse(rest, rest), "D11");
    }
    Eigen::VectorXd displacements(const Eigen::VectorXd& U1) const {
        Eigen::MatrixXd right = Eigen::VectorXd::Zero(D11.size());
        right.topRows(U1.size()) = U1;
        D11.solve_in_place(right);
        return D01 * right;
    }
};

/// Known displacements, arbitrary but smooth in the node number.
Eigen::VectorXd some_values(std::size_t n_nodes) {
    Eigen::VectorXd values(3 * static_cast<Eigen::Index>(n_nodes));
    for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = std::sin(0.1 * static_cast<double>(i));
    return values;
}

}  // namespace

PaperSystem paper_precomputation(const Body& body, MethodKind kind, Control& control) {
    PaperSystem system;
    auto operators = std::make_shared<DenseOperators>();
    const Stopwatch watch;
    const std::shared_ptr<const Model> model = precompute(body, paper_method(kind), control);
    system.seconds = watch.seconds();
    model->visit_matrices([&](const NamedMatrix& matrix) {
        if (matrix.name == "K") operators->K = matrix.values;
        if (matrix.name == "Khatinv") operators->Khatinv = matrix.values;
    });
    system.symmetric = kind->sparse;
    system.operators = std::move(operators);
    return system;
}

std::vector<PaperUpdate> paper_updates(const PaperSystem& system, const std::vector<int>& known) {
    const DenseOperators& operators = *system.operators;
    const Partition partition(operators.K.rows(), known);
    const Eigen::VectorXd U1 = some_values(known.size());
    std::vector<PaperUpdate> updates;
    {
        Eigen::MatrixXd inverse;
        const auto invert = [&] {
            Eigen::MatrixXd K00 = operators.K(partition.free, partition.free);
            inverse = system.symmetric ? spd_inverse(std::move(K00), "K00")
                                       : LuFactorization(std::move(K00), "K00").inverse();
        };
        const double seconds = median_seconds(invert, kBudget, kMostRepeats);
        updates.push_back(with_matrices("inverse", seconds, inverse, operators, partition, U1));
        const auto by_eqn9 = [&] { inverse = inverse_by_eqn9(operators.Khatinv, partition); };
        const double eqn9 = median_seconds(by_eqn9, kBudget, kMostRepeats);
        updates.push_back(with_matrices("eqn9", eqn9, inverse, operators, partition, U1));
    }
    std::optional<DirectSolver> direct;
    updates.push_back({.name = "direct", .displacements = {}});
    updates.back().set_change_seconds =
        median_seconds([&] { direct.emplace(system.operators, known); }, kBudget, kMostRepeats);
    updates.back().frame_seconds = median_seconds_of_short(
        [&] { updates.back().displacements = direct->solve(U1, false).displacements(partition.free, 0); });
    std::optional<Collapsed> collapsed;
    updates.push_back({.name = "reduced", .displacements = {}});
    updates.back().set_change_seconds =
        median_seconds([&] { collapsed.emplace(operators.Khatinv, partition); }, kBudget, kMostRepeats);
    updates.back().frame_seconds =
        median_seconds_of_short([&] { updates.back().displacements = collapsed->displacements(U1); });
    return updates;
}

}  // namespace elastolab
