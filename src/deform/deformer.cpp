#include "deform/deformer.hpp"

#include <algorithm>
#include <cassert>
#include <string>

#include "base/column_sum.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"
#include "deform/deformer_state.hpp"
#include "deform/holds.hpp"

namespace elastolab {

namespace {

[[maybe_unused]] bool all_differ(const ConstrainedSet& set, int n_vertices) {
    std::vector<int> vertices = joined(set.fixed, set.handles);
    std::sort(vertices.begin(), vertices.end());
    return std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end() &&
           (vertices.empty() || (vertices.front() >= 0 && vertices.back() < n_vertices));
}

/// Vectors of the vertices that a load takes.
constexpr std::uint64_t kColumnsOfLoad = 3;

/// The part of a surface that these vertices make up; local: their numbers, -1 for others.
SurfaceMesh solid_of(const SurfaceMesh& surface, const std::vector<int>& vertices, const std::vector<int>& local) {
    SurfaceMesh solid{surface.vertices(Eigen::all, vertices), {}};
    std::vector<int> own;
    for (int t = 0; t < surface.n_triangles(); ++t)
        if (local[static_cast<std::size_t>(surface.triangles(0, t))] >= 0) own.push_back(t);
    solid.triangles = surface.triangles(Eigen::all, own);
    for (int& v : solid.triangles.reshaped()) v = local[static_cast<std::size_t>(v)];
    return solid;
}

std::unique_ptr<ConstrainedSolid> constrained(const SolidModel& solid, std::span<const int> fixed,
                                              std::span<const int> handles, std::span<const UnitLoad> loads, bool held,
                                              Control& control) {
    try {
        return solid.constrain(fixed, handles, loads, control);
    } catch (const NotHeldError&) {
        if (held) throw NotHeldError(kSingularThoughHeld);
        throw;
    }
}

}  // namespace

void DragResponse::displace(const Eigen::VectorXd& parameters, Eigen::VectorXd& u) const {
    column_sum(rest, X, parameters, u);
}

Deformer::Deformer(std::shared_ptr<const Model> model)
    : model_(std::move(model)), solids_(model_->parts().size()), memory_(std::make_unique<Memory>()) {}
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
    pick(set.fixed, state.fixed, state.fixed_rows);
    pick(set.handles, state.handles, state.handle_rows);
    if (!set.loads.empty()) add_loads(set, part, local, state);
    return state;
}

/// In the solid Young's modulus is 1 and coordinates are multiplied: tractions are [E] over [L], displacements as they
/// are, so that a traction is divided by E and the scale, and a force per volume by the scale once more.
void Deformer::add_loads(const ConstrainedSet& set, const Model::Part& part, const std::vector<int>& local,
                         SolidState& state) const {
    const SurfaceMesh& surface = *model_->body().surface;
    std::vector<int> own_triangle(static_cast<std::size_t>(surface.n_triangles()), -1);
    int n_own = 0;
    for (int t = 0; t < surface.n_triangles(); ++t)
        if (local[static_cast<std::size_t>(surface.triangles(0, t))] >= 0)
            own_triangle[static_cast<std::size_t>(t)] = n_own++;
    const double unit = 1.0 / (model_->body().material.young_modulus * part.scale);
    std::vector<double> units;
    for (Eigen::Index i = 0; i < std::ssize(set.loads); ++i) {
        const UnitLoad& load = set.loads[static_cast<std::size_t>(i)];
        UnitLoad own = on_triangles(load, own_triangle);
        if (!load.is_body_force() && own.triangles.empty()) continue;
        units.push_back(load.is_body_force() ? unit / part.scale : unit);
        state.loads.push_back(std::move(own));
        state.load_rows.push_back(3 * std::ssize(set.handles) + i);
    }
    state.load_units = Eigen::Map<const Eigen::VectorXd>(units.data(), std::ssize(units));
    if (state.loads.empty()) return;
    const bool whole = part.vertices.size() == static_cast<std::size_t>(surface.n_vertices());
    state.free_work = FreeWork(whole ? surface : solid_of(surface, part.vertices, local),
                               joined(state.fixed, state.handles), state.loads);
}

std::uint64_t Deformer::predict_memory(const ConstrainedSet& set) const {
    std::uint64_t sum = 0;
    for (const Model::Part& part : model_->parts())
        if (const SolidState state = split(set, part); state.is_constrained())
            sum +=
                part.solid->constrain_memory(state.fixed, state.handles) +
                kColumnsOfLoad * 24 * static_cast<std::uint64_t>(part.solid->facts().n_vertices) * state.loads.size();
    return sum;
}

