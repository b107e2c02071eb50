#pragma once

#include <Eigen/Core>
#include <vector>

#include "deform/element_degree.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Which process has which node. Nodes are numbered anew, process by process; all three unknowns of one are together.
struct Partition {
    std::vector<int> order;   ///< node of the mesh, for each new number
    std::vector<int> number;  ///< new number, for each node of the mesh
    std::vector<int> begin;   ///< first new number of each process, then that of all

    int n_processes() const { return static_cast<int>(begin.size()) - 1; }
};

/// Halves the body across its longest side until there is a part for each process: as many nodes for each, and few that
/// neighbour another's. Within a part nodes keep their order.
Partition partition_nodes(const Positions& positions, int n_processes);

/// What one process assembles its rows from: its own nodes, and all elements that they belong to.
struct Share {
    double poisson_ratio = 0.0;
    int n_all = 0;                ///< nodes of all processes
    int first = 0, n_own = 0;     ///< its own have the numbers [first, first + n_own)
    std::vector<int> nodes;       ///< numbers of all its nodes, ascending
    Positions positions;          ///< of these [L]
    Eigen::MatrixXi elements;     ///< 4 or 10 x n: places in `nodes`; corners, then midpoints by kTetEdges
    std::vector<int> own_counts;  ///< nodes of every process; of a body on the first process alone
};

/// The share of a process of a mesh that is all here. elements: 4 or 10 nodes a column.
Share share_of(int process, const Partition& partition, const Positions& positions,
               const Eigen::Ref<const Eigen::MatrixXi>& elements, double poisson_ratio);

/// The share of a process of the unit cube in cells^3 cubes of six tetrahedra, in layers of equal thickness, made
/// without any other process: for measuring. Numbers ascend along x, then y, then z. With elements of ten nodes the
/// nodes are those of a grid twice as fine. cells^3 elements' nodes must be less than 2^31 / 3.
Share share_of_grid(int process, int n_processes, int cells, ElementDegree degree, double poisson_ratio);

}  // namespace elastolab
