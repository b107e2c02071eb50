#include "deform/grip_equilibrium.hpp"

#include <algorithm>
#include <cassert>
#include <Eigen/Geometry>
#include <optional>

#include "base/error.hpp"
#include "deform/holds.hpp"
#include "elasticity/rotation.hpp"

namespace elastolab {

namespace {

/// Forces that no motion answers, over all forces.
constexpr double kUnansweredForces = 1e-6;
/// Forces that are left, over all forces: wanted; good enough where rounding allows no less.
constexpr double kForcesBalance = 1e-8, kForcesNearlyBalance = 1e-6;
/// A state is better than another whose energy is higher by this part of it, or whose missing forces are larger.
constexpr double kLeastGain = 1e-9, kFalls = 0.9;
constexpr int kWholeSteps = 4;
constexpr double kShortestStep = 1e-3;
constexpr int kMostSolves = 120, kMostPushes = 3;
/// Length of a push out of a state that is not stable, over that of the longest step.
constexpr double kPush = 0.1;

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Grips of a body: where their vertices are, and what forces and moments are at them.
class Grips {
public:
    Grips(const Deformer& deformer, const std::vector<Grip>& grips, const std::vector<GripForce>& forces)
        : deformer_(deformer),
          grips_(grips),
          wanted_(forces),
          n_base_(std::ssize(deformer.set().base)),
          rest_(deformer, grips) {}

    Index n() const { return 6 * std::ssize(grips_); }
    double length() const { return rest_.length; }
    VectorXd units() const { return rest_.units(); }

    /// Places -> their rows of the values.
    void put(const std::vector<GripPlace>& places, VectorXd& values) const {
        for (std::size_t g = 0; g < grips_.size(); ++g) {
            const Eigen::Matrix3Xd arms = present(places, g);
            for (Index i = 0; i < arms.cols(); ++i)
                values.segment<3>(3 * (grips_[g].begin + i)) = places[g].shift + arms.col(i) - rest_.arms[g].col(i);
        }
    }
    /// Changes of the values with the small motions of each grip: n_values x 6 k.
    MatrixXd basis(const std::vector<GripPlace>& places, Index n_values) const {
        MatrixXd basis = MatrixXd::Zero(n_values, n());
        for (std::size_t g = 0; g < grips_.size(); ++g) {
            const Eigen::Matrix3Xd arms = present(places, g);
            const Index first = 6 * static_cast<Index>(g);
            for (Index i = 0; i < arms.cols(); ++i) {
                const Index row = 3 * (grips_[g].begin + i);
                basis.block<3, 3>(row, first).setIdentity();
                basis.block<3, 3>(row, first + 3) = -cross_matrix(arms.col(i));
            }
        }
        return basis;
    }
    /// Force over moment about its present middle of each grip.
    VectorXd resultants(const std::vector<GripPlace>& places, const Eigen::Matrix3Xd& forces) const {
        VectorXd sums(n());
        for (std::size_t g = 0; g < grips_.size(); ++g) {
            const Eigen::Matrix3Xd arms = present(places, g);
            sums.segment<6>(6 * static_cast<Index>(g)) << own(g, forces).rowwise().sum(), moment(arms, own(g, forces));
        }
        return sums;
    }
    /// Derivatives of the resultants: forces change, and act at arms that turn.
    MatrixXd stiffness(const std::vector<GripPlace>& places, const Deformer::Answer& answer) const {
        MatrixXd matrix(n(), n());
        for (Index k = 0; k < n(); ++k)
            matrix.col(k) = resultants(places, answer.force_changes[static_cast<std::size_t>(k)]);
        for (std::size_t g = 0; g < grips_.size(); ++g) {
            const Eigen::Matrix3Xd arms = present(places, g);
            const Eigen::Matrix3Xd forces = own(g, answer.reactions.forces);
            const Index first = 6 * static_cast<Index>(g);
            for (Index i = 0; i < arms.cols(); ++i)
                matrix.block<3, 3>(first + 3, first + 3) += cross_matrix(forces.col(i)) * cross_matrix(arms.col(i));
            matrix.diagonal().segment<3>(first).array() += wanted_[g].spring;
        }
        return matrix;
    }
    VectorXd wanted(const std::vector<GripPlace>& places, const std::vector<GripForce>& forces) const {
        VectorXd all(n());
        for (std::size_t g = 0; g < grips_.size(); ++g)
            all.segment<6>(6 * static_cast<Index>(g)) << forces[g].force - forces[g].spring * places[g].shift,
                forces[g].moment;
        return all;
    }
    VectorXd wanted(const std::vector<GripPlace>& places) const { return wanted(places, wanted_); }

