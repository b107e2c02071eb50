#include "fem/assembly.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "fem/element.hpp"

namespace elastolab {

namespace {

/// Derivative of a shape function with respect to one barycentric coordinate: slope * L_of + constant.
struct Derivative {
    int along = 0;
    double slope = 0.0;
    int of = 0;
    double constant = 0.0;
};

/// A shape function of a tetrahedron by its derivatives that are not zero.
struct Shape {
    int n = 0;
    std::array<Derivative, 2> derivatives;
};

/// L_a for four nodes; L_a (2 L_a - 1) and 4 L_a L_b for ten.
template <int n_nodes>
std::array<Shape, n_nodes> shapes() {
    std::array<Shape, n_nodes> result;
    for (int a = 0; a < 4; ++a) {
        const Derivative derivative = n_nodes == 4 ? Derivative{a, 0.0, a, 1.0} : Derivative{a, 4.0, a, -1.0};
        result[static_cast<std::size_t>(a)] = {1, {derivative}};
    }
    for (int e = 0; e < n_nodes - 4; ++e) {
        const auto& [a, b] = kTetEdges[e];
        result[static_cast<std::size_t>(4 + e)] = {2, {Derivative{a, 4.0, b, 0.0}, Derivative{b, 4.0, a, 0.0}}};
    }
    return result;
}

/// Mean of the product over a tetrahedron, where L_i has the mean 1/4 and L_i L_j 1/20, or 1/10 when i = j.
double mean_product(const Derivative& p, const Derivative& q) {
    return p.slope * q.slope * (p.of == q.of ? 0.1 : 0.05) + 0.25 * (p.slope * q.constant + p.constant * q.slope) +
           p.constant * q.constant;
}

/// Elements of n nodes, corners first.
template <int n>
struct Mesh {
    const Positions& nodes;
    Eigen::Ref<const Eigen::Matrix<int, n, Eigen::Dynamic>> elements;

    int n_nodes() const { return static_cast<int>(nodes.cols()); }
    int n_elements() const { return static_cast<int>(elements.cols()); }
};

template <int n>
std::vector<TetElement> make_elements(const Mesh<n>& mesh, Control& control) {
    std::vector<TetElement> elements(static_cast<std::size_t>(mesh.n_elements()));
    parallel_blocks(mesh.n_elements(), 1024, control, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) {
            const Eigen::Vector4i corners = mesh.elements.col(t).template head<4>();
            elements[static_cast<std::size_t>(t)] = make_element(mesh.nodes(Eigen::all, corners), t);
        }
    });
    return elements;
}

/// Mean over the element of grad N_a grad N_b^T, exactly the transpose of that of (b, a).
template <int n>
Eigen::Matrix3d mean_outer(const TetElement& element, const std::array<Shape, n>& shapes, int a, int b) {
    const Shape& first = shapes[static_cast<std::size_t>(std::min(a, b))];
    const Shape& second = shapes[static_cast<std::size_t>(std::max(a, b))];
    Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();
    for (int i = 0; i < first.n; ++i)
        for (int j = 0; j < second.n; ++j) {
            const Derivative& p = first.derivatives[static_cast<std::size_t>(i)];
            const Derivative& q = second.derivatives[static_cast<std::size_t>(j)];
            // One product, then the factor: otherwise g_p g_q and g_q g_p round differently.
            const Eigen::Matrix3d product = element.gradients.col(p.along) * element.gradients.col(q.along).transpose();
            outer += mean_product(p, q) * product;
        }
    if (a == b) return 0.5 * (outer + outer.transpose());
    if (a > b) return outer.transpose();
    return outer;
}

/// Rows of different lengths in one array.
struct Lists {
    std::vector<int> offsets, values;
    const int* begin(int i) const { return values.data() + offsets[static_cast<std::size_t>(i)]; }
    const int* end(int i) const { return values.data() + offsets[static_cast<std::size_t>(i) + 1]; }
};

