#pragma once

#include <array>
#include <Eigen/Core>
#include <span>
#include <vector>

#include "elasticity/triangle_kernels.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The triangles of one solid's surface, ready for integration.
class Boundary {
public:
    /// The mesh is closed, outward and free of degenerate triangles (mesh/checks/check.hpp).
    explicit Boundary(const SurfaceMesh& mesh);

    const SurfaceMesh& mesh() const { return mesh_; }
    const TriangleGeometry& triangle(int t) const { return triangles_[static_cast<std::size_t>(t)]; }
    int n_triangles() const { return mesh_.n_triangles(); }
    double area(int t) const { return 0.5 * triangle(t).double_area; }

private:
    SurfaceMesh mesh_;
    std::vector<TriangleGeometry> triangles_;
};

/// Collocation points: where the boundary integral equation is asked to hold.
struct CollocationPoints {
    Positions positions;            ///< 3 x n [L]
    std::vector<int> own_triangle;  ///< triangle in whose interior the point lies, -1 for a vertex of the mesh
    /// Shape-function values at the point, by slot of the double layer's Elements; the free term of the integral
    /// equation, found by the rigid-body sum, is spread over them. Slot -1: unused.
    struct Weight {
        int slot;
        double value;
    };
    std::vector<std::array<Weight, 3>> weights;

    int size() const { return static_cast<int>(positions.cols()); }
    /// The collocation points with these numbers.
    CollocationPoints subset(std::span<const int> numbers) const;
    void append(const CollocationPoints& more);
};

/// Every vertex of the mesh (linear elements).
CollocationPoints vertex_collocation_points(const Boundary& boundary);
/// Every triangle's centroid (constant elements).
CollocationPoints centroid_collocation_points(const Boundary& boundary);
/// Three interior points of each of these triangles, barycentric (2/3, 1/6, 1/6) and permuted: 3*triangles.size().
CollocationPoints inner_collocation_points(const Boundary& boundary, std::span<const int> triangles);

/// Which shape functions are integrated over which triangle, and into which slot (block column) each goes.
struct Elements {
    enum class Order { constant, linear };
    struct Element {
        int triangle;
        std::array<int, 3> slots;  ///< one per corner (constant: the first only); -1: not wanted
    };
    Order order = Order::linear;
    int n_slots = 0;
    std::vector<Element> elements;
};

/// Adds elements with n_slots slots of their own, which come after those that are there.
void append(Elements& elements, std::span<const Elements::Element> more, int n_slots);

/// The same shape functions with one element a triangle where their slots do not collide: what is integrated over a
/// triangle serves all its corners.
Elements merged(const Elements& elements);

/// All triangles; slot = vertex number, hat functions.
Elements vertex_elements(const Boundary& boundary);
/// Slot = position of the triangle in the list, constant functions.
Elements constant_elements(std::span<const int> triangles);

}  // namespace elastolab