    /// Whether what else is constrained holds every solid that has a grip.
    bool body_is_held() const {
        const Positions& all = deformer_.model().body().surface->vertices;
        std::vector<char> kind(static_cast<std::size_t>(all.cols()), 0);  // 1: held, 2: of a grip
        const ConstrainedSet& set = deformer_.set();
        for (const int v : joined(set.base, set.handles)) kind[static_cast<std::size_t>(v)] = 1;
        for (const Grip& grip : grips_)
            for (int i = grip.begin; i < grip.end; ++i)
                kind[static_cast<std::size_t>(set.handles[static_cast<std::size_t>(i)])] = 2;
        return std::all_of(deformer_.model().parts().begin(), deformer_.model().parts().end(), [&](const auto& part) {
            std::vector<int> held;
            bool gripped = false;
            for (std::size_t i = 0; i < part.vertices.size(); ++i) {
                const char its = kind[static_cast<std::size_t>(part.vertices[i])];
                if (its == 1) held.push_back(static_cast<int>(i));
                gripped = gripped || its == 2;
            }
            return !gripped || holds(all(Eigen::all, part.vertices), held);
        });
    }

private:
    Eigen::Matrix3Xd present(const std::vector<GripPlace>& places, std::size_t g) const {
        return rotation_by(places[g].turn) * rest_.arms[g];
    }
    Eigen::Matrix3Xd own(std::size_t g, const Eigen::Matrix3Xd& all) const {
        return all.middleCols(n_base_ + grips_[g].begin, grips_[g].end - grips_[g].begin);
    }
    static Vector3d moment(const Eigen::Matrix3Xd& arms, const Eigen::Matrix3Xd& forces) {
        Vector3d sum = Vector3d::Zero();
        for (Index i = 0; i < arms.cols(); ++i) sum += arms.col(i).cross(forces.col(i));
        return sum;
    }

    const Deformer& deformer_;
    const std::vector<Grip>& grips_;
    const std::vector<GripForce>& wanted_;
    Index n_base_;
    GripArms rest_;
};

/// An equilibrium of the body with the grips at these places.
struct State {
    std::vector<GripPlace> places;
    VectorXd values;
    Deformer::Answer answer;
    VectorXd missing;  ///< force over moment of each grip: wanted less those that hold it there
    MatrixXd stiffness;
};

class Search {
public:
    Search(const Deformer& deformer, const std::vector<Grip>& grips, const std::vector<GripForce>& forces,
           Control& control)
        : deformer_(deformer),
          control_(control),
          grips_(deformer, grips, forces),
          forces_(forces),
          units_(grips_.units()),
          held_(grips_.body_is_held()) {}

    State at(std::vector<GripPlace> places, VectorXd values, const Approach& approach) {
        control_.checkpoint();
        ++solves_;
        State state{
            .places = std::move(places), .values = std::move(values), .answer = {}, .missing = {}, .stiffness = {}};
        grips_.put(state.places, state.values);
        state.answer = deformer_.answer(state.values, {.along = grips_.basis(state.places, state.values.size())},
                                        control_, approach);
        iterations_ += state.answer.facts->iterations;
        state.missing = grips_.wanted(state.places) - grips_.resultants(state.places, state.answer.reactions.forces);
        state.stiffness = grips_.stiffness(state.places, state.answer);
        return state;
    }

    State run(State state) {
        int pushes = 0;
        while (solves_ < kMostSolves) {
            const GripTangent stiffness = tangent(state);
            if (balanced(state, stiffness, kForcesBalance)) {
                if (stiffness.stable() || pushes++ == kMostPushes) return state;
                state = pushed(state, stiffness);
                continue;
            }
            std::optional<State> next = improved(state, stiffness);
            // Close to the answer, forces fall until they are those that the body's own equilibrium leaves.
            const bool falls = next && next->missing.norm() < 0.5 * state.missing.norm();
            if (!falls && balanced(state, stiffness, kForcesNearlyBalance)) return state;
            if (!next) break;
            state = *std::move(next);
        }
        throw SolveError(
            "handles under a force: no motion of theirs was found that balances it. Make the forces smaller, or let "
            "them grow in steps.");
    }
    /// Throws where something of the forces would move the grips without end.
    void require_answer(const State& state) const {
        const VectorXd all = units_.asDiagonal() * state.missing;
        if ((all - tangent(state).answered(state.missing)).norm() > kUnansweredForces * size_of(state))
            throw SolveError(kUnbalancedGrips);
    }
    int solves() const { return solves_; }
    int iterations() const { return iterations_; }
    GripTangent tangent(const State& state) const {
        return {state.stiffness, grips_.length(), deformer_.model().body().material.young_modulus, held_};
    }

private:
    double size_of(const State& state) const {
        const VectorXd wanted = grips_.wanted(state.places);
        return std::max((units_.asDiagonal() * wanted).norm(), (units_.asDiagonal() * (wanted - state.missing)).norm());
    }
    bool balanced(const State& state, const GripTangent& stiffness, double tolerance) const {
        return stiffness.answered(state.missing).norm() <= tolerance * size_of(state);
    }
    std::optional<State> tried(const State& state, const VectorXd& step) {
        std::vector<GripPlace> places;
        for (std::size_t g = 0; g < state.places.size(); ++g)
            places.push_back(moved(state.places[g], step.segment<6>(6 * static_cast<Index>(g))));
        try {
            return at(std::move(places), state.values, {state.answer.equilibrium, {}});
        } catch (const NoEquilibriumError&) {
            return std::nullopt;
        }
    }

