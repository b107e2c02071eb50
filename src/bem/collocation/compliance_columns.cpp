#include "bem/collocation/compliance_columns.hpp"

#include <algorithm>

#include "bem/collocation/point_strips.hpp"

namespace elastolab {

namespace {

/// Columns per product with a strip of equations.
constexpr Eigen::Index kStripColumns = 384;

}  // namespace

BemComplianceColumns::BemComplianceColumns(std::shared_ptr<const BemSystem> system, TractionSpace space,
                                           std::span<const UnitLoad> loads, Control& control)
    : system_(std::move(system)),
      space_(std::move(space)),
      kept_(system_->keeps(space_)),
      loads_(loads.begin(), loads.end()),
      given_(system_->columns_of_loads(loads_, control)) {
    if (kept_) columns_ = system_->compliance_columns(space_, control);
}

Eigen::MatrixXd BemComplianceColumns::capacitance_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                                         Control& control) const {
    const Eigen::Index n = 3 * system_->n_nodes(), n_upper = 3 * std::ssize(nodes) + rigid.cols();
    const Eigen::Index n_closing = 9 * std::ssize(space_.interior_triangles);
    Eigen::MatrixXd S(n_upper + n_closing, cols() + rigid.cols() + n_given());
    Eigen::Index first = 0;
    const auto add = [&](const Columns& columns) {
        S.block(0, first, n_upper, columns.cols()) = columns.rows_of(nodes, n);
        if (n_closing > 0) add_closing(columns, first, S.bottomRows(n_closing), control);
        first += columns.cols();
    };
    if (kept_)
        add(columns_);
    else
        system_->visit_columns(space_, add, control);
    S.block(0, cols(), n_upper, rigid.cols()) = border_columns(nodes, rigid);
    first = cols() + rigid.cols();
    if (n_given() > 0) add(given_);
    if (n_closing > 0) add_closing_of_border_and_loads(rigid, S.bottomRows(n_closing), control);
    return S;
}

void BemComplianceColumns::add_closing(const Columns& columns, Eigen::Index first, Eigen::Ref<Eigen::MatrixXd> rows,
                                       Control& control) const {
    for_point_strips(inner_collocation_points(system_->boundary(), space_.interior_triangles),
                     [&](int source, const CollocationPoints& strip) {
                         const Eigen::MatrixXd A = system_->double_layer(strip, control);
                         for (Eigen::Index c = 0; c < columns.cols(); c += kStripColumns) {
                             const Eigen::Index count = std::min(kStripColumns, columns.cols() - c);
                             rows.block(3 * source, first + c, A.rows(), count).noalias() =
                                 A * columns.middle(c, count).topRows(A.cols());
                         }
                     });
}

void BemComplianceColumns::add_closing_of_border_and_loads(const Eigen::MatrixXd& rigid,
                                                           Eigen::Ref<Eigen::MatrixXd> rows, Control& control) const {
    for_point_strips(inner_collocation_points(system_->boundary(), space_.interior_triangles),
                     [&](int source, const CollocationPoints& strip) {
                         auto out = rows.middleRows(3 * source, 3 * strip.size());
                         out.middleCols(cols(), rigid.cols()).noalias() =
                             system_->double_layer(strip, control) * rigid.topRows(3 * system_->n_nodes());
                         out.leftCols(3 * space_.n_slots()) -= system_->single_layer(strip, space_.elements, control);
                         if (n_given() > 0)
                             out.rightCols(n_given()) -= system_->given_single_layer(strip, loads_, control);
                     });
}

void BemComplianceColumns::add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements,
                                       Control& control) const {
    given_.add_product(loads.bottomRows(n_given()), displacements);
    if (kept_) {
        columns_.add_product(loads.topRows(cols()), displacements);
        return;
    }
    const Eigen::Index n = 3 * system_->n_nodes(), n_loads = 3 * space_.n_slots();
    Eigen::MatrixXd response = Eigen::MatrixXd::Zero(n + 6, loads.cols());
    for_point_strips(system_->nodes(), [&](int source, const CollocationPoints& strip) {
        response.middleRows(3 * source, 3 * strip.size()).noalias() =
            system_->single_layer(strip, space_.elements, control) * loads.topRows(n_loads);
    });
    for (std::size_t i = 0; i < space_.dropped_collocation.size(); ++i)
        response.middleRows<3>(3 * space_.dropped_collocation[i]) +=
            loads.middleRows<3>(n_loads + 3 * static_cast<Eigen::Index>(i));
    system_->solve_in_place(response);
    displacements += response.topRows(displacements.rows());
}

std::uint64_t compliance_memory(const BemSystem& system, const TractionSpace& space) {
    const auto rows = 3 * static_cast<std::uint64_t>(system.n_nodes()) + 6;
    const auto unknowns = static_cast<std::uint64_t>(space.n_degrees_of_freedom());
    const std::uint64_t strips = 3 * kPointsAtOnce * (rows + unknowns) + 2 * kStripColumns * rows;
    return 8 * ((unknowns + 6) * (unknowns + 6) + strips) +
           (system.keeps(space) ? 8 * rows * unknowns : system.cache_budget() / 2);
}

ReducedSystem reduced_system(const std::shared_ptr<const BemSystem>& system, const TractionSpace& space,
                             const std::vector<int>& nodes, std::span<const UnitLoad> loads, Control& control) {
    ReducedSystem reduced;
    reduced.compliance_columns = std::make_shared<const BemComplianceColumns>(system, space, loads, control);
    reduced.rigid = system->rigid();
    reduced.nodes = nodes;
    reduced.n_loads = 3 * space.n_slots();
    return reduced;
}

}  // namespace elastolab