/// Solids are checked one after the other.
std::uint64_t Deformer::predict_check_memory(const ConstrainedSet& set) const {
    std::uint64_t most = 0;
    for (const Model::Part& part : model_->parts())
        if (const SolidState state = split(set, part); state.is_constrained())
            most = std::max(most, part.solid->check_memory(state.fixed, state.handles));
    return most;
}

void Deformer::require_memory(const ConstrainedSet& set) const {
    const std::uint64_t needed = predict_memory(set), available = available_memory_bytes();
    if (needed <= available) return;
    throw SolveError(model_->body().name + ": " + std::to_string(set.fixed.size() + set.handles.size()) +
                     " constrained vertices need " + readable_bytes(static_cast<double>(needed)) + " of memory, " +
                     readable_bytes(static_cast<double>(available)) +
                     " is available. Constrain fewer vertices, or choose " +
                     std::string(model_->method().kind->cheaper) + ".");
}

void Deformer::constrain(ConstrainedSet set, Control& control) {
    assert(all_differ(set, model_->facts().n_vertices));
    require_memory(set);
    std::vector<SolidState> solids;
    SolutionQuality quality;
    for (const Model::Part& part : model_->parts()) {
        SolidState state = split(set, part);
        if (state.is_constrained()) {
            // Constant elements hold the triangles around a lone vertex, and may not see that a body is held too
            // little.
            const Positions& all = model_->body().surface->vertices;
            const bool holds_it = holds(all(Eigen::all, part.vertices), joined(state.fixed, state.handles));
            state.solid = constrained(*part.solid, state.fixed, state.handles, state.loads, holds_it, control);
            // The system of a body that may move is singular by nature: its condition tells nothing of the answer.
            if (holds_it || state.solid->held())
                quality.condition_estimate = std::max(quality.condition_estimate, state.solid->condition());
            quality.held = quality.held && state.solid->held() && holds_it;
            quality.free_to_move = quality.free_to_move || !holds_it;
        }
        solids.push_back(std::move(state));
    }
    solids_ = std::move(solids);
    set_ = std::move(set);
    quality_ = quality;
    memory_ = std::make_unique<Memory>();
}

void Deformer::place(std::size_t part, Eigen::MatrixXd&& own, Eigen::MatrixXd& all) const {
    if (model_->parts().size() == 1) {
        all = std::move(own);  // one solid has all vertices, in order
        return;
    }
    const std::vector<int>& vertices = model_->parts()[part].vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        all.middleRows<3>(3 * vertices[i]) = own.middleRows<3>(3 * static_cast<Eigen::Index>(i));
}

void Deformer::require_balance(const Eigen::MatrixXd& values) const {
    if (set_.loads.empty()) return;
    for (const SolidState& state : solids_)
        for (Eigen::Index column = 0; column < values.cols() && state.solid; ++column)
            if (!state.free_work.balanced(values.col(column)(state.load_rows)))
                throw SolveError(model_->body().name +
                                 ": its loads do not balance, and nothing holds the body against them. Fix a part of "
                                 "it, or add loads until their forces and moments sum to zero.");
}

void Deformer::require_finite(const Eigen::MatrixXd& u) const {
    if (!u.allFinite())
        throw SolveError(model_->body().name + ": displacements are not finite. Check the mesh and the handles.");
}

Eigen::MatrixXd Deformer::displace_all(const Eigen::MatrixXd& values) const {
    Control control;
    return displace_all(values, control);
}

double Deformer::unit_of(std::size_t part) const { return linear() ? 1.0 : model_->parts()[part].scale; }

std::shared_ptr<const Equilibrium> for_another_set(const Equilibrium& equilibrium) {
    auto start = std::make_shared<Equilibrium>(equilibrium);
    for (auto& solid : start->solids)
        if (solid) solid = solid->for_another_set();
    return start;
}

Approach Deformer::remembered(const Eigen::VectorXd& values, const Approach& approach) const {
    if (linear() || approach.start || approach.path.cols() > 0) return approach;
    return {memory_->find(values), {}, approach.most_steps};
}