    /// Energy of the body less the work of all forces. That of a moment is taken as if the rotation kept its axis.
    double potential(const State& state) const {
        double work = state.answer.facts->work_of_loads;
        for (std::size_t g = 0; g < state.places.size(); ++g) {
            const GripPlace& place = state.places[g];
            const GripForce& its = forces_[g];
            work +=
                its.force.dot(place.shift) - 0.5 * its.spring * place.shift.squaredNorm() + its.moment.dot(place.turn);
        }
        return state.answer.facts->energy - work;
    }
    bool better(const State& next, const State& state, const GripTangent& stiffness) const {
        return potential(next) < potential(state) - kLeastGain * std::abs(potential(state)) ||
               stiffness.answered(next.missing).norm() < kFalls * stiffness.answered(state.missing).norm();
    }
    std::optional<State> stepped(const State& state, const GripTangent& stiffness, double part) {
        const VectorXd step = stiffness.step(stiffness.answered(state.missing));
        return tried(state, part * std::min(1.0, longest_step(state.places, grips_.length(), step)) * step);
    }
    /// A better state after a few whole steps, since what resists much more than the rest (a slender bar its stretch)
    /// is put right by the step after; else after one that is short enough.
    std::optional<State> improved(const State& state, const GripTangent& stiffness) {
        std::optional<State> next = stepped(state, stiffness, 1.0);
        for (int i = 1; next && !better(*next, state, stiffness) && i < kWholeSteps; ++i)
            next = stepped(*next, tangent(*next), 1.0);
        for (double part = 0.5; (!next || !better(*next, state, stiffness)) && part > kShortestStep; part *= 0.5) {
            if (solves_ >= kMostSolves) return std::nullopt;
            next = stepped(state, stiffness, part);
        }
        return next && better(*next, state, stiffness) ? std::move(next) : std::nullopt;
    }
    State pushed(const State& state, const GripTangent& stiffness) {
        const VectorXd soft = stiffness.softest();
        std::optional<State> next = tried(state, kPush * longest_step(state.places, grips_.length(), soft) * soft);
        return next ? *std::move(next) : state;
    }

    const Deformer& deformer_;
    Control& control_;
    Grips grips_;
    const std::vector<GripForce>& forces_;
    VectorXd units_;
    bool held_;
    int solves_ = 0, iterations_ = 0;
};

}  // namespace

std::vector<GripPlace> GripEquilibrium::places_under(const std::vector<GripForce>& others) const {
    VectorXd more(6 * std::ssize(grips)), springs(std::ssize(grips));
    for (std::size_t g = 0; g < grips.size(); ++g) {
        const auto at = static_cast<Index>(g);
        springs[at] = others[g].spring - forces[g].spring;
        more.segment<6>(6 * at) << others[g].force - forces[g].force - springs[at] * places[g].shift,
            others[g].moment - forces[g].moment;
    }
    const GripTangent held = tangent.with_springs(springs);
    const VectorXd whole = held.step(held.answered(more));
    const VectorXd step = std::min(1.0, longest_step(places, tangent.length(), whole)) * whole;
    std::vector<GripPlace> found;
    for (std::size_t g = 0; g < grips.size(); ++g)
        found.push_back(moved(places[g], step.segment<6>(6 * static_cast<Index>(g))));
    return found;
}

GripEquilibrium find_grip_equilibrium(const Deformer& deformer, const VectorXd& values, const std::vector<Grip>& grips,
                                      const std::vector<GripForce>& forces, Control& control, const Approach& approach,
                                      const GripEquilibrium* before) {
    assert(!deformer.linear() && grips.size() == forces.size());
    Search search(deformer, grips, forces, control);
    const bool known = before != nullptr && before->grips == grips;
    State first = search.at(known ? before->places : std::vector<GripPlace>(grips.size()), values,
                            known ? Approach{before->equilibrium, {}} : approach);
    if (!known) search.require_answer(first);
    State state = search.run(std::move(first));
    GripTangent tangent = search.tangent(state);
    return {.grips = grips,
            .forces = forces,
            .places = std::move(state.places),
            .values = std::move(state.values),
            .equilibrium = std::move(state.answer.equilibrium),
            .tangent = std::move(tangent),
            .solves = search.solves(),
            .iterations = search.iterations()};
}

}  // namespace elastolab
