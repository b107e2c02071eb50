#include "bem/collocation/assembly.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "bem/space_curve.hpp"
#include "elasticity/far_field.hpp"

namespace elastolab {

namespace {

constexpr int kPacksPerBlock = 4;

int numbers_of(Layer layer) { return layer == Layer::single_layer ? kSingleLayerNumbers : kDoubleLayerNumbers; }

int n_packs(int n_points, int lanes) { return (n_points + lanes - 1) / lanes; }

/// As many collocation points as a kernel takes at once, and the ball around them.
struct Pack {
    SourceLanes lanes{};
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0.0;

    Pack(const CollocationPoints& points, std::span<const int> numbers, int n_lanes) {
        Positions own(3, n_lanes);
        for (int i = 0; i < n_lanes; ++i) {
            const int point = numbers[std::min(static_cast<std::size_t>(i), numbers.size() - 1)];
            own.col(i) = points.positions.col(point);
            lanes.x[i] = points.positions(0, point);
            lanes.y[i] = points.positions(1, point);
            lanes.z[i] = points.positions(2, point);
            lanes.own_triangle[i] = points.own_triangle[static_cast<std::size_t>(point)];
        }
        centre = own.rowwise().mean();
        radius = (own.colwise() - centre).colwise().norm().maxCoeff();
    }
};

/// Integrates one pack of collocation points after the other.
class PackIntegrator {
public:
    PackIntegrator(Layer layer, const Boundary& boundary, const CollocationPoints& points, const Elements& elements,
                   double tolerance)
        : layer_(layer),
          boundary_(boundary),
          points_(points),
          elements_(elements),
          far_field_(tolerance),
          order_(along_a_curve(points.positions)) {
        const bool linear = elements.order == Elements::Order::linear;
        if (layer == Layer::single_layer)
            kernel_ = linear ? kernels_.single_layer_linear : kernels_.single_layer_constant;
        else
            kernel_ = linear ? kernels_.double_layer_linear : kernels_.double_layer_constant;
    }

    int lanes() const { return kernels_.lanes; }
    std::size_t slot_size() const { return static_cast<std::size_t>(numbers_of(layer_) * lanes()); }
    /// One slot more than there are: what is not wanted goes there.
    std::size_t buffer_size() const { return slot_size() * static_cast<std::size_t>(elements_.n_slots + 1); }

    /// Numbers of the collocation points in a pack: as many as lanes, fewer in the last.
    std::span<const int> sources_of(int pack) const {
        const auto first = static_cast<std::size_t>(pack * lanes());
        return std::span(order_).subspan(first, std::min(static_cast<std::size_t>(lanes()), order_.size() - first));
    }

    /// buffer [slot][number][lane] <- the integrals of pack number `pack`.
    void integrate(int pack, double* buffer) const {
        std::fill(buffer, buffer + buffer_size(), 0.0);
        const std::span<const int> numbers = sources_of(pack);
        const Pack points(points_, numbers, lanes());
        for (const Elements::Element& element : elements_.elements) {
            const TriangleGeometry& triangle = boundary_.triangle(element.triangle);
            const double distance =
                (Eigen::Map<const Eigen::Vector3d>(triangle.centroid) - points.centre).norm() - points.radius;
            double* const out[3] = {slot(buffer, element.slots[0]), slot(buffer, element.slots[1]),
                                    slot(buffer, element.slots[2])};
            kernel_(triangle, points.lanes, far_field_.rule(distance / triangle.longest_edge), out);
        }
    }

    /// Completes the integrals of a double layer over a whole closed surface.
    void add_free_terms(int pack, double* buffer) const {
        const std::span<const int> numbers = sources_of(pack);
        std::vector<double> sum(slot_size(), 0.0);
        for (int s = 0; s < elements_.n_slots; ++s)
            for (std::size_t i = 0; i < slot_size(); ++i) sum[i] += slot(buffer, s)[i];
        for (std::size_t lane = 0; lane < numbers.size(); ++lane)
            for (const CollocationPoints::Weight& weight : points_.weights[static_cast<std::size_t>(numbers[lane])]) {
                if (weight.slot < 0) continue;
                for (std::size_t i = lane; i < slot_size(); i += static_cast<std::size_t>(lanes()))
                    slot(buffer, weight.slot)[i] -= weight.value * sum[i];
            }
    }

private:
    double* slot(double* buffer, int number) const {
        return buffer + slot_size() * static_cast<std::size_t>(number < 0 ? elements_.n_slots : number);
    }

