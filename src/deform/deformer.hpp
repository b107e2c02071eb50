#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "deform/equilibrium.hpp"
#include "deform/interior_field.hpp"
#include "deform/iteration.hpp"
#include "deform/model.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

/// Which vertices are constrained. `fixed` vertices are held at rest; `handles` vertices follow prescribed
/// displacements. All numbers differ. The split matters for speed only: FEM eliminates the fixed set once. `loads` act
/// besides, each as large as a factor of its own says, which stands in the values behind the handles' displacements: a
/// load that changes its size, or its direction among unit loads, costs a frame and no solve.
struct ConstrainedSet {
    std::vector<int> fixed;
    std::vector<int> handles;
    std::vector<UnitLoad> loads = {};

    /// Rows of the values that go with the set: three for each handle vertex, then one for each load.
    Eigen::Index n_values() const { return 3 * std::ssize(handles) + std::ssize(loads); }
    bool operator==(const ConstrainedSet&) const = default;
};

/// Displacements of all vertices as an affine function of a few parameters: u = rest + X * parameters.
struct DragResponse {
    Eigen::VectorXd rest;  ///< 3*n_vertices [L]
    Eigen::MatrixXd X;     ///< 3*n_vertices x n_parameters
    /// Of methods that are not linear: the equilibrium at `rest`, from which the next one may begin. X is then the
    /// tangent there, and displacements are right to second order in the parameters.
    std::shared_ptr<const Equilibrium> equilibrium = nullptr;

    /// u <- rest + X * parameters: one pass over the columns of X, the whole cost of a frame.
    void displace(const Eigen::VectorXd& parameters, Eigen::VectorXd& u) const;
};

/// What the supports exert on the body, for each constrained vertex.
struct Reactions {
    Eigen::Matrix3Xd forces;   ///< 3 x n [force]
    Eigen::Matrix3Xd moments;  ///< 3 x n, about the origin [force * L]
};

/// What should be known about a solution before it is believed.
struct SolutionQuality {
    double condition_estimate =
        1.0;                    ///< of the capacitance system (reduced) or K00 (direct), 1-norm; largest of the solids
    bool held = true;           ///< false: the system has no unique solution, the smallest is taken
    bool free_to_move = false;  ///< the reason for that: some solid can move as a whole
};

/// How far displacements and reactions may be off because the mesh is coarse.
struct DiscretisationCheck {
    /// Estimated error of the worst vertex, over the largest displacement of the better answer.
    double relative_error = 0.0;
    int vertex = -1;  ///< the worst
    /// Estimated error of the reactions of the worst patch, over the largest (deform/patch_reactions.hpp); not a number
    /// where constrained vertices leave the body free to move.
    double relative_force_error = 0.0;
    /// The estimated errors themselves: 3*n_vertices [L], and of the reactions, which are empty where those are left
    /// out.
    Eigen::VectorXd displacement_error = {};
    Reactions reaction_error = {};
};

struct NodeSolution;
struct SolutionError;

/// Displacements of a Model for one constrained set at a time. Owned by one thread, others may call its const members
/// while it is not changed; several may share a Model.
///
/// Of methods that are not linear (MethodTraits::linear) an answer is an equilibrium, found by iteration:
///   - `values` are displacements as ever. Which equilibrium is found depends on the Approach: from rest along the
///     shortest rotation of each handle unless it says otherwise. Only displace_all and interior_field have several
///     columns of values, each an equilibrium of its own, found in their order.
///   - drag_response is the equilibrium at `values` and the columns of its tangent; it brings the `equilibrium` that
///     the next drag_response starts from.
///   - An equilibrium that was found is remembered (the last few of a set). Asked again for exactly its values, without
///     an Approach, by displace, reactions, answer, residual, discretisation_check or interior_field, it is taken and
///     nothing is solved.
///   - No equilibrium: NoEquilibriumError, a SolveError that says where the body is crushed.
class Deformer {
public:
    explicit Deformer(std::shared_ptr<const Model> model);
    ~Deformer();
    Deformer(Deformer&&) noexcept;
    Deformer& operator=(Deformer&&) noexcept;

