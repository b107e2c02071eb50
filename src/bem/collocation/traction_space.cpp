#include "bem/collocation/traction_space.hpp"

#include <array>

namespace elastolab {

namespace {

/// First numbers of cache keys.
enum KeyKind { kHat, kTriangle, kResidual, kConstant };

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// int phi_corner y dS over a triangle of area A: A/12 (v0 + v1 + v2 + v_corner).
Eigen::Vector3d first_moment(const Boundary& boundary, int t, int corner) {
    const Eigen::Vector3i v = boundary.mesh().triangles.col(t);
    const Positions& V = boundary.mesh().vertices;
    return boundary.area(t) / 12.0 * (V.col(v[0]) + V.col(v[1]) + V.col(v[2]) + V.col(v[corner]));
}

/// Adds blocks to a space, numbering slots as it goes.
class TractionSpaceBuilder {
public:
    TractionSpaceBuilder(const Boundary& boundary, Elements::Order order) : boundary_(boundary) {
        space_.elements.order = order;
    }

    void add_block(TractionSpace::Block block) {
        append(space_.elements, block.elements, block.n_slots);
        space_.blocks.push_back(std::move(block));
    }

    void share(int slot, int constrained, double weight, const Eigen::Vector3d& moment) {
        space_.shares.push_back({slot, constrained, weight, moment});
    }
    /// The share of a linear shape function of one triangle.
    void share_corner(int slot, int constrained, int t, int corner) {
        share(slot, constrained, boundary_.area(t) / 3.0, first_moment(boundary_, t, corner));
    }
    int next_slot() const { return space_.elements.n_slots; }
    TractionSpace& space() { return space_; }
    TractionSpace finished() {
        space_.elements = merged(space_.elements);
        return std::move(space_);
    }

private:
    const Boundary& boundary_;
    TractionSpace space_;
};

/// Which triangles a constrained set owns, and how each of them is treated.
struct Patch {
    std::vector<int> number;      ///< position of a vertex among the constrained ones, or -1
    std::vector<char> whole;      ///< by triangle: all its vertices are constrained
    std::vector<char> by_itself;  ///< by triangle: whole, with linear tractions of its own
    const VertexTriangles& triangles_of_vertex;

    Patch(const SurfaceMesh& mesh, const VertexTriangles& triangles, std::span<const int> vertices)
        : number(index(mesh.n_vertices()), -1),
          whole(index(mesh.n_triangles()), 0),
          by_itself(whole),
          triangles_of_vertex(triangles) {
        for (std::size_t i = 0; i < vertices.size(); ++i) number[index(vertices[i])] = static_cast<int>(i);
        for (int t = 0; t < mesh.n_triangles(); ++t) {
            const Eigen::Vector3i v = mesh.triangles.col(t);
            whole[index(t)] = number[index(v[0])] >= 0 && number[index(v[1])] >= 0 && number[index(v[2])] >= 0;
        }
    }

    /// Marks the whole triangles that touch the rim of the patch.
    void separate_rim(const SurfaceMesh& mesh, std::span<const int> vertices) {
        std::vector<char> on_rim(index(mesh.n_vertices()), 0);
        for (const int v : vertices)
            for (const int t : triangles_of_vertex[v]) on_rim[index(v)] |= !whole[index(t)];
        for (int t = 0; t < mesh.n_triangles(); ++t)
            for (const int v : mesh.triangles.col(t)) by_itself[index(t)] |= whole[index(t)] && on_rim[index(v)];
    }

    bool has_whole(int v) const {
        for (const int t : triangles_of_vertex[v])
            if (whole[index(t)]) return true;
        return false;
    }
};

int corner_of(const SurfaceMesh& mesh, int t, int vertex) {
    for (int corner = 0; corner < 3; ++corner)
        if (mesh.triangles(corner, t) == vertex) return corner;
    return -1;
}

/// The triangles over which the hat of a constrained vertex extends; empty when it has none.
std::vector<int> support_of_hat(const Patch& patch, Tractions tractions, int v) {
    std::vector<int> support;
    const bool whole_hat = tractions == Tractions::continuous || !patch.has_whole(v);
    for (const int t : patch.triangles_of_vertex[v])
        if (whole_hat || (patch.whole[index(t)] && !patch.by_itself[index(t)])) support.push_back(t);
    return support;
}

void add_hat(TractionSpaceBuilder& builder, const Boundary& boundary, int vertex, int constrained,
             const std::vector<int>& support, bool whole) {
    TractionSpace::Block block{{kHat, vertex}, {}, 1, whole ? vertex : -1};
    for (const int t : support) {
        const int corner = corner_of(boundary.mesh(), t, vertex);
        Elements::Element element{t, {-1, -1, -1}};
        element.slots[index(corner)] = 0;
        block.elements.push_back(element);
        block.key.push_back(t);
        builder.share_corner(builder.next_slot(), constrained, t, corner);
    }
    builder.add_block(std::move(block));
}

void add_triangle(TractionSpaceBuilder& builder, const Boundary& boundary, const Patch& patch, int t) {
    for (int corner = 0; corner < 3; ++corner)
        builder.share_corner(builder.next_slot() + corner, patch.number[index(boundary.mesh().triangles(corner, t))], t,
                             corner);
    builder.add_block({{kTriangle, t}, {{t, {0, 1, 2}}}, 3, -1});
    builder.space().interior_triangles.push_back(t);
}

}  // namespace

TractionSpace constant_traction_space(const Boundary& boundary, const std::vector<int>& triangles,
                                      const Eigen::SparseMatrix<double, Eigen::RowMajor>& prescribe) {
    TractionSpaceBuilder builder(boundary, Elements::Order::constant);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const int t = triangles[i], slot = builder.next_slot();
        const Eigen::Vector3d centroid = Eigen::Map<const Eigen::Vector3d>(boundary.triangle(t).centroid);
        using Row = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
        for (Row entry(prescribe, 3 * static_cast<Eigen::Index>(i)); entry; ++entry) {
            const double area = entry.value() * boundary.area(t);
            builder.share(slot, static_cast<int>(entry.col() / 3), area, area * centroid);
        }
        builder.add_block({{kConstant, t}, {{t, {0, -1, -1}}}, 1, t});
    }
    return builder.finished();
}

TractionSpace linear_traction_space(const Boundary& boundary, const VertexTriangles& triangles_of_vertex,
                                    Tractions tractions, std::span<const int> vertices) {
    Patch patch(boundary.mesh(), triangles_of_vertex, vertices);
    if (tractions == Tractions::discontinuous) patch.separate_rim(boundary.mesh(), vertices);

    TractionSpaceBuilder builder(boundary, Elements::Order::linear);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::vector<int> support = support_of_hat(patch, tractions, vertices[i]);
        if (support.empty())
            builder.space().dropped_collocation.push_back(vertices[i]);
        else
            add_hat(builder, boundary, vertices[i], static_cast<int>(i), support,
                    support.size() == triangles_of_vertex[vertices[i]].size());
    }
    for (int t = 0; t < boundary.n_triangles(); ++t)
        if (patch.by_itself[index(t)]) add_triangle(builder, boundary, patch, t);
    for (const int v : builder.space().dropped_collocation) builder.add_block({{kResidual, v}, {}, 0, -1});
    return builder.finished();
}

}  // namespace elastolab
