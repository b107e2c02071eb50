#include "bem/boundary_field.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"
#include "elasticity/far_field.hpp"
#include "elasticity/stress.hpp"

namespace elastolab {

namespace {

/// Far below the error of any discretisation; the error of a rule is as smooth as the integral.
constexpr double kFieldTolerance = 1e-5;
/// Step of the differences, in units of the distance from the surface.
constexpr double kStep = 1e-3;
/// The point itself, then a step forward and back along each axis, and one to fill the lanes.
constexpr int kStencil = 8;
constexpr int kMostMoves = 4;

using Lanes = Eigen::Array<double, kMaxLanes, 1>;

Eigen::Map<const Eigen::Vector3d> vector(const double* values) { return Eigen::Map<const Eigen::Vector3d>(values); }

}  // namespace

void SurfaceTractions::add(const Elements& elements, const Eigen::MatrixXd& coefficients) {
    assert(coefficients.rows() == 3 * elements.n_slots && coefficients.cols() == n_solutions_);
    const bool linear = elements.order == Elements::Order::linear;
    for (const Elements::Element& element : elements.elements) {
        Loaded loaded{element.triangle, Eigen::MatrixXd::Zero(9, n_solutions_)};
        for (int corner = 0; corner < 3; ++corner)
            if (const int slot = element.slots[linear ? static_cast<std::size_t>(corner) : 0]; slot >= 0)
                loaded.corners.middleRows<3>(3 * corner) = coefficients.middleRows<3>(3 * slot);
        triangles_.push_back(std::move(loaded));
    }
}

BoundaryField::BoundaryField(std::shared_ptr<const Boundary> boundary, double poisson_ratio,
                             Eigen::MatrixXd displacements, SurfaceTractions tractions)
    : boundary_(std::move(boundary)),
      poisson_ratio_(poisson_ratio),
      displacements_(std::move(displacements)),
      tractions_(std::move(tractions)),
      closest_(boundary_->mesh()) {
    assert(displacements_.rows() == 3 * boundary_->mesh().n_vertices() &&
           displacements_.cols() == tractions_.n_solutions());
}

BoundaryField::Place BoundaryField::place_of(const Eigen::Vector3d& point) const {
    const SurfaceMesh& mesh = boundary_->mesh();
    Place best{point, 0.0, 0};
    Eigen::Vector3d x = point;
    double least = 0.0;
    // On an edge or at a corner, each move takes the point away from one of its faces.
    for (int move = 0; move <= kMostMoves; ++move) {
        const SurfacePoint nearest = closest_(x);
        const TriangleGeometry& triangle = boundary_->triangle(nearest.triangle);
        const Eigen::Vector3i corners = mesh.triangles.col(nearest.triangle);
        const Eigen::Vector3d on_surface = mesh.vertices(Eigen::all, corners) * nearest.weights;
        least = kNearest * triangle.longest_edge;
        Eigen::Vector3d inward = -vector(triangle.n);
        const bool inside = (x - on_surface).dot(inward) > 0.0;
        if (inside && nearest.distance > 0.2 * least) inward = (x - on_surface).normalized();
        if (move == 0 || (inside && nearest.distance > best.distance))
            best = {x, inside ? nearest.distance : 0.0, corners[0]};
        if (inside && nearest.distance >= (move == 0 ? 1.0 : 0.9) * least) return {x, nearest.distance, corners[0]};
        x = (inside ? x - nearest.distance * inward : on_surface) + least * inward;
    }
    // The body is thinner than that here, or the point is outside: the best place that was found.
    best.distance = std::max(best.distance, 0.1 * least);
    return best;
}

/// Both layers over the whole surface, seen from a few points close together.
class BoundaryField::PointIntegrator {
public:
    explicit PointIntegrator(const BoundaryField& field) : field_(field), n_solutions_(field.displacements_.cols()) {
        const double nu = field.poisson_ratio_, pi = std::numbers::pi;
        single_tensor_ = 1.0 / (16.0 * pi * Material{1.0, nu}.shear_modulus() * (1.0 - nu));
        single_scalar_ = (3.0 - 4.0 * nu) * single_tensor_;
        double_tensor_ = -1.0 / (8.0 * pi * (1.0 - nu));
        double_scalar_ = (1.0 - 2.0 * nu) * double_tensor_;
        dilatation_ = 0.25 * std::numbers::inv_pi * nu / (1.0 - nu);
        const auto n = static_cast<std::size_t>(field.boundary_->mesh().n_vertices());
        layer_.resize(n * slot_size());
        sums_.resize(static_cast<std::size_t>(n_solutions_));
    }