NodeSolution Deformer::solve(std::size_t part, const Eigen::MatrixXd& values, const Eigen::MatrixXd& changes,
                             bool want_loads, const Approach& approach, double tolerance, Control& control) const {
    const SolidState& state = solids_[part];
    const double unit = unit_of(part);
    const auto own = [&](const Eigen::MatrixXd& all) -> Eigen::MatrixXd {
        if (all.cols() == 0) return {};
        return unit == 1.0 ? state.values(all) : Eigen::MatrixXd(unit * state.values(all));
    };
    const NodeTask task{own(values),        own(changes), approach.start ? approach.start->solids[part].get() : nullptr,
                        own(approach.path), want_loads,   approach.most_steps};
    try {
        return state.solid->solve(task, tolerance, control);
    } catch (const NoEquilibriumError& error) {
        const Model::Part& of = model_->parts()[part];
        const Eigen::Vector3d place = error.place() / of.scale + of.origin;
        throw NoEquilibriumError(model_->body().name + ": " + error.what() + " " + readable_point(place) +
                                     (set_.handles.empty()  ? ". Make the loads smaller."
                                      : state.loads.empty() ? ". Pull less far, or in smaller steps."
                                                            : ". Pull less far, or make the loads smaller."),
                                 place);
    }
}

Deformer::Displaced Deformer::displace_by(const Eigen::MatrixXd& values, const Eigen::MatrixXd& changes,
                                          double tolerance, const Approach& approach, Control& control) const {
    assert(values.rows() == set_.n_values() || values.cols() == 0);
    require_balance(values);  // but not each of the changes, which need not balance by themselves
    const Approach from = values.cols() == 1 ? remembered(values.col(0), approach) : approach;
    Displaced result{Eigen::MatrixXd::Zero(3 * model_->facts().n_vertices, values.cols() + changes.cols()), nullptr};
    auto found = std::make_shared<Equilibrium>();
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        found->solids.emplace_back(nullptr);
        if (!solids_[s].solid) continue;
        NodeSolution solution = solve(s, values, changes, false, from, tolerance, control);
        found->solids.back() = solution.state;
        Eigen::MatrixXd own = solids_[s].solid->displacements(std::move(solution));
        if (unit_of(s) != 1.0) own /= unit_of(s);
        place(s, std::move(own), result.u);
    }
    require_finite(result.u);
    if (linear() || values.cols() == 0) return result;
    found->values = values.rightCols<1>();
    result.equilibrium = std::move(found);
    if (tolerance <= kSolveTolerance) memory_->add(result.equilibrium);
    return result;
}

Eigen::MatrixXd Deformer::displace_all(const Eigen::MatrixXd& values, Control& control, double tolerance) const {
    constexpr Eigen::Index kBlock = 64;  // what solvers need for each beside its answer can be many times that
    const Eigen::Index n = values.cols(), rows = 3 * model_->facts().n_vertices;
    if (n <= kBlock) return displace_by(values, {}, tolerance, {}, control).u;
    const double needed = 8.0 * static_cast<double>(rows) * static_cast<double>(n);
    const std::uint64_t available = available_memory_bytes();
    if (needed > static_cast<double>(available))
        throw SolveError(model_->body().name + ": " + std::to_string(n) + " answers need " + readable_bytes(needed) +
                         " of memory, " + readable_bytes(static_cast<double>(available)) +
                         " is available. Ask for fewer at once.");
    Eigen::MatrixXd u(rows, n);
    control.begin_stage("displace");
    for (Eigen::Index first = 0; first < n; first += kBlock) {
        control.checkpoint();
        control.set_progress(static_cast<double>(first) / static_cast<double>(n));
        const Eigen::Index m = std::min(kBlock, n - first);
        u.middleCols(first, m) = displace_by(values.middleCols(first, m), {}, tolerance, {}, control).u;
    }
    return u;
}

Eigen::VectorXd Deformer::displace(const Eigen::VectorXd& values) const { return displace_all(values); }

Eigen::VectorXd Deformer::displace(const Eigen::VectorXd& values, Control& control, double tolerance,
                                   const Approach& approach) const {
    return displace_by(values, {}, tolerance, approach, control).u;
}

bool Deformer::iterates() const {
    return std::any_of(solids_.begin(), solids_.end(),
                       [](const SolidState& state) { return state.solid && state.solid->iterates(); });
}

DragResponse Deformer::drag_response(const Eigen::VectorXd& values, const Eigen::MatrixXd& basis) const {
    Control control;
    return drag_response(values, basis, control);
}

DragResponse Deformer::drag_response(const Eigen::VectorXd& values, const Eigen::MatrixXd& basis, Control& control,
                                     double tolerance, const Approach& approach) const {
    Displaced displaced = displace_by(values, basis, tolerance, approach, control);
    return {displaced.u.col(0), displaced.u.rightCols(basis.cols()), std::move(displaced.equilibrium)};
}

}  // namespace elastolab
