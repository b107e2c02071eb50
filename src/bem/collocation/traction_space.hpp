#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "bem/boundary.hpp"
#include "deform/columns.hpp"
#include "deform/load_share.hpp"
#include "deform/method.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

/// The ansatz for the unknown tractions of one constrained set (docs/formulation.md section 4), and the equations that
/// close it. Unknowns: a traction vector per slot of `elements`, then a free residual for every vertex in
/// `dropped_collocation`. Equations: prescribed displacements at the nodes, and collocation at three interior points of
/// every triangle in `interior_triangles`.
struct TractionSpace {
    Elements elements;
    std::vector<LoadShare> shares;
    std::vector<int> interior_triangles;
    std::vector<int> dropped_collocation;
    /// Response columns of the unknowns in order: blocks of the cache and what each is made of.
    struct Block {
        ColumnKey key;
        std::vector<Elements::Element> elements;  ///< slots count from 0 within the block
        int n_slots = 0;                          ///< 0: the residual of vertex key.back()
        int whole_node = -1;                      ///< node whose whole shape function it is: a column of K^-1
    };
    std::vector<Block> blocks;

    int n_slots() const { return elements.n_slots; }
    /// Scalar unknowns: three for every slot and every free residual.
    Eigen::Index n_degrees_of_freedom() const { return 3 * (elements.n_slots + std::ssize(dropped_collocation)); }
};

/// Constant elements: a traction per constrained triangle. `prescribe` rows say which vertices carry it.
TractionSpace constant_traction_space(const Boundary& boundary, const std::vector<int>& triangles,
                                      const Eigen::SparseMatrix<double, Eigen::RowMajor>& prescribe);

/// Linear elements under one of the three traction models.
///   continuous     a hat function per vertex
///   restricted     hat functions cut to the triangles whose vertices are all constrained
///   discontinuous  as restricted inside a patch; on the triangles that touch its rim, where the tractions are
///                  singular, linear functions of each triangle by itself
/// A vertex with no triangle of its own keeps its whole hat in all three.
TractionSpace linear_traction_space(const Boundary& boundary, const VertexTriangles& triangles_of_vertex,
                                    Tractions tractions, std::span<const int> vertices);

}  // namespace elastolab