    /// At one point, for each solution: the displacement less that of `vertex`, and the vector whose divergence is
    /// lambda div u.
    struct Value {
        Eigen::Matrix3Xd displacement, dilatation;
    };
    using Values = std::array<Value, kStencil>;
    Values operator()(const std::array<Eigen::Vector3d, kStencil>& points, int vertex) {
        Values values;
        for (Value& value : values) value.displacement = value.dilatation = Eigen::Matrix3Xd::Zero(3, n_solutions_);
        for (int first = 0; first < kStencil; first += kernels_.lanes) {
            for (int lane = 0; lane < kernels_.lanes; ++lane) {
                const Eigen::Vector3d& x = points[static_cast<std::size_t>(first + lane)];
                lanes_.x[lane] = x[0], lanes_.y[lane] = x[1], lanes_.z[lane] = x[2];
                lanes_.own_triangle[lane] = -1;
            }
            for (Sum& sum : sums_) sum = {};
            add_single_layer(points[0]);
            subtract_double_layer(points[0], vertex);
            for (int lane = 0; lane < kernels_.lanes; ++lane) {
                Value& value = values[static_cast<std::size_t>(first + lane)];
                for (Eigen::Index c = 0; c < n_solutions_; ++c)
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        const Sum& sum = sums_[static_cast<std::size_t>(c)];
                        value.displacement(static_cast<Eigen::Index>(axis), c) = sum.displacement[axis][lane];
                        value.dilatation(static_cast<Eigen::Index>(axis), c) = dilatation_ * sum.potential[axis][lane];
                    }
            }
        }
        return values;
    }

private:
    struct Sum {
        std::array<Lanes, 3> displacement{Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
        std::array<Lanes, 3> potential{Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
    };

    std::size_t slot_size() const { return static_cast<std::size_t>(kDoubleLayerNumbers * kernels_.lanes); }
    /// The same rule for all points of a stencil: its error has no jump that a difference would show.
    const GaussRule* rule_for(const TriangleGeometry& triangle, const Eigen::Vector3d& x) const {
        return far_field_.rule((vector(triangle.centroid) - x).norm() / triangle.longest_edge);
    }
    Lanes number(const double* block, int k) const {
        if (kernels_.lanes == kMaxLanes) return Eigen::Map<const Lanes>(block + k * kMaxLanes);
        Lanes values = Lanes::Zero();
        for (int lane = 0; lane < kernels_.lanes; ++lane) values[lane] = block[k * kernels_.lanes + lane];
        return values;
    }

    void add_single_layer(const Eigen::Vector3d& x) {
        std::array<std::array<double, static_cast<std::size_t>(kSingleLayerNumbers * kMaxLanes)>, 3> blocks;
        for (const SurfaceTractions::Loaded& loaded : field_.tractions_.triangles()) {
            for (auto& block : blocks) block.fill(0.0);
            double* const out[3] = {blocks[0].data(), blocks[1].data(), blocks[2].data()};
            const TriangleGeometry& triangle = field_.boundary_->triangle(loaded.triangle);
            kernels_.single_layer_linear(triangle, lanes_, rule_for(triangle, x), out);
            for (std::size_t corner = 0; corner < 3; ++corner)
                add_block(out[corner], 1, single_scalar_, single_tensor_,
                          loaded.corners.middleRows<3>(3 * static_cast<Eigen::Index>(corner)), 1.0, 1.0);
        }
    }

    void subtract_double_layer(const Eigen::Vector3d& x, int vertex) {
        const SurfaceMesh& mesh = field_.boundary_->mesh();
        std::fill(layer_.begin(), layer_.end(), 0.0);
        for (int t = 0; t < mesh.n_triangles(); ++t) {
            const TriangleGeometry& triangle = field_.boundary_->triangle(t);
            double* out[3];
            for (int corner = 0; corner < 3; ++corner)
                out[corner] = layer_.data() + slot_size() * static_cast<std::size_t>(mesh.triangles(corner, t));
            kernels_.double_layer_linear(triangle, lanes_, rule_for(triangle, x), out);
        }
        // The double layer returns a translation as it is: with that of a nearby vertex taken off, the rules have less
        // to err on.
        const Eigen::Matrix3Xd there = field_.displacements_.middleRows<3>(3 * vertex);
        Eigen::Matrix3Xd u(3, n_solutions_);
        const double twice_mu = 2.0 * Material{1.0, field_.poisson_ratio_}.shear_modulus();
        for (int v = 0; v < mesh.n_vertices(); ++v) {
            u = field_.displacements_.middleRows<3>(3 * v) - there;
            add_block(layer_.data() + slot_size() * static_cast<std::size_t>(v), 4, double_scalar_, double_tensor_, u,
                      -1.0, twice_mu);
        }
    }

    /// displacement += sign * (scalar (a I - [c]) + tensor S) * values; `tensor_at`: where S begins, 1 where there is
    /// no c. potential += share * a * values.
    template <class Vectors>
    void add_block(const double* block, int tensor_at, double scalar, double tensor, const Vectors& values, double sign,
                   double share) {
        const Lanes potential = share * number(block, 0);
        const Lanes a = sign * scalar * number(block, 0);
        std::array<Lanes, 6> S;
        for (int k = 0; k < 6; ++k) S[static_cast<std::size_t>(k)] = sign * tensor * number(block, tensor_at + k);
        std::array<Lanes, 3> c{Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
        if (tensor_at == 4)
            for (int k = 0; k < 3; ++k) c[static_cast<std::size_t>(k)] = sign * scalar * number(block, 1 + k);
        for (Eigen::Index m = 0; m < n_solutions_; ++m) {
            const double x = values(0, m), y = values(1, m), z = values(2, m);
            std::array<Lanes, 3>& sum = sums_[static_cast<std::size_t>(m)].displacement;
            sum[0] += (a + S[0]) * x + (S[3] - c[2]) * y + (S[4] + c[1]) * z;
            sum[1] += (S[3] + c[2]) * x + (a + S[1]) * y + (S[5] - c[0]) * z;
            sum[2] += (S[4] - c[1]) * x + (S[5] + c[0]) * y + (a + S[2]) * z;
            std::array<Lanes, 3>& vector = sums_[static_cast<std::size_t>(m)].potential;
            vector[0] += potential * x;
            vector[1] += potential * y;
            vector[2] += potential * z;
        }
    }

    const BoundaryField& field_;
    Eigen::Index n_solutions_;
    double single_tensor_, single_scalar_, double_tensor_, double_scalar_, dilatation_;
    const TriangleKernels& kernels_ = best_triangle_kernels();
    const FarField far_field_{kFieldTolerance};
    SourceLanes lanes_{};
    std::vector<double> layer_;  ///< [vertex][number][lane]
    std::vector<Sum> sums_;      ///< of each solution
};

namespace {

std::array<Eigen::Vector3d, kStencil> stencil(const Eigen::Vector3d& x, double step) {
    std::array<Eigen::Vector3d, kStencil> points;
    points.fill(x);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        points[1 + 2 * axis][static_cast<Eigen::Index>(axis)] += step;
        points[2 + 2 * axis][static_cast<Eigen::Index>(axis)] -= step;
    }
    return points;
}

}  // namespace

InteriorValues BoundaryField::at(const Positions& points, Control& control) const {
    const Eigen::Index m = displacements_.cols();
    const double mu = Material{1.0, poisson_ratio_}.shear_modulus();
    InteriorValues values{Eigen::MatrixXd(3 * points.cols(), m), Eigen::MatrixXd(6 * points.cols(), m)};
    parallel_blocks(static_cast<int>(points.cols()), 4, control, [&](int begin, int end) {
        PointIntegrator integrate(*this);
        for (int i = begin; i < end; ++i) {
            if (control.cancelled()) return;
            const Place place = place_of(points.col(i));
            const double step = kStep * place.distance;
            const auto at_stencil = integrate(stencil(place.x, step), place.vertex);
            for (Eigen::Index c = 0; c < m; ++c) {
                Eigen::Matrix3d gradient;
                double dilatation = 0.0;  // lambda div u
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const auto &forward = at_stencil[1 + 2 * axis], &back = at_stencil[2 + 2 * axis];
                    const auto k = static_cast<Eigen::Index>(axis);
                    gradient.col(k) = (forward.displacement.col(c) - back.displacement.col(c)) / (2.0 * step);
                    dilatation += (forward.dilatation(k, c) - back.dilatation(k, c)) / (2.0 * step);
                }
                values.displacements.col(c).segment<3>(3 * i) = displacements_.col(c).segment<3>(3 * place.vertex) +
                                                                at_stencil[0].displacement.col(c) +
                                                                gradient * (points.col(i) - place.x);
                const Eigen::Matrix3d without = mu * (gradient + gradient.transpose());
                values.stresses.col(c).segment<6>(6 * i) =
                    stress_numbers(without + dilatation * Eigen::Matrix3d::Identity());
            }
        }
    });
    return values;
}

}  // namespace elastolab
