#include "deform/deformer.hpp"

#include <algorithm>
#include <cassert>
#include <iomanip>
#include <sstream>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"
#include "deform/solid_model.hpp"

namespace elastolab {

namespace {

/// Condition of the small system from which on fewer than six digits are left.
constexpr double kPoorCondition = 1e10;

[[maybe_unused]] bool all_differ(const ConstrainedSet& set, int n_vertices) {
    std::vector<int> vertices = set.base;
    vertices.insert(vertices.end(), set.handles.begin(), set.handles.end());
    std::sort(vertices.begin(), vertices.end());
    return std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end() &&
           (vertices.empty() || (vertices.front() >= 0 && vertices.back() < n_vertices));
}

std::string short_number(double value) {
    std::ostringstream text;
    text << std::setprecision(2) << value;
    return text.str();
}

}  // namespace

/// One solid's share of the constrained set.
struct Deformer::SolidState {
    std::unique_ptr<ConstrainedSolid> solid;  ///< null: no constrained vertex, so it rests
    std::vector<int> base, handles;           ///< vertices of the solid
    std::vector<int> base_rows, handle_rows;  ///< their positions in the lists of the whole set

    bool is_constrained() const { return !base.empty() || !handles.empty(); }

    /// Values of the base (zero) and the handles of this solid, out of those of the whole body.
    Eigen::MatrixXd values(const Eigen::MatrixXd& all) const {
        Eigen::MatrixXd own =
            Eigen::MatrixXd::Zero(3 * std::ssize(base_rows) + 3 * std::ssize(handle_rows), all.cols());
        for (std::size_t i = 0; i < handle_rows.size(); ++i)
            own.middleRows<3>(3 * static_cast<Eigen::Index>(base_rows.size() + i)) =
                all.middleRows<3>(3 * handle_rows[i]);
        return own;
    }
};

void DragResponse::displace(const Eigen::VectorXd& parameters, Eigen::VectorXd& u) const {
    assert(parameters.size() == X.cols());
    u = rest;
    u.noalias() += X * parameters;
}

Deformer::Deformer(std::shared_ptr<const Model> model) : model_(std::move(model)), solids_(model_->parts().size()) {}
Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

Deformer::SolidState Deformer::split(const ConstrainedSet& set, const Model::Part& part) const {
    std::vector<int> local(static_cast<std::size_t>(model_->facts().n_vertices), -1);
    for (std::size_t i = 0; i < part.vertices.size(); ++i)
        local[static_cast<std::size_t>(part.vertices[i])] = static_cast<int>(i);
    SolidState state;
    const auto pick = [&](const std::vector<int>& vertices, std::vector<int>& own, std::vector<int>& rows) {
        for (std::size_t i = 0; i < vertices.size(); ++i)
            if (const int v = local[static_cast<std::size_t>(vertices[i])]; v >= 0) {
                own.push_back(v);
                rows.push_back(static_cast<int>(i));
            }
    };
    pick(set.base, state.base, state.base_rows);
    pick(set.handles, state.handles, state.handle_rows);
    return state;
}

std::uint64_t Deformer::predict_memory(const ConstrainedSet& set) const {
    std::uint64_t sum = 0;
    for (const Model::Part& part : model_->parts())
        if (const SolidState state = split(set, part); state.is_constrained())
            sum += part.solid->constrain_memory(state.base, state.handles);
    return sum;
}

void Deformer::require_memory(const ConstrainedSet& set) const {
    const std::uint64_t needed = predict_memory(set), available = available_memory_bytes();
    if (needed <= available) return;
    throw SolveError(model_->body().name + ": " + std::to_string(set.base.size() + set.handles.size()) +
                     " constrained vertices need " + readable_bytes(static_cast<double>(needed)) + " of memory, " +
                     readable_bytes(static_cast<double>(available)) + " are free. Constrain fewer vertices" +
                     (model_->method().kind == MethodKind::fem ? ", or use a coarser mesh." : ", or choose fem."));
}

void Deformer::constrain(ConstrainedSet set, Control& control) {
    assert(all_differ(set, model_->facts().n_vertices));
    require_memory(set);
    std::vector<SolidState> solids;
    SolutionQuality quality;
    for (const Model::Part& part : model_->parts()) {
        SolidState state = split(set, part);
        if (state.is_constrained()) {
            state.solid = part.solid->constrain(state.base, state.handles, control);
            quality.condition_estimate = std::max(quality.condition_estimate, state.solid->condition());
            quality.held = quality.held && state.solid->held();
        }
        solids.push_back(std::move(state));
    }
    if (!quality.held)
        quality.warnings.push_back(
            "constraints: leave the body free to move as a whole; the smallest motion is taken. "
            "Constrain three vertices that are not on one line.");
    else if (quality.condition_estimate > kPoorCondition)
        quality.warnings.push_back("constraints: nearly dependent (condition " +
                                   short_number(quality.condition_estimate) +
                                   "), so forces may be wrong. Remove handles that nearly coincide.");
    solids_ = std::move(solids);
    set_ = std::move(set);
    quality_ = std::move(quality);
}

Eigen::MatrixXd Deformer::displace_all(const Eigen::MatrixXd& values) const {
    assert(values.rows() == 3 * std::ssize(set_.handles));
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(3 * model_->facts().n_vertices, values.cols());
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        if (!solids_[s].solid) continue;
        Eigen::MatrixXd own = solids_[s].solid->displace(solids_[s].values(values));
        const std::vector<int>& vertices = model_->parts()[s].vertices;
        if (model_->parts().size() == 1) {
            u = std::move(own);  // one solid has all vertices, in order
        } else {
            for (std::size_t i = 0; i < vertices.size(); ++i)
                u.middleRows<3>(3 * vertices[i]) = own.middleRows<3>(3 * static_cast<Eigen::Index>(i));
        }
    }
    if (!u.allFinite())
        throw SolveError(model_->body().name + ": displacements are not finite. Check the mesh and the handles.");
    return u;
}

Eigen::VectorXd Deformer::displace(const Eigen::VectorXd& values) const { return displace_all(values); }

DragResponse Deformer::drag_response(const Eigen::VectorXd& values, const Eigen::MatrixXd& basis) const {
    Eigen::MatrixXd all(values.size(), basis.cols() + 1);
    all << values, basis;
    const Eigen::MatrixXd u = displace_all(all);
    return {u.col(0), u.rightCols(basis.cols())};
}

Reactions Deformer::reactions(const Eigen::VectorXd& values) const {
    const Eigen::Index n_base = std::ssize(set_.base), n = n_base + std::ssize(set_.handles);
    Reactions sum{Eigen::Matrix3Xd::Zero(3, n), Eigen::Matrix3Xd::Zero(3, n)};
    for (const SolidState& state : solids_) {
        if (!state.solid) continue;
        const Reactions own = state.solid->reactions(state.values(values).col(0));
        Eigen::Index column = 0;
        const auto place = [&](Eigen::Index target) {
            sum.forces.col(target) = own.forces.col(column) * model_->body().material.young_modulus;
            sum.moments.col(target) = own.moments.col(column++) * model_->body().material.young_modulus;
        };
        for (const int row : state.base_rows) place(row);
        for (const int row : state.handle_rows) place(n_base + row);
    }
    return sum;
}

double Deformer::residual(const Eigen::VectorXd& values, Control& control) const {
    double worst = 0.0;
    for (const SolidState& state : solids_)
        if (state.solid) worst = std::max(worst, state.solid->residual(state.values(values).col(0), control));
    return worst;
}

}  // namespace elastolab
