#include <algorithm>
#include <cassert>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "deform/deformer.hpp"
#include "deform/deformer_state.hpp"
#include "deform/node_rows.hpp"
#include "deform/patch_reactions.hpp"

namespace elastolab {

namespace {

/// Binary exponent of a magnitude; 0 where that is zero, denormal or not finite.
int exponent_of(double largest) { return std::isnormal(largest) ? std::clamp(std::ilogb(largest), -1000, 1000) : 0; }

/// Displacements below this fraction of what the loads could cause are none, and their errors what integrals leave: of
/// an incompressible body under pressure all around.
constexpr double kNoMotion = 1e-6;

/// Displacements of a solid of order one on which nothing acts: what an equilibrium that has unwound keeps of rounding.
constexpr double kRoundedRest = 1e-12;

double largest_of(const Eigen::Matrix3Xd& forces) { return forces.size() == 0 ? 0.0 : forces.cwiseAbs().maxCoeff(); }

/// Throws where a force that is not zero is next to it in double precision.
void require_normal(double force, const std::string& name) {
    if (force < std::numeric_limits<double>::min())
        throw SolveError(name + ": forces are below double precision. Choose other units of force or length.");
}

Reactions no_reactions(Eigen::Index n) { return {Eigen::Matrix3Xd::Zero(3, n), Eigen::Matrix3Xd::Zero(3, n)}; }

}  // namespace

void Deformer::add_reactions(std::size_t part, Reactions own, Reactions& sum) const {
    const Eigen::Vector3d& origin = model_->parts()[part].origin;
    const double force = force_unit_of(part);
    const bool any = largest_of(own.forces) > 0.0;
    own.forces *= force;
    own.moments *= force / model_->parts()[part].scale;
    if (any) require_normal(largest_of(own.forces), model_->body().name);
    for (Eigen::Index i = 0; i < own.forces.cols(); ++i) own.moments.col(i) += origin.cross(own.forces.col(i).eval());
    place_columns(part, own.forces, sum.forces);
    place_columns(part, own.moments, sum.moments);
}

/// In the solid, coordinates are those of the body times a factor, displacements are as they are or (of methods that
/// are not linear) scaled too: a force is stiffness times displacement, [E L] [L].
double Deformer::force_unit_of(std::size_t part) const {
    return model_->body().material.young_modulus / (model_->parts()[part].scale * unit_of(part));
}

void Deformer::place_columns(std::size_t part, const Eigen::Matrix3Xd& own, Eigen::Matrix3Xd& all) const {
    const SolidState& state = solids_[part];
    Eigen::Index column = 0;
    for (const int row : state.fixed_rows) all.col(row) = own.col(column++);
    for (const int row : state.handle_rows) all.col(std::ssize(set_.fixed) + row) = own.col(column++);
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

std::shared_ptr<const InteriorField> Deformer::interior_field(const Eigen::MatrixXd& values, Control& control) const {
    std::vector<int> part_of_vertex(static_cast<std::size_t>(model_->facts().n_vertices), 0);
    std::vector<BodyField::Part> parts;
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        const Model::Part& part = model_->parts()[s];
        for (const int v : part.vertices) part_of_vertex[static_cast<std::size_t>(v)] = static_cast<int>(s);
        parts.push_back({nullptr, part.origin, part.scale, !linear()});
        if (const ConstrainedSolid* solid = solids_[s].solid.get()) {
            const Approach from = values.cols() == 1 ? remembered(values.col(0), {}) : Approach{};
            parts.back().field =
                solid->interior_field(solve(s, values, {}, true, from, kSolveTolerance, control), control);
        }
    }
    const Body& body = model_->body();
    std::vector<int> part_of_triangle;
    for (const auto& triangle : body.surface->triangles.colwise())
        part_of_triangle.push_back(part_of_vertex[static_cast<std::size_t>(triangle[0])]);
    return std::make_shared<const BodyField>(body.surface, std::move(part_of_triangle), std::move(parts),
                                             body.material.young_modulus, values.cols());
}

std::optional<DiscretisationCheck> Deformer::check_of(const Answer& answer, const SolutionError& error,
                                                      const SolutionError& to_better,
                                                      const Eigen::VectorXd& values) const {
    const SurfaceMesh& surface = *model_->body().surface;
    const double resists = model_->body().material.young_modulus * size_of(surface);
    Eigen::Index moving_most = 0, worst = 0;
    // Relative to the better answer: one that moves too little would overstate its error.
    const double load_forces = gross_force(surface, set_.loads, values.tail(std::ssize(set_.loads)));
    const double size = std::max(largest_motion(answer.displacements + to_better.displacements, moving_most),
                                 kNoMotion * load_forces / resists);
    const double off = largest_motion(error.displacements, worst);
    if (!std::isfinite(off)) return {};
    const double u_error = size > 0.0 ? off / size : 0.0;
    const auto check = [&](double force_error) {
        return DiscretisationCheck{u_error, static_cast<int>(worst), force_error, error.displacements, {}};
    };
    if (answer.reactions.forces.cols() == 0) return check(0.0);
    // What pins bear is missing in the reactions of the second answer (deform/pinned_body.hpp).
    if (!quality_.held) return check(std::numeric_limits<double>::quiet_NaN());
    const bool is_exact =
        model_->method().kind->balances_forces && is_statically_determinate(surface, set_.fixed, set_.handles);
    const Reactions better{answer.reactions.forces + to_better.reactions.forces,
                           answer.reactions.moments + to_better.reactions.moments};
    DiscretisationCheck found = check(
        is_exact ? 0.0
                 : relative_reaction_error(model_->body(), set_, better, error.reactions, load_forces, size, u_error));
    found.reaction_error = error.reactions;
    return found;
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
    assert(wanted.along.cols() == 0 || !linear());
    const Eigen::VectorXd unit_values = values * std::ldexp(1.0, -exponent);
    const double unit = std::ldexp(1.0, exponent);
    const Approach from = remembered(values, approach);
    const Eigen::Index n = 3 * model_->facts().n_vertices;
    const Eigen::Index n_constrained = std::ssize(set_.fixed) + std::ssize(set_.handles);
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(n, 1), off = u, better = u;
    Answer answer;
    answer.reactions = no_reactions(n_constrained);
    SolutionError error{{}, answer.reactions}, to_better{{}, answer.reactions};
    auto found = std::make_shared<Equilibrium>();
    found->values = values;
    if (!linear()) answer.loads.resize(set_.loads.size());
    answer.force_changes.assign(static_cast<std::size_t>(wanted.along.cols()),
                                Eigen::Matrix3Xd::Zero(3, n_constrained));
    if (wanted.residual) answer.residual = 0.0;
    wanted.check = wanted.check && model_->method().kind->reported_error.has_value();
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        found->solids.emplace_back(nullptr);
        const ConstrainedSolid* solid = solids_[s].solid.get();
        if (solid == nullptr) continue;
        NodeSolution solution = solve(s, unit_values, wanted.along, true, from, kSolveTolerance, control);
        found->solids.back() = solution.state;
        add_reactions(s, solid->reactions(solution), answer.reactions);
        for (std::size_t k = 0; k < answer.force_changes.size(); ++k)
            place_columns(s, force_unit_of(s) * solid->forces(solution, 1 + static_cast<Eigen::Index>(k)),
                          answer.force_changes[k]);
        if (!linear()) add_loads_of(s, solution.resultants, answer.loads);
        const Eigen::MatrixXd prescribed = solids_[s].values(unit_values);
        // After whole turns nothing is prescribed, and the solid is wound up. Where it rests, that is exact.
        const bool rests =
            prescribed.isZero(0.0) && solution.displacements.col(0).cwiseAbs().maxCoeff() <= kRoundedRest;
        if (wanted.residual && !rests) answer.residual = std::max(*answer.residual, solid->residual(solution, control));
        if (wanted.check && !rests) {
            std::optional<SolutionError> own = solid->error(unit_of(s) * prescribed, solution, control);
            wanted.check = own.has_value();
            if (own) {
                place(s, own->displacements / unit_of(s), off);
                place(s, own->to_better / unit_of(s) * own->displacements, better);
                add_reactions(s, {own->to_better * own->reactions.forces, own->to_better * own->reactions.moments},
                              to_better.reactions);
                add_reactions(s, std::move(own->reactions), error.reactions);
            }
        }
        place(s, solid->displacements(std::move(solution)).leftCols(1) / unit_of(s), u);
    }
    answer.displacements = u.col(0);
    error.displacements = off.col(0);
    to_better.displacements = better.col(0);
    if (wanted.check) answer.check = check_of(answer, error, to_better, unit_values);
    answer.displacements *= unit;
    if (const double force = largest_of(answer.reactions.forces); force > 0.0)
        require_normal(force * unit, model_->body().name);
    answer.reactions.forces *= unit;
    answer.reactions.moments *= unit;
    if (answer.check) {
        answer.check->displacement_error *= unit;
        answer.check->reaction_error.forces *= unit;
        answer.check->reaction_error.moments *= unit;
    }
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
