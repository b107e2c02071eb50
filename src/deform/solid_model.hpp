#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "deform/constraint_map.hpp"
#include "deform/deformer.hpp"
#include "deform/interior.hpp"
#include "deform/interior_field.hpp"
#include "deform/load_share.hpp"
#include "deform/model.hpp"
#include "deform/node_solver.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

/// A second answer to the same problem, by a method that tells how far the first is off.
struct ReferenceAnswer {
    Eigen::VectorXd displacements;  ///< of all vertices, 3*n_vertices [L]
    Reactions reactions;            ///< at the constrained vertices, for unit Young's modulus
    /// What the first answer lacks (true less first) over the difference of both (second less first). Above 1: the
    /// second lacks some too; negative: the first is the better one.
    double share = 1.0;
};

/// What can be asked about a solution with loads besides its displacements.
struct SolutionChecks {
    /// Relative residual of the full system.
    std::function<double(const NodeSolution&, Control&)> residual;
    /// The second answer for these values (as ConstrainedSolid::solve takes them); nothing where it would not fit
    /// into memory. Null where there is none. The solution is the first answer.
    std::function<std::optional<ReferenceAnswer>(const Eigen::VectorXd& values, const NodeSolution& solution, Control&)>
        reference;
    /// Displacements and stresses inside, for these solutions.
    std::function<std::shared_ptr<const InteriorField>(NodeSolution&&, Control&)> interior_field = {};
};

/// What a solution lacks (true less computed), estimated.
struct SolutionError {
    Eigen::VectorXd displacements;  ///< 3*n_vertices [L]
    Reactions reactions;            ///< at the constrained vertices, for unit Young's modulus
    double to_better = 1.0;         ///< solution + to_better * error is the better of both answers
};

/// Forces and moments at n constrained vertices from the loads that they share, one column.
Reactions gathered_reactions(const std::vector<LoadShare>& shares, int n, const Eigen::VectorXd& loads);
/// The same with moments of forces at present positions; moved: displacements of the vertices, 3*n.
Reactions present_reactions(const std::vector<LoadShare>& shares, const Eigen::VectorXd& moved,
                            const Eigen::VectorXd& loads);

/// A field that unit loads cause by themselves and that solvers leave out: they solve for the rest, with prescribed
/// displacements less this (BEM's body forces, docs/formulation.md section 13).
struct ParticularField {
    Eigen::MatrixXd at_nodes;     ///< 3*n_constrained_nodes x n_loads
    Eigen::MatrixXd at_vertices;  ///< 3*n_vertices x n_loads, or more rows; empty: there is no such field

    bool empty() const { return at_vertices.size() == 0; }
};

/// Displacements of one solid's vertices for one constrained set, whatever the method. Loads are those of unit Young's
/// modulus; the Deformer scales them.
class ConstrainedSolid {
public:
    /// nodes       how the constrained vertices act on the nodes
    /// shares      which constrained vertex carries which load
    /// display     3*n_vertices x 3*n_nodes; empty: the first vertices are the nodes themselves
    ConstrainedSolid(int n_vertices, ConstrainedNodes nodes, std::vector<LoadShare> shares,
                     std::shared_ptr<const SparseRows> display, std::unique_ptr<NodeSolver> solver,
                     SolutionChecks checks, int n_loads = 0, ParticularField particular = {});

    /// As NodeTask, of the constrained vertices: fixed set (zero) first, then handles.
    NodeSolution solve(const NodeTask& task, double tolerance, Control& control) const;
    /// values: 3*n_constrained + n_loads x m, fixed set (zero) first, then handles, then the factors of the unit loads.
    NodeSolution solve(const Eigen::MatrixXd& values, bool want_loads, double tolerance, Control& control) const;
    NodeSolution solve(const Eigen::MatrixXd& values, bool want_loads) const;
    bool iterates() const { return solver_->iterates(); }
    bool linear() const { return solver_->linear(); }
    /// Displacements of the vertices out of a solution, 3*n_vertices x m.
    Eigen::MatrixXd displacements(NodeSolution&& solution) const;
    /// Forces and moments at the constrained vertices, for the first column of a solution with loads. Moments are of
    /// forces at rest positions, or at present ones where the method is not linear.
    Reactions reactions(const NodeSolution& solution) const;
    /// Forces at the constrained vertices that a column of a solution with loads stands for, 3 x n_constrained.
    Eigen::Matrix3Xd forces(const NodeSolution& solution, Eigen::Index column) const;
    double residual(const NodeSolution& solution, Control& control) const;
    /// Estimated error of a solution for these values; nothing where the method has no estimate.
    std::optional<SolutionError> error(const Eigen::VectorXd& values, const NodeSolution& solution,
                                       Control& control) const;

    /// The inside for solutions with loads. Throws SolveError, Cancelled.
    std::shared_ptr<const InteriorField> interior_field(NodeSolution&& solution, Control& control) const;

    double condition() const { return solver_->condition(); }
    bool held() const { return solver_->held(); }

private:
    Eigen::MatrixXd of_nodes(const Eigen::MatrixXd& values) const;
    /// What the particular field, if there is one, adds at the vertices.
    void add_particular(const Eigen::MatrixXd& factors, Eigen::Ref<Eigen::MatrixXd> displacements) const;

    int n_vertices_, n_constrained_, n_loads_;
    ConstrainedNodes nodes_;
    std::vector<LoadShare> shares_;
    std::shared_ptr<const SparseRows> display_;
    std::unique_ptr<NodeSolver> solver_;
    SolutionChecks checks_;
    ParticularField particular_;
};

/// One solid under one method, for unit Young's modulus (displacements of a displacement problem do not depend on it).
/// Immutable to its users; any thread may call it.
class SolidModel {
public:
    virtual ~SolidModel() = default;

    /// fixed and handles: vertices of the solid, all different; loads: each acts on the solid (its triangles are those
    /// of the solid), for unit Young's modulus. At least one of the three is not empty; where the constraints leave a
    /// rigid motion free, the loads of a solution balance, and it has no such motion. Throws SolveError, Cancelled.
    virtual std::unique_ptr<ConstrainedSolid> constrain(std::span<const int> fixed, std::span<const int> handles,
                                                        std::span<const UnitLoad> loads, Control& control) const = 0;
    /// Bytes that constrain() takes beyond what is held, at its peak. An upper estimate from the arrays it makes:
    /// columns that are known already are counted as new.
    virtual std::uint64_t constrain_memory(std::span<const int> fixed, std::span<const int> handles) const = 0;
    /// False while further sets have nothing to take over, since the first one was solved by itself: the next
    /// constrain() makes it, of whatever set.
    virtual bool serves_sets() const { return true; }
    /// Bytes that SolutionChecks::reference of such a set takes while it is made, beyond what is held for the set.
    virtual std::uint64_t check_memory(std::span<const int> fixed, std::span<const int> handles) const = 0;
    /// The matrices that the mode keeps, for unit Young's modulus.
    virtual void visit_matrices(const std::function<void(const NamedMatrix&)>& visit) const = 0;
    /// The sparse stiffness of all nodes, or null.
    virtual const SparseStiffness* sparse_stiffness() const { return nullptr; }
    /// Nothing where the method has none.
    virtual std::optional<Interior> interior() const { return std::nullopt; }

    const ModelFacts& facts() const { return facts_; }

protected:
    ModelFacts facts_;
};

}  // namespace elastolab
