#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "deform/columns.hpp"
#include "deform/element_degree.hpp"
#include "deform/node_solver.hpp"
#include "deform/reduced_solver.hpp"
#include "deform/unit_load.hpp"
#include "fem/assembly.hpp"
#include "fem/compliance.hpp"
#include "fem/constrained_nodes.hpp"
#include "fem/free_border.hpp"
#include "fem/prices.hpp"
#include "fem/sparse_cholesky.hpp"

namespace elastolab {

/// What does not depend on the material: the elements, their integrals and the ordering of the factorisation.
struct FemMesh {
    /// Its vertices are the nodes, those of the surface first. Quadratic elements are split in eight on their nodes.
    TetMesh tets;
    int n_surface_nodes = 0;     ///< nodes on the surface, which come first
    SurfaceMidpoints midpoints;  ///< of quadratic elements, else none
    /// The triangles of the surface that it was made from, in their order, and the midpoints of their edges or none.
    Triangles surface, surface_midpoints;
    int n_elements = 0;
    StiffnessParts parts;
    std::unique_ptr<const CholeskyAnalysis> analysis;
    FemPrices prices;

    ElementDegree degree() const {
        return midpoints.midpoints.cols() > 0 ? ElementDegree::quadratic : ElementDegree::linear;
    }
    /// Nodes of the elements, 4 or 10 a column: corners, then midpoints by kTetEdges.
    Eigen::MatrixXi elements() const;
};

/// Takes the tetrahedra as elements of a degree; `parts`, `analysis` and `prices` are left to be made. surface: its
/// triangles.
FemMesh elements_on(TetMesh tets, const Triangles& surface, ElementDegree degree);
/// The same, and integrates them. Throws as assemble_stiffness_parts does.
FemMesh make_fem_mesh(TetMesh tets, const Triangles& surface, ElementDegree degree, Control& control);

/// K of all nodes for unit Young's modulus.
struct FemSystem {
    std::shared_ptr<const FemMesh> mesh;
    SparseMatrix K;

    const Positions& positions() const { return mesh->tets.vertices; }
    /// Nodes on the surface: they can be prescribed and loaded.
    int n_surface() const { return mesh->n_surface_nodes; }
    /// Vertices of the surface: they are shown.
    int n_vertices() const { return mesh->tets.n_surface_vertices; }
};

/// Whether the columns of so many vertices are kept (kColumnsWorthKeeping).
bool keeps_columns(const FemSystem& system, std::ptrdiff_t n_vertices);

/// The body factorised with a fixed set eliminated (or free), and the columns of its surface compliance computed so
/// far.
class FactorisedBody : public std::enable_shared_from_this<FactorisedBody> {
public:
    FactorisedBody(std::shared_ptr<const FemSystem> system, std::vector<int> fixed, Control& control);

    const FemSystem& system() const { return *system_; }
    const std::vector<int>& fixed() const { return fixed_; }
    const SurfaceCompliance& compliance() const { return compliance_; }
    /// Of the factorised matrix, estimated.
    double reciprocal_condition() const { return reciprocal_condition_; }
    /// D over R^T for these vertices (with a fixed set: D alone); cached.
    Columns compliance_columns(const std::vector<int>& vertices, Control& control) const;
    /// The same for a set of vertices: columns that are kept where they are cheap, else their block and nothing more.
    std::shared_ptr<const ComplianceColumns> columns_of_set(const std::vector<int>& vertices,
                                                            std::span<const UnitLoad> loads, Control& control) const;
    /// Compliance columns for unit loads, as those of vertices: displacements of the surface, and what the load lacks
    /// of balance; cached.
    Columns columns_of_loads(std::span<const UnitLoad> loads, Control& control) const;
    /// Displacements of all nodes for displacements of the surface and the loads on it, or on all nodes, that cause
    /// them.
    Eigen::MatrixXd volume_displacements(const Eigen::MatrixXd& surface, const Eigen::MatrixXd& loads) const;

private:
    void add_blocks(std::span<const int> vertices, std::vector<Columns::Block>& blocks, Control& control) const;
    Eigen::MatrixXd compute_columns(std::span<const UnitLoad> loads) const;
    /// Made when it is needed: its motions of all nodes are as large as six columns.
    FreeBorder border() const { return {system_->positions(), compliance_.rigid()}; }

