#include "deform/deformer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <Eigen/Geometry>
#include <limits>
#include <mutex>
#include <string>

#include "base/column_sum.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"
#include "deform/holds.hpp"
#include "deform/load_parts.hpp"
#include "deform/patch_reactions.hpp"
#include "deform/solid_model.hpp"

namespace elastolab {

namespace {

[[maybe_unused]] bool all_differ(const ConstrainedSet& set, int n_vertices) {
    std::vector<int> vertices = joined(set.base, set.handles);
    std::sort(vertices.begin(), vertices.end());
    return std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end() &&
           (vertices.empty() || (vertices.front() >= 0 && vertices.back() < n_vertices));
}

/// The vertex that moves most, and how far.
double largest_motion(const Eigen::VectorXd& u, Eigen::Index& vertex) {
    return u.size() == 0
               ? 0.0
               : Eigen::Map<const Eigen::Matrix3Xd>(u.data(), 3, u.size() / 3).colwise().norm().maxCoeff(&vertex);
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

std::unique_ptr<ConstrainedSolid> constrained(const SolidModel& solid, std::span<const int> base,
                                              std::span<const int> handles, std::span<const UnitLoad> loads, bool held,
                                              Control& control) {
    try {
        return solid.constrain(base, handles, loads, control);
    } catch (const NotHeldError&) {
        if (held) throw NotHeldError(kSingularThoughHeld);
        throw;
    }
}

/// Binary exponent of a magnitude; 0 where that is zero, denormal or not finite.
int exponent_of(double largest) { return std::isnormal(largest) ? std::clamp(std::ilogb(largest), -1000, 1000) : 0; }

/// Near nu = -1 a body resists shear 1 / (1 + nu) times more than stretch. Where a part of the displacement error is
/// spurious shear, forces are too large by that factor times that part, in the better answer too, so that the
/// difference of both does not show it. The smallest such part that was measured (Galerkin BEM, bending).
constexpr double kShearForces = 0.1;
double shear_over_stretch(const Body& body) { return 1.0 / (1.0 + body.material.poisson_ratio); }

/// Forces below this fraction of Young's modulus times displacement times length are rounding.
constexpr double kNoForce = 1e-9;

double largest_of(const Eigen::Matrix3Xd& forces) { return forces.size() == 0 ? 0.0 : forces.cwiseAbs().maxCoeff(); }

/// Throws where a force that is not zero is next to it in double precision.
void require_normal(double force, const std::string& name) {
    if (force < std::numeric_limits<double>::min())
        throw SolveError(name + ": forces are below double precision. Choose other units of force or length.");
}

Reactions no_reactions(Eigen::Index n) { return {Eigen::Matrix3Xd::Zero(3, n), Eigen::Matrix3Xd::Zero(3, n)}; }

}  // namespace

/// One solid's share of the constrained set.
struct Deformer::SolidState {
    std::unique_ptr<ConstrainedSolid> solid;  ///< null: no constrained vertex, so it rests
    std::vector<int> base, handles;           ///< vertices of the solid
    std::vector<int> base_rows, handle_rows;  ///< their positions in the lists of the whole set

    std::vector<UnitLoad> loads;          ///< that act on the solid, with its triangles
    std::vector<Eigen::Index> load_rows;  ///< of the values
    Eigen::VectorXd load_units;           ///< the solid's factor of a load over the body's
    FreeWork free_work;                   ///< of these loads

    bool is_constrained() const { return !base.empty() || !handles.empty() || !loads.empty(); }