    /// Changes which vertices are constrained: computes the columns that are not known yet, refactors the capacitance
    /// system. Waits for another thread that computes columns of the same model. Strong guarantee: on an exception the
    /// previous set stays. Throws SolveError (also, before anything is computed, where predict_memory is more than is
    /// free), Cancelled.
    void constrain(ConstrainedSet set, Control& control);
    const ConstrainedSet& set() const { return set_; }

    /// Bytes that constrain(set) would take beyond what is held now, at its peak; tens of microseconds. An upper
    /// estimate: columns that are known already are counted as new.
    std::uint64_t predict_memory(const ConstrainedSet& set) const;
    /// Bytes that discretisation_check of such a set takes while it is made, beyond what is held for it. Milliseconds.
    std::uint64_t predict_check_memory(const ConstrainedSet& set) const;

    /// Displacements of all vertices, 3*n_vertices [L], for those prescribed at the handles: values is
    /// set().n_values(), node-major, in the order of set().handles, then the factor of each of set().loads. A solid
    /// with no constrained vertex and no load rests; one that is loaded and free to move must have loads that balance,
    /// and takes the answer without rigid motion. Throws SolveError when they do not balance, or the result is not
    /// finite.
    Eigen::VectorXd displace(const Eigen::VectorXd& values) const;
    /// The same where solving may take long (large surfaces by iteration, to this relative residual): tells its
    /// progress. Throws Cancelled.
    Eigen::VectorXd displace(const Eigen::VectorXd& values, Control& control, double tolerance = kSolveTolerance,
                             const Approach& approach = {}) const;

    /// The same for many columns of values at once: 3*n_vertices x values.cols().
    Eigen::MatrixXd displace_all(const Eigen::MatrixXd& values) const;
    Eigen::MatrixXd displace_all(const Eigen::MatrixXd& values, Control& control,
                                 double tolerance = kSolveTolerance) const;
    /// Whether solutions depend on that tolerance: else they are as exact as rounding lets them be. What is solved for
    /// to a small one starts from what is known to a larger one.
    bool iterates() const;

    /// Response to motions of some handles or to loads: `values` are the present ones (as in displace), each column of
    /// `basis` (same rows) a motion or a change of the loads' factors; for a rigid translation three columns that
    /// repeat the unit vectors at the handle's vertices. rest = displace(values).
    DragResponse drag_response(const Eigen::VectorXd& values, const Eigen::MatrixXd& basis) const;
    DragResponse drag_response(const Eigen::VectorXd& values, const Eigen::MatrixXd& basis, Control& control,
                               double tolerance = kSolveTolerance, const Approach& approach = {}) const;
    /// Whether displacements are linear in `values`.
    bool linear() const { return model_->method().kind->linear; }

    /// Reactions at the fixed vertices, then at the handle vertices, for these values.
    Reactions reactions(const Eigen::VectorXd& values) const;

    /// Displacements and reactions of one solution; what displace and reactions do, at the price of one of them.
    struct Answer {
        Eigen::VectorXd displacements = {};
        Reactions reactions = {};
        std::optional<double> residual = {};                       ///< when asked for
        std::optional<DiscretisationCheck> check = {};             ///< when asked for, and where there is one
        std::shared_ptr<const Equilibrium> equilibrium = nullptr;  ///< of methods that are not linear
        std::optional<EquilibriumFacts> facts = {};                ///< likewise, of all solids together
        /// Likewise: what each of set().loads exerts with its factor, moments of forces at present positions.
        std::vector<Resultant> loads = {};
        /// When asked for: how the reactions' forces change along each column of Wanted::along, 3 x n [force].
        std::vector<Eigen::Matrix3Xd> force_changes = {};
    };
    /// What an answer is to tell besides displacements and reactions.
    struct Wanted {
        bool residual = false;
        bool check = false;
        /// Changes of the values (as many rows), for Answer::force_changes: derivatives at the equilibrium that is the
        /// answer. For methods that are not linear; of others, forces for other values tell the same.
        Eigen::MatrixXd along = {};
    };
    Answer answer(const Eigen::VectorXd& values, Wanted wanted, Control& control, const Approach& approach = {}) const;

    /// Throws SolveError where the loads do not balance on a solid that nothing holds against them. values: as
    /// displace() takes them, n_values x m, each column by itself.
    void require_balance(const Eigen::MatrixXd& values) const;