    std::shared_ptr<const FemSystem> system_;
    std::vector<int> fixed_;
    SurfaceCompliance compliance_;
    double reciprocal_condition_;
    mutable ColumnCache cache_;
};

/// Compliance columns of a factorised body to loads at some vertices, none of them kept: only their rows and columns at
/// these vertices are formed, and a product with them is a solve.
class FactorComplianceColumns : public ComplianceColumns {
public:
    /// given: of the given loads, which are kept
    FactorComplianceColumns(std::shared_ptr<const FactorisedBody> body, std::vector<int> vertices, Columns given);

    Eigen::Index cols() const override { return 3 * std::ssize(vertices_); }
    Eigen::Index n_given() const override { return given_.cols(); }
    Eigen::MatrixXd capacitance_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                       Control& control) const override;
    void add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements,
                     Control& control) const override;

private:
    std::shared_ptr<const FactorisedBody> body_;
    std::vector<int> vertices_;
    Columns given_;
};

/// Eqn. (9') on a grounded body: the capacitance system of the vertices that are not eliminated. Its loads are nodal
/// forces at the fixed set, then at these vertices.
class FactorisedBodySolver : public NodeSolver {
public:
    FactorisedBodySolver(std::shared_ptr<const FactorisedBody> body, std::vector<int> vertices,
                         std::span<const UnitLoad> loads, Control& control);
    /// prescribed: the fixed set (zero) first, then the vertices
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;
    NodeSolution solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                               Control& control) const override;

    /// Nodal forces of the unit loads, at all nodes.
    const Eigen::MatrixXd& given() const { return given_; }

private:
    /// Displacements of all nodes of a solution.
    Eigen::MatrixXd volume_displacements(const Eigen::MatrixXd& surface, const Eigen::MatrixXd& factors,
                                         const Eigen::MatrixXd& loads) const;

    std::shared_ptr<const FactorisedBody> body_;
    std::vector<int> vertices_;
    Eigen::MatrixXd given_;
    ReducedSolver reduced_;
};

/// Eqn. 7 on the sparse matrix: K00 factorised for this constrained set.
class SparseDirectSolver : public NodeSolver {
public:
    /// vertices hold the body, else SolveError; given: nodal forces of unit loads, 3*n_nodes x n_loads.
    SparseDirectSolver(std::shared_ptr<const FemSystem> system, std::vector<int> vertices, Eigen::MatrixXd given,
                       Control& control);
    /// Displacements of all nodes.
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;

    /// Of the stiffness with the vertices eliminated.
    const std::shared_ptr<const SparseCholesky>& factor() const { return factor_; }

private:
    std::shared_ptr<const FemSystem> system_;
    std::vector<int> vertices_;
    Eigen::MatrixXd given_;
    std::shared_ptr<const SparseCholesky> factor_;
};

/// |K u - f| / | |K| |u| + |f| |, Euclidean, for displacements of all nodes and forces at `vertices` beside those given
/// at all nodes.
double stiffness_residual(const SparseMatrix& K, const Eigen::VectorXd& u, const std::vector<int>& vertices,
                          const Eigen::VectorXd& forces, const Eigen::VectorXd& given);

/// Forces of the supports at these vertices: K u less what is given there (at all nodes, 3*n_nodes x m).
Eigen::MatrixXd support_forces(const SparseMatrix& K, const Eigen::MatrixXd& u, const std::vector<int>& vertices,
                               const Eigen::MatrixXd& given);

/// Nodal forces K u at these vertices.
Eigen::MatrixXd nodal_forces(const SparseMatrix& K, const Eigen::MatrixXd& u, const std::vector<int>& vertices);

}  // namespace elastolab