    /// Values of the base (zero), the handles and the loads of this solid, out of those of the whole body.
    Eigen::MatrixXd values(const Eigen::MatrixXd& all) const {
        const Eigen::Index n = 3 * std::ssize(base_rows) + 3 * std::ssize(handle_rows);
        Eigen::MatrixXd own = Eigen::MatrixXd::Zero(n + std::ssize(loads), all.cols());
        own.bottomRows(std::ssize(loads)) = load_units.asDiagonal() * all(load_rows, Eigen::all);
        for (std::size_t i = 0; i < handle_rows.size(); ++i)
            own.middleRows<3>(3 * static_cast<Eigen::Index>(base_rows.size() + i)) =
                all.middleRows<3>(3 * handle_rows[i]);
        return own;
    }
};

/// The equilibria that were found last.
class Deformer::Memory {
public:
    std::shared_ptr<const Equilibrium> find(const Eigen::VectorXd& values) const {
        const std::scoped_lock lock(mutex_);
        for (const auto& known : equilibria_)
            if (known->values.size() == values.size() && known->values == values) return known;
        return nullptr;
    }
    void add(std::shared_ptr<const Equilibrium> found) {
        const std::scoped_lock lock(mutex_);
        std::erase_if(equilibria_, [&](const auto& known) { return known->values == found->values; });
        equilibria_.push_front(std::move(found));
        if (equilibria_.size() > kRemembered) equilibria_.pop_back();
    }

private:
    static constexpr std::size_t kRemembered = 3;
    mutable std::mutex mutex_;
    std::deque<std::shared_ptr<const Equilibrium>> equilibria_;
};

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
    pick(set.base, state.base, state.base_rows);
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
                               joined(state.base, state.handles), state.loads);
}

std::uint64_t Deformer::predict_memory(const ConstrainedSet& set) const {
    std::uint64_t sum = 0;
    for (const Model::Part& part : model_->parts())
        if (const SolidState state = split(set, part); state.is_constrained())
            sum +=
                part.solid->constrain_memory(state.base, state.handles) +
                kColumnsOfLoad * 24 * static_cast<std::uint64_t>(part.solid->facts().n_vertices) * state.loads.size();
    return sum;
}

/// Solids are checked one after the other.
std::uint64_t Deformer::predict_check_memory(const ConstrainedSet& set) const {
    std::uint64_t most = 0;
    for (const Model::Part& part : model_->parts())
        if (const SolidState state = split(set, part); state.is_constrained())
            most = std::max(most, part.solid->check_memory(state.base, state.handles));
    return most;
}

