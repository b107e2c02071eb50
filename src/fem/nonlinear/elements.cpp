#include "fem/nonlinear/elements.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <Eigen/LU>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "elasticity/neo_hookean.hpp"
#include "fem/quadratic_mesh.hpp"

namespace elastolab {

namespace {

/// Packs, and nodes, of one task.
constexpr int kPacksAtOnce = 16, kNodesAtOnce = 512;

void fill_lane(const Eigen::Matrix<double, 3, 4>& corners, int element, int lane, ElementPack& pack) {
    const Eigen::Matrix3d edges = corners.rightCols<3>().colwise() - corners.col(0);
    const double determinant = edges.determinant();
    if (!(determinant > 0.0))
        throw MeshError("tetrahedron " + std::to_string(element) +
                        ": has no positive volume. Repair slivers of the surface and fill it again.");
    Eigen::Matrix<double, 3, 4> gradients;
    gradients.rightCols<3>() = edges.inverse().transpose();
    gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
    for (int c = 0; c < 4; ++c)
        for (int i = 0; i < 3; ++i) pack.gradients[c][i][lane] = gradients(i, c);
    pack.volume[lane] = determinant / 6.0;
}

}  // namespace

FiniteElements::FiniteElements(const Positions& positions, Eigen::MatrixXi elements)
    : positions_(positions), elements_(std::move(elements)) {
    assert(elements_.rows() == 4 || elements_.rows() == 10);
    const int n = n_elements();
    packs_.resize(static_cast<std::size_t>((n + kPack - 1) / kPack));
    double volume = 0.0;
    for (int e = 0; e < static_cast<int>(packs_.size()) * kPack; ++e) {
        ElementPack& pack = packs_[static_cast<std::size_t>(e / kPack)];
        const Eigen::Vector4i corners = elements_.col(std::min(e, n - 1)).head<4>();
        fill_lane(positions_(Eigen::all, corners), e, e % kPack, pack);
        if (e >= n) pack.volume[e % kPack] = 0.0;
        volume += pack.volume[e % kPack];
    }
    edge_ = n > 0 ? std::cbrt(8.5 * volume / n) : 1.0;
    first_around_.assign(static_cast<std::size_t>(n_nodes()) + 1, 0);
    for (const int node : elements_.reshaped()) ++first_around_[static_cast<std::size_t>(node) + 1];
    for (std::size_t v = 1; v < first_around_.size(); ++v) first_around_[v] += first_around_[v - 1];
    around_.resize(static_cast<std::size_t>(elements_.size()));
    std::vector<int> next(first_around_.begin(), first_around_.end() - 1);
    for (int e = 0; e < n; ++e)
        for (int a = 0; a < nodes_per_element(); ++a)
            around_[static_cast<std::size_t>(next[static_cast<std::size_t>(elements_(a, e))]++)] = {e, a};
}

std::span<const ElementCorner> FiniteElements::around(int node) const {
    const auto first = static_cast<std::size_t>(first_around_[static_cast<std::size_t>(node)]);
    const auto last = static_cast<std::size_t>(first_around_[static_cast<std::size_t>(node) + 1]);
    return std::span(around_).subspan(first, last - first);
}

ElementWork FiniteElements::make_work(bool with_stiffness) const {
    const std::size_t n = packs_.size() * kPack, nodes = static_cast<std::size_t>(nodes_per_element());
    ElementWork work;
    work.forces.resize(n * 3 * nodes);
    if (with_stiffness) work.stiffness.resize(n * 9 * static_cast<std::size_t>(block_count(nodes_per_element())));
    work.energies.resize(n);
    work.least_J.resize(n);
    return work;
}

void FiniteElements::evaluate(int pack, const double* u, const Material& material, const PackResult& result) const {
    const ElementKernels& kernels = best_element_kernels();
    const auto kernel = nodes_per_element() == 4 ? kernels.linear : kernels.quadratic;
    kernel(packs_[static_cast<std::size_t>(pack)], u, material.shear_modulus(), material.lame_lambda(), result);
}

void FiniteElements::gather(int pack, const Eigen::VectorXd& u, double* packed) const {
    const int n = nodes_per_element();
    for (int lane = 0; lane < kPack; ++lane) {
        const int e = std::min(element_of(pack, lane), n_elements() - 1);
        for (int a = 0; a < n; ++a)
            for (int i = 0; i < 3; ++i) packed[(3 * a + i) * kPack + lane] = u[3 * elements_(a, e) + i];
    }
}

template <class Use>
void FiniteElements::for_each_pack(Control& control, const Use& use) const {
    Control inner;  // these are not the steps to report
    parallel_blocks(static_cast<int>(packs_.size()), kPacksAtOnce, inner, [&](int begin, int end) {
        for (int pack = begin; pack < end; ++pack) use(pack);
    });
    control.checkpoint();
}

BodyEnergy FiniteElements::energy(const Eigen::VectorXd& u, const Material& material, ElementWork& work,
                                  Control& control) const {
    for_each_pack(control, [&](int pack) {
        double packed[kMostElementNumbers * kPack];
        gather(pack, u, packed);
        const std::size_t first = static_cast<std::size_t>(pack) * kPack;
        evaluate(pack, packed, material,
                 {.energy = work.energies.data() + first, .least_J = work.least_J.data() + first});
    });
    BodyEnergy sum{0.0, std::numeric_limits<double>::infinity(), -1};
    for (int e = 0; e < n_elements(); ++e) {
        const auto at = static_cast<std::size_t>(e);
        sum.energy += work.energies[at];
        if (!(work.least_J[at] >= sum.least_J)) {
            sum.least_J = work.least_J[at];
            sum.element = e;
        }
    }
    if (!(sum.least_J > 0.0) || !std::isfinite(sum.energy)) sum.energy = std::numeric_limits<double>::infinity();
    return sum;
}

Eigen::VectorXd FiniteElements::gathered(const ElementWork& work, Control& control) const {
    Eigen::VectorXd sum(3 * n_nodes());
    const int n = nodes_per_element();
    Control inner;
    parallel_blocks(n_nodes(), kNodesAtOnce, inner, [&](int begin, int end) {
        for (int node = begin; node < end; ++node) {
            Eigen::Vector3d force = Eigen::Vector3d::Zero();
            for (const auto& [element, local] : around(node))
                force += Eigen::Map<const Eigen::Vector3d>(work.forces.data() +
                                                           static_cast<std::ptrdiff_t>(3) * (n * element + local));
            sum.segment<3>(3 * node) = force;
        }
    });
    control.checkpoint();
    return sum;
}

Eigen::VectorXd FiniteElements::forces(const Eigen::VectorXd& u, const Material& material, ElementWork& work,
                                       Control& control) const {
    const int n = 3 * nodes_per_element();
    for_each_pack(control, [&](int pack) {
        double packed[kMostElementNumbers * kPack], forces[kMostElementNumbers * kPack];
        gather(pack, u, packed);
        evaluate(pack, packed, material, {.forces = forces});
        for (int lane = 0; lane < kPack; ++lane)
            for (int i = 0; i < n; ++i)
                work.forces[static_cast<std::size_t>(n * element_of(pack, lane) + i)] = forces[i * kPack + lane];
    });
    return gathered(work, control);
}

Eigen::VectorXd FiniteElements::force_change(const Eigen::VectorXd& u, const Eigen::VectorXd& change,
                                             const Material& material, ElementWork& work, Control& control) const {
    const int n = 3 * nodes_per_element();
    for_each_pack(control, [&](int pack) {
        double packed[kMostElementNumbers * kPack], packed_change[kMostElementNumbers * kPack],
            forces[kMostElementNumbers * kPack];
        gather(pack, u, packed);
        gather(pack, change, packed_change);
        evaluate(pack, packed, material, {.change = packed_change, .force_change = forces});
        for (int lane = 0; lane < kPack; ++lane)
            for (int i = 0; i < n; ++i)
                work.forces[static_cast<std::size_t>(n * element_of(pack, lane) + i)] = forces[i * kPack + lane];
    });
    return gathered(work, control);
}

void FiniteElements::stiffness(const Eigen::VectorXd& u, const Material& material, bool projected, ElementWork& work,
                               Control& control) const {
    const int numbers = 9 * block_count(nodes_per_element());
    const auto blocks_of = [&](int element) {
        return work.stiffness.data() + static_cast<std::ptrdiff_t>(numbers) * element;
    };
    if (projected) {
        Control inner;
        parallel_blocks(n_elements(), kPacksAtOnce * kPack, inner, [&](int begin, int end) {
            for (int e = begin; e < end; ++e) project(e, u, material, blocks_of(e));
        });
        control.checkpoint();
        return;
    }
    for_each_pack(control, [&](int pack) {
        double packed[kMostElementNumbers * kPack], blocks[9 * 55 * kPack];
        gather(pack, u, packed);
        evaluate(pack, packed, material, {.stiffness = blocks});
        for (int lane = 0; lane < kPack; ++lane) {
            double* target = blocks_of(element_of(pack, lane));
            for (int i = 0; i < numbers; ++i) target[i] = blocks[i * kPack + lane];
        }
    });
}

void FiniteElements::project(int element, const Eigen::VectorXd& u, const Material& material, double* blocks) const {
    const NeoHookean law(material);
    const int n = nodes_per_element();
    std::fill_n(blocks, 9 * block_count(n), 0.0);
    for (int point = 0; point < n_points(); ++point) {
        const auto g = shape_gradients(element, point);
        const double weight = volume(element) / n_points();
        const ElasticTensor A = weight * law.projected_tangent(gradient(u, element, point));
        for (int a = 0; a < n; ++a) {
            // rows (i): sum over j of g_aj A(i + 3 j, .)
            Eigen::Matrix<double, 3, 9> left = Eigen::Matrix<double, 3, 9>::Zero();
            for (int j = 0; j < 3; ++j) left += g(a, j) * A.middleRows<3>(3 * j);
            for (int b = 0; b <= a; ++b) {
                Eigen::Map<Eigen::Matrix3d> block(blocks + 9 * block_index(a, b));
                for (int l = 0; l < 3; ++l) block += left.middleCols<3>(3 * l) * g(b, l);
            }
        }
    }
}

FiniteElements::ShapeGradients FiniteElements::shape_gradients(int element, int point) const {
    const ElementPack& pack = packs_[static_cast<std::size_t>(element / kPack)];
    Eigen::Matrix<double, 4, 3> corners;
    for (int c = 0; c < 4; ++c)
        for (int i = 0; i < 3; ++i) corners(c, i) = pack.gradients[c][i][element % kPack];
    if (nodes_per_element() == 4) return corners;
    Eigen::Vector4d L = Eigen::Vector4d::Constant(kGaussFar);
    L[point] = kGaussNear;
    return quadratic_slopes(L) * corners;
}

Eigen::Matrix3d FiniteElements::gradient(const Eigen::VectorXd& u, int element, const ShapeGradients& shapes) const {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    for (int a = 0; a < nodes_per_element(); ++a) H += u.segment<3>(3 * elements_(a, element)) * shapes.row(a);
    return H;
}

double FiniteElements::largest_stretch(const Eigen::VectorXd& u, Control& control) const {
    constexpr int kAtOnce = 256;
    std::vector<double> largest(static_cast<std::size_t>(n_elements() / kAtOnce + 1), 1.0);
    Control inner;
    parallel_blocks(n_elements(), kAtOnce, inner, [&](int begin, int end) {
        double& its = largest[static_cast<std::size_t>(begin / kAtOnce)];
        for (int e = begin; e < end; ++e)
            for (int point = 0; point < n_points(); ++point)
                its = elastolab::largest_stretch(gradient(u, e, point), its);
    });
    control.checkpoint();
    return *std::max_element(largest.begin(), largest.end());
}

double FiniteElements::volume(int element) const {
    return packs_[static_cast<std::size_t>(element / kPack)].volume[element % kPack];
}

}  // namespace elastolab
