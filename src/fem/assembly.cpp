#include "fem/assembly.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <Eigen/Dense>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace elastolab {

namespace {

/// Gradients of the four shape functions (columns) and the volume.
struct Element {
    Eigen::Matrix<double, 3, 4> gradients;
    double volume = 0.0;
};

Element make_element(const TetMesh& mesh, int t) {
    const Eigen::Vector4i v = mesh.tetrahedra.col(t);
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i) edges.col(i) = mesh.vertices.col(v[i + 1]) - mesh.vertices.col(v[0]);
    const double determinant = edges.determinant();
    if (!(determinant > 0.0))
        throw MeshError("tetrahedron " + std::to_string(t) +
                        ": has no positive volume. Repair slivers of the surface and fill it again.");
    Element element;
    element.volume = determinant / 6.0;
    element.gradients.rightCols<3>() = edges.inverse().transpose();
    element.gradients.col(0) = -element.gradients.rightCols<3>().rowwise().sum();
    return element;
}

std::vector<Element> make_elements(const TetMesh& mesh, Control& control) {
    std::vector<Element> elements(static_cast<std::size_t>(mesh.n_tetrahedra()));
    parallel_blocks(mesh.n_tetrahedra(), 1024, control, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) elements[static_cast<std::size_t>(t)] = make_element(mesh, t);
    });
    return elements;
}

/// Rows of different lengths in one array.
struct Lists {
    std::vector<int> offsets, values;
    const int* begin(int i) const { return values.data() + offsets[static_cast<std::size_t>(i)]; }
    const int* end(int i) const { return values.data() + offsets[static_cast<std::size_t>(i) + 1]; }
};

/// For every vertex, the tetrahedra around it, ascending: the order of summation, hence the same for any thread count.
Lists tetrahedra_around_vertices(const TetMesh& mesh) {
    Lists lists;
    lists.offsets.assign(static_cast<std::size_t>(mesh.n_vertices()) + 1, 0);
    for (int v : mesh.tetrahedra.reshaped()) ++lists.offsets[static_cast<std::size_t>(v) + 1];
    for (std::size_t v = 1; v < lists.offsets.size(); ++v) lists.offsets[v] += lists.offsets[v - 1];
    lists.values.resize(static_cast<std::size_t>(mesh.tetrahedra.size()));
    std::vector<int> next(lists.offsets.begin(), lists.offsets.end() - 1);
    for (int t = 0; t < mesh.n_tetrahedra(); ++t)
        for (int v : mesh.tetrahedra.col(t))
            lists.values[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = t;
    return lists;
}

/// For every vertex, the vertices it shares a tetrahedron with, itself among them, ascending.
Lists neighbours(const TetMesh& mesh, const Lists& around) {
    Lists lists;
    lists.offsets.push_back(0);
    std::vector<int> row;
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        row.assign(1, v);
        for (const int* t = around.begin(v); t != around.end(v); ++t)
            for (int w : mesh.tetrahedra.col(*t)) row.push_back(w);
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        lists.values.insert(lists.values.end(), row.begin(), row.end());
        lists.offsets.push_back(static_cast<int>(lists.values.size()));
    }
    return lists;
}

/// A matrix of zeros with a 3 x 3 block for every entry of `pattern`.
SparseMatrix zero_blocks(const Lists& pattern) {
    const int n = static_cast<int>(pattern.offsets.size()) - 1;
    if (9 * static_cast<std::int64_t>(pattern.values.size()) > std::numeric_limits<int>::max())
        throw SolveError("stiffness matrix: more than 2^31 entries. Use a coarser mesh.");
    SparseMatrix K(3 * n, 3 * n);
    K.resizeNonZeros(9 * static_cast<int>(pattern.values.size()));
    int entry = 0;
    for (int column = 0; column < 3 * n; ++column) {
        K.outerIndexPtr()[column] = entry;
        for (const int* w = pattern.begin(column / 3); w != pattern.end(column / 3); ++w)
            for (int i = 0; i < 3; ++i) K.innerIndexPtr()[entry++] = 3 * *w + i;
    }
    K.outerIndexPtr()[3 * n] = entry;
    std::fill_n(K.valuePtr(), entry, 0.0);
    return K;
}

}  // namespace

StiffnessParts assemble_stiffness_parts(const TetMesh& mesh, Control& control) {
    const std::vector<Element> elements = make_elements(mesh, control);
    const Lists around = tetrahedra_around_vertices(mesh);
    const Lists pattern = neighbours(mesh, around);
    StiffnessParts parts{zero_blocks(pattern), {}};
    parts.mu = parts.lambda;

    // The three columns of vertex v are one dense block of rows 3*|neighbours(v)|.
    const auto add_vertex = [&](int v) {
        const Eigen::Index rows = 3 * (pattern.end(v) - pattern.begin(v));
        const Eigen::Index first = parts.lambda.outerIndexPtr()[3 * v];
        Eigen::Map<Eigen::MatrixX3d> lambda(parts.lambda.valuePtr() + first, rows, 3);
        Eigen::Map<Eigen::MatrixX3d> mu(parts.mu.valuePtr() + first, rows, 3);
        for (const int* t = around.begin(v); t != around.end(v); ++t) {
            const Element& element = elements[static_cast<std::size_t>(*t)];
            const Eigen::Vector4i corners = mesh.tetrahedra.col(*t);
            const auto b = std::find(corners.begin(), corners.end(), v) - corners.begin();
            const Eigen::Vector3d g_b = element.gradients.col(b);
            for (int a = 0; a < 4; ++a) {
                const Eigen::Vector3d g_a = element.gradients.col(a);
                const auto row =
                    3 * (std::lower_bound(pattern.begin(v), pattern.end(v), corners[a]) - pattern.begin(v));
                // One product, then the factor: otherwise (V g_a) g_b and (V g_b) g_a round differently in K_ab and
                // K_ba.
                const Eigen::Matrix3d outer = g_a * g_b.transpose();
                lambda.middleRows<3>(row) += element.volume * outer;
                mu.middleRows<3>(row) += element.volume * outer.transpose();
                mu.middleRows<3>(row).diagonal().array() += element.volume * g_a.dot(g_b);
            }
        }
    };
    parallel_blocks(mesh.n_vertices(), 256, control, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) add_vertex(v);
    });
    return parts;
}

SparseMatrix stiffness(const StiffnessParts& parts, const Material& material) {
    assert(material.poisson_ratio < 0.5);
    SparseMatrix K = parts.mu;
    K.coeffs() = material.lame_lambda() * parts.lambda.coeffs() + material.shear_modulus() * parts.mu.coeffs();
    return K;
}

}  // namespace elastolab