void Deformer::require_memory(const ConstrainedSet& set) const {
    const std::uint64_t needed = predict_memory(set), available = available_memory_bytes();
    if (needed <= available) return;
    throw SolveError(model_->body().name + ": " + std::to_string(set.base.size() + set.handles.size()) +
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
            const bool holds_it = holds(all(Eigen::all, part.vertices), joined(state.base, state.handles));
            state.solid = constrained(*part.solid, state.base, state.handles, state.loads, holds_it, control);
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

Approach Deformer::remembered(const Eigen::VectorXd& values, const Approach& approach) const {
    if (linear() || approach.start || approach.path.cols() > 0) return approach;
    return {memory_->find(values), {}};
}

NodeSolution Deformer::solve(std::size_t part, const Eigen::MatrixXd& values, const Eigen::MatrixXd& changes,
                             bool want_loads, const Approach& approach, double tolerance, Control& control) const {
    const SolidState& state = solids_[part];
    const double unit = unit_of(part);
    const auto own = [&](const Eigen::MatrixXd& all) -> Eigen::MatrixXd {
        if (all.cols() == 0) return {};
        return unit == 1.0 ? state.values(all) : Eigen::MatrixXd(unit * state.values(all));
    };
    const NodeTask task{own(values), own(changes), approach.start ? approach.start->solids[part].get() : nullptr,
                        own(approach.path), want_loads};
    try {
        return state.solid->solve(task, tolerance, control);
    } catch (const NoEquilibriumError& error) {
        const Model::Part& of = model_->parts()[part];
        const Eigen::Vector3d place = error.place() / of.scale + of.origin;
        throw NoEquilibriumError(model_->body().name + ": " + error.what() + " The body is crushed most near " +
                                     readable_point(place) +
                                     (state.loads.empty() ? ". Pull less far, or in smaller steps."
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
    return displace_by(values, {}, tolerance, {}, control).u;
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

void Deformer::add_reactions(std::size_t part, Reactions own, Reactions& sum) const {
    const SolidState& state = solids_[part];
    // In the solid, coordinates are those of the body times a factor, displacements are as they are: a force is
    // stiffness times displacement, [E L] [L].
    const Eigen::Vector3d& origin = model_->parts()[part].origin;
    const double unit = 1.0 / model_->parts()[part].scale;
    const double displacement = 1.0 / unit_of(part);  // of those that are scaled too
    own.forces *= unit * displacement;
    own.moments *= unit * unit * displacement;
    if (const double largest = largest_of(own.forces); largest > 0.0)
        require_normal(largest * model_->body().material.young_modulus, model_->body().name);
    for (Eigen::Index i = 0; i < own.forces.cols(); ++i) own.moments.col(i) += origin.cross(own.forces.col(i).eval());
    Eigen::Index column = 0;
    const auto place_at = [&](Eigen::Index target) {
        sum.forces.col(target) = own.forces.col(column) * model_->body().material.young_modulus;
        sum.moments.col(target) = own.moments.col(column++) * model_->body().material.young_modulus;
    };
    for (const int row : state.base_rows) place_at(row);
    for (const int row : state.handle_rows) place_at(std::ssize(set_.base) + row);
}

void Deformer::add_loads_of(std::size_t part, const Eigen::MatrixXd& own, std::vector<Resultant>& sum) const {
    const SolidState& state = solids_[part];
    const double unit = 1.0 / model_->parts()[part].scale, E = model_->body().material.young_modulus;
    for (Eigen::Index i = 0; i < own.cols(); ++i) {
        const Eigen::Index row = state.load_rows[static_cast<std::size_t>(i)] - 3 * std::ssize(set_.handles);
        Resultant& load = sum[static_cast<std::size_t>(row)];
        const Eigen::Vector3d force = E * unit * unit * own.col(i).head<3>();
        load.force += force;
        load.moment += E * unit * unit * unit * own.col(i).tail<3>() + model_->parts()[part].origin.cross(force);
    }
}

Reactions Deformer::reactions(const Eigen::VectorXd& values) const {
    Control control;
    return answer(values, {}, control).reactions;
}

double Deformer::residual(const Eigen::VectorXd& values, Control& control) const {
    return answer(values, {.residual = true}, control).residual.value();
}

std::optional<DiscretisationCheck> Deformer::discretisation_check(const Eigen::VectorXd& values,
                                                                  Control& control) const {
    return answer(values, {.check = true}, control).check;
}

std::shared_ptr<const InteriorField> Deformer::inside(const Eigen::MatrixXd& values, Control& control) const {
    std::vector<int> part_of_vertex(static_cast<std::size_t>(model_->facts().n_vertices), 0);
    std::vector<BodyField::Part> parts;
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        const Model::Part& part = model_->parts()[s];
        for (const int v : part.vertices) part_of_vertex[static_cast<std::size_t>(v)] = static_cast<int>(s);
        parts.push_back({nullptr, part.origin, part.scale, !linear()});
        if (const ConstrainedSolid* solid = solids_[s].solid.get()) {
            const Approach from = values.cols() == 1 ? remembered(values.col(0), {}) : Approach{};
            parts.back().field = solid->inside(solve(s, values, {}, true, from, kSolveTolerance, control), control);
        }
    }
    const Body& body = model_->body();
    std::vector<int> part_of_triangle;
    for (const auto& triangle : body.surface->triangles.colwise())
        part_of_triangle.push_back(part_of_vertex[static_cast<std::size_t>(triangle[0])]);
    return std::make_shared<const BodyField>(body.surface, std::move(part_of_triangle), std::move(parts),
                                             body.material.young_modulus, values.cols());
}

std::optional<DiscretisationCheck> Deformer::check_of(const Answer& answer, const SolutionError& error) const {
    const SurfaceMesh& surface = *model_->body().surface;
    Eigen::Index moving_most = 0, worst = 0;
    // Relative to the better answer: one that moves too little would overstate its error.
    const double size = largest_motion(answer.displacements + error.to_better * error.displacements, moving_most);
    const double off = largest_motion(error.displacements, worst);
    if (!std::isfinite(off)) return {};
    const ConstrainedPatches patches = constrained_patches(surface, set_.base, set_.handles);
    const double length = (surface.vertices.rowwise().maxCoeff() - surface.vertices.rowwise().minCoeff()).norm();
    const Reactions better{answer.reactions.forces + error.to_better * error.reactions.forces,
                           answer.reactions.moments + error.to_better * error.reactions.moments};
    const double force = std::max(largest_patch_reaction(surface, patches, better),
                                  kNoForce * model_->body().material.young_modulus * size * length);
    const double force_off = largest_patch_reaction(surface, patches, error.reactions);
    const double u_error = size > 0.0 ? off / size : 0.0;
    return DiscretisationCheck{
        u_error, static_cast<int>(worst),
        std::max(force > 0.0 ? force_off / force : 0.0, kShearForces * u_error * shear_over_stretch(model_->body()))};
}

Deformer::Answer Deformer::answer(const Eigen::VectorXd& values, Wanted wanted, Control& control,
                                  const Approach& approach) const {
    assert(values.size() == set_.n_values());
    require_balance(values);
    // Residuals and errors square numbers: for values of order one these are far from over- and underflow. The problem
    // is linear, and a power of two rounds nothing. Where it is not linear, its solids have order one by themselves.
    double largest = 0.0;
    for (const SolidState& state : solids_)
        if (state.solid) largest = std::max(largest, state.values(values).cwiseAbs().maxCoeff());
    const int exponent = linear() ? exponent_of(largest) : 0;
    const Eigen::VectorXd unit_values = values * std::ldexp(1.0, -exponent);
    const double unit = std::ldexp(1.0, exponent);
    const Approach from = remembered(values, approach);
    const Eigen::Index n = 3 * model_->facts().n_vertices;
    const Eigen::Index n_constrained = std::ssize(set_.base) + std::ssize(set_.handles);
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(n, 1), off = u;
    Answer answer;
    answer.reactions = no_reactions(n_constrained);
    SolutionError error{{}, answer.reactions};
    auto found = std::make_shared<Equilibrium>();
    found->values = values;
    if (!linear()) answer.loads.resize(set_.loads.size());
    if (wanted.residual) answer.residual = 0.0;
    wanted.check = wanted.check && model_->method().kind->reported_error.has_value();
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        found->solids.emplace_back(nullptr);
        const ConstrainedSolid* solid = solids_[s].solid.get();
        if (solid == nullptr) continue;
        NodeSolution solution = solve(s, unit_values, {}, true, from, kSolveTolerance, control);
        found->solids.back() = solution.state;
        add_reactions(s, solid->reactions(solution), answer.reactions);
        if (!linear()) add_loads_of(s, solution.resultants, answer.loads);
        if (wanted.residual) answer.residual = std::max(*answer.residual, solid->residual(solution, control));
        if (wanted.check) {
            std::optional<SolutionError> own =
                solid->error(unit_of(s) * solids_[s].values(unit_values), solution, control);
            wanted.check = own.has_value();
            if (own) {
                error.to_better = own->to_better;
                place(s, own->displacements / unit_of(s), off);
                add_reactions(s, std::move(own->reactions), error.reactions);
            }
        }
        place(s, solid->displacements(std::move(solution)) / unit_of(s), u);
    }
    answer.displacements = u.col(0);
    error.displacements = off.col(0);
    if (wanted.check) answer.check = check_of(answer, error);
    answer.displacements *= unit;
    if (const double force = largest_of(answer.reactions.forces); force > 0.0)
        require_normal(force * unit, model_->body().name);
    answer.reactions.forces *= unit;
    answer.reactions.moments *= unit;
    if (!linear()) remember(std::move(found), answer);
    require_finite(answer.displacements);
    if (!answer.reactions.forces.allFinite() || !answer.reactions.moments.allFinite())
        throw SolveError(model_->body().name +
                         ": forces are beyond double precision. Choose a smaller Young's modulus, or smaller motions.");
    return answer;
}

void Deformer::remember(std::shared_ptr<const Equilibrium> found, Answer& answer) const {
    EquilibriumFacts sum;
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        if (!found->solids[s]) continue;
        const EquilibriumFacts facts = found->solids[s]->facts();
        sum.iterations += facts.iterations;
        const double unit = model_->body().material.young_modulus / std::pow(model_->parts()[s].scale, 3);
        sum.energy += facts.energy * unit;
        sum.work_of_loads += facts.work_of_loads * unit;
        sum.largest_stretch = std::max(sum.largest_stretch, facts.largest_stretch);
        sum.stable = sum.stable && facts.stable;
    }
    answer.facts = sum;
    memory_->add(found);
    answer.equilibrium = std::move(found);
}

}  // namespace elastolab