    /// How far displacements and reactions for these values may be off because the mesh is coarse: the difference to a
    /// second, better answer. Boundary elements: symmetric Galerkin with a row of thin triangles along the rims of the
    /// constrained patches, or with halved ones. FEM: quadratic elements on the same tetrahedra (quadratic FEM: on
    /// halved ones). Measured against converged answers in tests/methods/discretisation_test.cpp. Takes up to
    /// three times a single solve: not for every frame. Nothing where the memory left does not suffice.
    std::optional<DiscretisationCheck> discretisation_check(const Eigen::VectorXd& values, Control& control) const;

    /// Relative residual of the full system for these values, evaluated independently of the factorisation (BEM: the
    /// integrals are computed afresh): |H u - G t| / | |H||u| + |G||t| | or |K u - f| / | |K||u| + |f| |, absolute
    /// values entry by entry, in the Euclidean norm: rounding (1e-16 to 1e-12) unless the solution is wrong. It does
    /// not tell the error of the discretisation. BEM: over a sample of the equations, at least 128 nodes and 128
    /// interior points, evenly spread.
    double residual(const Eigen::VectorXd& values, Control& control) const;

    /// Displacements and stresses inside the body, one solution for each column of values. The result does not refer to
    /// this object. Takes a solve of all columns; FEM keeps the displacements of all nodes. Throws SolveError,
    /// Cancelled.
    std::shared_ptr<const InteriorField> interior_field(const Eigen::MatrixXd& values, Control& control) const;

    const SolutionQuality& quality() const { return quality_; }
    const Model& model() const { return *model_; }

private:
    struct SolidState;
    class Memory;
    /// Solutions of a solid for these values (and, of the first column, changes), in its own units.
    NodeSolution solve(std::size_t part, const Eigen::MatrixXd& values, const Eigen::MatrixXd& changes, bool want_loads,
                       const Approach& approach, double tolerance, Control& control) const;
    struct Displaced {
        Eigen::MatrixXd u;
        std::shared_ptr<const Equilibrium> equilibrium;
    };
    Displaced displace_by(const Eigen::MatrixXd& values, const Eigen::MatrixXd& changes, double tolerance,
                          const Approach& approach, Control& control) const;
    /// The approach that answers for these values: one that begins with the remembered equilibrium, where there is one.
    Approach remembered(const Eigen::VectorXd& values, const Approach& approach) const;
    /// Of methods that are not linear.
    void remember(std::shared_ptr<const Equilibrium> found, Answer& answer) const;
    /// Displacements in the solid over those in the body: solids of methods that are not linear need true ones.
    double unit_of(std::size_t part) const;
    /// A part's share of a set, not yet constrained.
    SolidState split(const ConstrainedSet& set, const Model::Part& part) const;
    void add_loads(const ConstrainedSet& set, const Model::Part& part, const std::vector<int>& local,
                   SolidState& state) const;
    void require_memory(const ConstrainedSet& set) const;
    /// Rows of all vertices <- those of a part.
    void place(std::size_t part, Eigen::MatrixXd&& own, Eigen::MatrixXd& all) const;
    void require_finite(const Eigen::MatrixXd& u) const;
    /// Adds the reactions of a part, for unit Young's modulus and about its own origin, to those of the whole body.
    void add_reactions(std::size_t part, Reactions own, Reactions& sum) const;
    /// A force of the body over that of the part.
    double force_unit_of(std::size_t part) const;
    /// Columns of all constrained vertices <- those of a part.
    void place_columns(std::size_t part, const Eigen::Matrix3Xd& own, Eigen::Matrix3Xd& all) const;
    /// The same of loads, 6 x those of the part.
    void add_loads_of(std::size_t part, const Eigen::MatrixXd& own, std::vector<Resultant>& sum) const;
    /// to_better: what makes the answer the better one, solid by solid (SolutionError::to_better).
    std::optional<DiscretisationCheck> check_of(const Answer& answer, const SolutionError& error,
                                                const SolutionError& to_better, const Eigen::VectorXd& values) const;

    std::shared_ptr<const Model> model_;
    ConstrainedSet set_;
    std::vector<SolidState> solids_;  ///< one for each part of the model
    SolutionQuality quality_;
    std::unique_ptr<Memory> memory_;  ///< equilibria found
};

}  // namespace elastolab