    Layer layer_;
    const Boundary& boundary_;
    const CollocationPoints& points_;
    const Elements& elements_;
    FarField far_field_;
    std::vector<int> order_;
    const TriangleKernels& kernels_ = best_triangle_kernels();
    void (*kernel_)(const TriangleGeometry&, const SourceLanes&, const GaussRule*, double* const*) = nullptr;
};

/// Turns the material-free numbers of a pack into blocks of the matrix.
class Combination {
public:
    Combination(Layer layer, const Material& material) : layer_(layer) {
        const double nu = material.poisson_ratio, pi = std::numbers::pi;
        if (layer == Layer::single_layer) {
            tensor_ = 1.0 / (16.0 * pi * material.shear_modulus() * (1.0 - nu));
            scalar_ = (3.0 - 4.0 * nu) * tensor_;
        } else {
            tensor_ = -1.0 / (8.0 * pi * (1.0 - nu));
            scalar_ = (1.0 - 2.0 * nu) * tensor_;
        }
    }

    /// Rows of these collocation points <- buffer [slot][number][lane].
    void write(const double* buffer, std::span<const int> points, int lanes, Eigen::Ref<Eigen::MatrixXd> out) const {
        const Eigen::Index n_slots = out.cols() / 3, stride = numbers_of(layer_) * lanes;
        for (Eigen::Index s = 0; s < n_slots; ++s)
            for (std::size_t lane = 0; lane < points.size(); ++lane)
                out.block<3, 3>(3 * points[lane], 3 * s) =
                    block(buffer + s * stride + static_cast<Eigen::Index>(lane), lanes);
    }

private:
    Eigen::Matrix3d block(const double* numbers, int lanes) const {
        const auto number = [&](int k) { return numbers[k * lanes]; };
        const int t = layer_ == Layer::single_layer ? 1 : 4;
        const double s = scalar_ * number(0);
        Eigen::Matrix3d b;
        b(0, 0) = s + tensor_ * number(t), b(1, 1) = s + tensor_ * number(t + 1), b(2, 2) = s + tensor_ * number(t + 2);
        b(0, 1) = b(1, 0) = tensor_ * number(t + 3);
        b(0, 2) = b(2, 0) = tensor_ * number(t + 4);
        b(1, 2) = b(2, 1) = tensor_ * number(t + 5);
        if (layer_ == Layer::double_layer) {
            const double x = scalar_ * number(1), y = scalar_ * number(2), z = scalar_ * number(3);
            b(0, 1) -= z, b(1, 0) += z;
            b(0, 2) += y, b(2, 0) -= y;
            b(1, 2) -= x, b(2, 1) += x;
        }
        return b;
    }

    Layer layer_;
    double scalar_, tensor_;
};

}  // namespace

void assemble(Layer layer, const Boundary& boundary, const CollocationPoints& points, const Elements& elements,
              const Material& material, double tolerance, Eigen::Ref<Eigen::MatrixXd> out, Control& control) {
    assert(out.rows() == 3 * points.size() && out.cols() == 3 * elements.n_slots);
    const PackIntegrator integrator(layer, boundary, points, elements, tolerance);
    const Combination combination(layer, material);
    const auto run = [&](int begin, int end) {
        std::vector<double> buffer(integrator.buffer_size());
        for (int pack = begin; pack < end; ++pack) {
            integrator.integrate(pack, buffer.data());
            if (layer == Layer::double_layer) integrator.add_free_terms(pack, buffer.data());
            combination.write(buffer.data(), integrator.sources_of(pack), integrator.lanes(), out);
        }
    };
    parallel_blocks(n_packs(points.size(), integrator.lanes()), kPacksPerBlock, control, run);
}

void integrate_block(Layer layer, const Boundary& boundary, const CollocationPoints& points, const Elements& elements,
                     const Material& material, double tolerance, Eigen::Ref<Eigen::MatrixXd> out) {
    assert(out.rows() == 3 * points.size() && out.cols() == 3 * elements.n_slots);
    const PackIntegrator integrator(layer, boundary, points, elements, tolerance);
    const Combination combination(layer, material);
    std::vector<double> buffer(integrator.buffer_size());
    for (int pack = 0; pack < n_packs(points.size(), integrator.lanes()); ++pack) {
        integrator.integrate(pack, buffer.data());
        combination.write(buffer.data(), integrator.sources_of(pack), integrator.lanes(), out);
    }
}

}  // namespace elastolab
