#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "base/lapack.hpp"
#include "base/timer.hpp"
#include "bem/boundary.hpp"
#include "bem/collocation/assembly.hpp"
#include "bem/collocation/element.hpp"
#include "bem/collocation/hierarchical.hpp"
#include "bem/collocation/traction_space.hpp"
#include "deform/columns.hpp"
#include "deform/dense_solvers.hpp"
#include "deform/finding.hpp"
#include "deform/method.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

/// The boundary equation H u = G t of one solid with unit Young's modulus, bordered by the rigid modes B = C of its
/// nodes and factorised:
///   Hhat = | H   B |      Hhat^-1 = | D'  E |
///          | B^T 0 |                | F'  J |
/// Nodes are vertices (linear elements) or triangles (constant elements). Any thread may use it.
class BemSystem {
public:
    /// How H is kept. Hierarchical: linear elements, on demand; each constrained set is solved by iteration.
    enum class Storage { dense, hierarchical };

    /// With dense storage, on demand and the update `direct`, nothing is integrated here: each constrained set has a
    /// system of its own.
    BemSystem(const BoundaryElement& element, std::shared_ptr<const Boundary> boundary, double poisson_ratio,
              const Method& method, Storage storage, StageTimes& stages, Control& control);

    const Boundary& boundary() const { return *boundary_; }
    std::shared_ptr<const Boundary> shared_boundary() const { return boundary_; }
    const VertexTriangles& triangles_of_vertex() const { return triangles_of_vertex_; }
    const BoundaryElement& element() const { return element_; }
    int n_nodes() const { return nodes_.size(); }

    /// E over J: (3*n_nodes + 6) x 6.
    const Eigen::MatrixXd& rigid() const { return rigid_; }
    /// Condition number of Hhat, estimated; 0 when it is not factorised.
    double condition() const { return lu_.size() > 0 ? 1.0 / lu_.reciprocal_condition() : 0.0; }
    std::uint64_t memory_bytes() const;

    /// Collocation at every node.
    const CollocationPoints& nodes() const { return nodes_; }
    /// Rows of H (3*points.size() x 3*n_nodes) and of G for a load ansatz (3*points.size() x 3*slots) at
    /// these collocation points, with the tolerance of the method or a larger one.
    Eigen::MatrixXd double_layer(const CollocationPoints& points, Control& control, double tolerance = 0.0) const;
    Eigen::MatrixXd single_layer(const CollocationPoints& points, const Elements& loads, Control& control,
                                 double tolerance = 0.0) const;
    /// The single layer of the tractions of given loads, seen from these points: 3*points.size() x
    /// loads.size().
    Eigen::MatrixXd given_single_layer(const CollocationPoints& points, std::span<const UnitLoad> loads,
                                       Control& control) const;
    /// Rows of H at these nodes: copied in the mode `full`, where H is in memory, else integrated.
    Eigen::MatrixXd double_layer_at(std::span<const int> nodes, Control& control) const;

    /// Bytes of columns that are kept at most.
    std::uint64_t cache_budget() const { return cache_budget_; }
    /// Whether the compliance columns of a space fit into what is kept.
    bool keeps(const TractionSpace& space) const;
    /// ComplianceColumns Hhat^-1 [G; 0] to the unit loads of a space, then to its residuals; cached.
    Columns compliance_columns(const TractionSpace& space, Control& control) const;
    /// Hhat^-1 [G g; 0] for given loads, a column each; cached.
    Columns columns_of_loads(std::span<const UnitLoad> loads, Control& control) const;
    /// G^-1 (the single layer of given loads): what they add to the tractions K u of the nodes, 3*n_nodes x
    /// loads.size(); in the mode `full`, with another factorisation of G.
    Eigen::MatrixXd given_tractions(std::span<const UnitLoad> loads, Control& control) const;
    /// The same, computed afresh, a group of columns at a time; none is kept.
    void visit_columns(const TractionSpace& space, const std::function<void(const Columns&)>& visit,
                       Control& control) const;
    /// X <- Hhat^-1 X.
    void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const { lu_.solve_in_place(X); }

    /// H, or null where it is dense.
    const std::shared_ptr<const HierarchicalCollocation>& hierarchical() const { return hierarchical_; }
    /// H, G, K and Khat^-1: only in the mode `full`, else null.
    const Eigen::MatrixXd* double_layer_matrix() const { return full_ ? &full_->H : nullptr; }
    const Eigen::MatrixXd* single_layer_matrix() const { return full_ ? &full_->G : nullptr; }
    std::shared_ptr<const DenseOperators> operators() const { return full_ ? full_->operators : nullptr; }
    /// Hhat^-1 in full; computed on the first call.
    const Eigen::MatrixXd& bordered_inverse() const;
    const Findings& findings() const { return findings_; }

private:
    struct Full {
        Eigen::MatrixXd H, G;
        std::shared_ptr<const DenseOperators> operators;
    };
    void factorise(Eigen::MatrixXd&& bordered, Control& control);
    void complete(Eigen::MatrixXd H, StageTimes& stages, Control& control);
    /// The columns of a whole shape function, copied from K^-1; null when K^-1 is not in memory or does not have them.
    Columns::Block from_inverse(const TractionSpace::Block& block) const;
    std::vector<Columns::Block> compute(const std::vector<const TractionSpace::Block*>& missing, Elements::Order order,
                                        Control& control) const;

    const BoundaryElement& element_;
    std::shared_ptr<const Boundary> boundary_;
    Material material_;
    double tolerance_;
    VertexTriangles triangles_of_vertex_;
    CollocationPoints nodes_;
    Elements elements_;
    Eigen::MatrixXd modes_;
    LuFactorization lu_;
    Eigen::MatrixXd rigid_;
    std::unique_ptr<Full> full_;
    std::shared_ptr<const HierarchicalCollocation> hierarchical_;
    Findings findings_;
    std::uint64_t cache_budget_ = 0;
    std::unique_ptr<ColumnCache> cache_;
    mutable std::mutex inverse_mutex_;
    mutable Eigen::MatrixXd inverse_;
};

}  // namespace elastolab