/// For every node, the elements around it, ascending: the order of summation, hence the same for any thread count.
template <int n>
Lists elements_around_nodes(const Mesh<n>& mesh) {
    Lists lists;
    lists.offsets.assign(static_cast<std::size_t>(mesh.n_nodes()) + 1, 0);
    for (int v : mesh.elements.reshaped()) ++lists.offsets[static_cast<std::size_t>(v) + 1];
    for (std::size_t v = 1; v < lists.offsets.size(); ++v) lists.offsets[v] += lists.offsets[v - 1];
    lists.values.resize(static_cast<std::size_t>(mesh.elements.size()));
    std::vector<int> next(lists.offsets.begin(), lists.offsets.end() - 1);
    for (int t = 0; t < mesh.n_elements(); ++t)
        for (int v : mesh.elements.col(t))
            lists.values[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = t;
    return lists;
}

/// For every node, the nodes it shares an element with, itself among them, ascending.
template <int n>
Lists neighbours(const Mesh<n>& mesh, const Lists& around) {
    Lists lists;
    lists.offsets.push_back(0);
    std::vector<int> row;
    for (int v = 0; v < mesh.n_nodes(); ++v) {
        row.assign(1, v);
        for (const int* t = around.begin(v); t != around.end(v); ++t)
            for (int w : mesh.elements.col(*t)) row.push_back(w);
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

template <int n>
StiffnessParts assemble(const Mesh<n>& mesh, Control& control) {
    const std::vector<TetElement> elements = make_elements(mesh, control);
    const std::array<Shape, n> shape_functions = shapes<n>();
    const Lists around = elements_around_nodes(mesh);
    const Lists pattern = neighbours(mesh, around);
    StiffnessParts parts{zero_blocks(pattern), {}};
    parts.mu = parts.lambda;

    // The three columns of node v are one dense block of rows 3*|neighbours(v)|.
    const auto add_node = [&](int v) {
        const Eigen::Index rows = 3 * (pattern.end(v) - pattern.begin(v));
        const Eigen::Index first = parts.lambda.outerIndexPtr()[3 * v];
        Eigen::Map<Eigen::MatrixX3d> lambda(parts.lambda.valuePtr() + first, rows, 3);
        Eigen::Map<Eigen::MatrixX3d> mu(parts.mu.valuePtr() + first, rows, 3);
        for (const int* t = around.begin(v); t != around.end(v); ++t) {
            const TetElement& element = elements[static_cast<std::size_t>(*t)];
            const Eigen::Vector<int, n> nodes = mesh.elements.col(*t);
            const int b = static_cast<int>(std::find(nodes.begin(), nodes.end(), v) - nodes.begin());
            for (int a = 0; a < n; ++a) {
                const auto row = 3 * (std::lower_bound(pattern.begin(v), pattern.end(v), nodes[a]) - pattern.begin(v));
                const Eigen::Matrix3d outer = mean_outer<n>(element, shape_functions, a, b);
                lambda.middleRows<3>(row) += element.volume * outer;
                mu.middleRows<3>(row) += element.volume * outer.transpose();
                mu.middleRows<3>(row).diagonal().array() += element.volume * outer.trace();
            }
        }
    };
    parallel_blocks(mesh.n_nodes(), 256, control, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) add_node(v);
    });
    return parts;
}

}  // namespace

StiffnessParts assemble_stiffness_parts(const TetMesh& mesh, Control& control) {
    return assemble<4>({mesh.vertices, mesh.tetrahedra}, control);
}

StiffnessParts assemble_stiffness_parts(const QuadraticMesh& mesh, Control& control) {
    return assemble<10>({mesh.positions, mesh.elements}, control);
}

StiffnessParts assemble_stiffness_parts(const Positions& nodes, const Eigen::MatrixXi& elements, Control& control) {
    assert(elements.rows() == 4 || elements.rows() == 10);
    if (elements.rows() == 4) return assemble<4>({nodes, elements.topRows<4>()}, control);
    return assemble<10>({nodes, elements.topRows<10>()}, control);
}

SparseMatrix stiffness(const StiffnessParts& parts, const Material& material) {
    assert(material.poisson_ratio < 0.5);
    SparseMatrix K = parts.mu;
    K.coeffs() = material.lame_lambda() * parts.lambda.coeffs() + material.shear_modulus() * parts.mu.coeffs();
    return K;
}

}  // namespace elastolab
