#include "deform/triangle_tractions.hpp"

#include <cmath>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <functional>
#include <numbers>
#include <optional>
#include <span>

#include "elasticity/neo_hookean.hpp"
#include "elasticity/stress.hpp"

namespace elastolab {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// What a vertex knows of the triangles around it that have a traction.
struct Around {
    std::vector<const TriangleStrain*> triangles;
    double area = 0.0;
    Vector3d normal = Vector3d::Zero();    ///< mean of theirs, by area
    Vector3d traction = Vector3d::Zero();  ///< of Young's modulus 1

    /// What all of them have, as they are in one plane.
    bool flat() const { return normal.squaredNorm() > 1.0 - 1e-12; }
};

/// Traction on a face of this normal, at a vertex.
using TractionOn = std::function<Vector3d(const Vector3d& normal)>;

/// The solution of normal equations; nothing where they do not determine it.
template <int n>
std::optional<Eigen::Matrix<double, n, 1>> solved(const Eigen::Matrix<double, n, n>& A,
                                                  const Eigen::Matrix<double, n, 1>& b) {
    constexpr double kLeastPivot = 1e-6;  // two opposite faces say nothing of what presses on them
    const Eigen::LDLT<Eigen::Matrix<double, n, n>> factor(A);
    const auto pivots = factor.vectorD();
    if (!(pivots.minCoeff() > kLeastPivot * pivots.maxCoeff())) return {};
    return factor.solve(b).eval();
}

/// Hooke's stress s, six numbers: strains within each plane, and s times the mean normal. Young's modulus is 1.
std::optional<TractionOn> of_small(const Around& at, double nu) {
    Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
    StressNumbers b = StressNumbers::Zero();
    const auto add = [&](const StressNumbers& row, double value, double weight) {
        A += weight * row * row.transpose();
        b += weight * value * row;
    };
    for (const TriangleStrain* triangle : at.triangles) {
        const Eigen::Matrix2d strain = triangle->small();
        for (int i = 0; i < 2; ++i)
            for (int j = i; j < 2; ++j) {
                StressNumbers row;
                for (int k = 0; k < 6; ++k) {
                    const Matrix3d unit = stress_tensor(StressNumbers::Unit(k));
                    row[k] = (1.0 + nu) * triangle->axes.col(i).dot(unit * triangle->axes.col(j)) -
                             (i == j ? nu * unit.trace() : 0.0);
                }
                add(row, strain(i, j), (i == j ? 1.0 : 2.0) * triangle->area / at.area);
            }
    }
    for (int i = 0; i < 3; ++i) {
        StressNumbers row;
        for (int k = 0; k < 6; ++k) row[k] = (stress_tensor(StressNumbers::Unit(k)) * at.normal)[i];
        add(row, at.traction[i], 1.0);
    }
    const std::optional<StressNumbers> stress = solved<6>(A, b);
    if (!stress) return {};
    return [sigma = stress_tensor(*stress)](const Vector3d& normal) -> Vector3d { return sigma * normal; };
}

using Gradient = Eigen::Matrix<double, 9, 1>;  ///< du / dX, column by column

/// Fits the displacement's gradient at a vertex to that within the plane of each triangle and, through Neo-Hooke's law,
/// to the traction on the mean normal. Young's modulus is 1.
class GradientFit {
public:
    GradientFit(const Around& at, double nu) : at_(at), law_({1.0, nu}) {}

    /// Within the triangles as they are; across them, as much as keeps the volume. Nothing where a triangle has become
    /// a line.
    std::optional<Gradient> first() const {
        Matrix3d mean = Matrix3d::Zero();
        for (const TriangleStrain* t : at_.triangles) {
            const Eigen::Matrix<double, 3, 2> edges = t->axes.leftCols<2>() + t->gradient;
            const Vector3d cross = edges.col(0).cross(edges.col(1));
            if (!(cross.norm() > 0.0)) return {};
            const Vector3d across = cross / cross.squaredNorm() - t->axes.col(2);
            mean +=
                weight(*t) * (t->gradient * t->axes.leftCols<2>().transpose() + across * t->axes.col(2).transpose());
        }
        return mean.reshaped();
    }

    /// By Gauss and Newton, from a gradient that inverts nothing; nothing where the equations do not determine it.
    std::optional<Gradient> from(Gradient g) const {
        constexpr int kIterations = 30;
        constexpr double kTolerance = 1e-10;
        for (int i = 0; i < kIterations; ++i) {
            std::optional<Gradient> step = step_from(g);
            if (!step) return {};
            if (!shorten(*step, g)) break;  // as good as it gets
            g += *step;
            if (step->norm() <= kTolerance * (1.0 + g.norm())) break;
        }
        return g;
    }

    static bool inverts(const Gradient& g) { return !(volume_change(matrix(g)) > -1.0); }
    Matrix3d first_piola(const Gradient& g) const { return law_.first_piola(matrix(g)); }

private:
    static Matrix3d matrix(const Gradient& g) { return g.reshaped(3, 3); }
    double weight(const TriangleStrain& triangle) const { return triangle.area / at_.area; }
    Vector3d off_traction(const Gradient& g) const { return first_piola(g) * at_.normal - at_.traction; }

    double squares(const Gradient& g) const {
        double sum = off_traction(g).squaredNorm();
        for (const TriangleStrain* t : at_.triangles)
            sum += weight(*t) * law_.mu * law_.mu * (matrix(g) * t->axes.leftCols<2>() - t->gradient).squaredNorm();
        return sum;
    }

    std::optional<Gradient> step_from(const Gradient& g) const {
        Eigen::Matrix<double, 9, 9> A = Eigen::Matrix<double, 9, 9>::Zero();
        Gradient b = Gradient::Zero();
        for (const TriangleStrain* t : at_.triangles)
            for (int j = 0; j < 2; ++j) {
                const Vector3d axis = t->axes.col(j);
                const Vector3d off = matrix(g) * axis - t->gradient.col(j);
                for (int l = 0; l < 3; ++l) {
                    b.segment<3>(3 * l) -= weight(*t) * axis[l] * off;
                    for (int m = 0; m < 3; ++m)
                        A.block<3, 3>(3 * l, 3 * m).diagonal().array() += weight(*t) * axis[l] * axis[m];
                }
            }
        const ElasticTensor tangent = law_.tangent(matrix(g));
        Eigen::Matrix<double, 3, 9> change = Eigen::Matrix<double, 3, 9>::Zero();
        for (int l = 0; l < 3; ++l)
            for (int j = 0; j < 3; ++j)
                change.middleCols<3>(3 * l) += at_.normal[j] * tangent.block<3, 3>(3 * j, 3 * l);
        A += change.transpose() * change;
        b -= change.transpose() * off_traction(g);
        return solved<9>(A, b);
    }

    /// Halves the step until it makes nothing worse; whether it could be.
    bool shorten(Gradient& step, const Gradient& g) const {
        constexpr int kHalvings = 20;
        const double before = squares(g);
        const auto is_worse = [&] { return inverts(g + step) || !(squares(g + step) <= before); };
        int halvings = 0;
        while (is_worse() && halvings++ < kHalvings) step *= 0.5;
        return halvings <= kHalvings;
    }

    const Around& at_;
    const NeoHookean law_;
};

std::optional<TractionOn> of_large(const Around& at, double nu) {
    const GradientFit fit(at, nu);
    std::optional<Gradient> gradient = fit.first();
    if (!gradient || GradientFit::inverts(*gradient)) return {};
    gradient = fit.from(*gradient);
    if (!gradient) return {};
    return [P = fit.first_piola(*gradient)](const Vector3d& normal) -> Vector3d { return P * normal; };
}

}  // namespace

TriangleStrain::TriangleStrain(const SurfaceMesh& surface, Eigen::Index triangle,
                               const Eigen::Ref<const Eigen::Matrix3Xd>& u) {
    const Eigen::Vector3i t = surface.triangles.col(triangle);
    Eigen::Matrix<double, 3, 2> edges, changes;
    for (int i = 0; i < 2; ++i) {
        edges.col(i) = surface.vertices.col(t[i + 1]) - surface.vertices.col(t[0]);
        changes.col(i) = u.col(t[i + 1]) - u.col(t[0]);
    }
    const Vector3d cross = edges.col(0).cross(edges.col(1));
    area = 0.5 * cross.norm();
    axes.col(0) = edges.col(0).normalized();
    axes.col(2) = cross.normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    gradient = changes * (axes.leftCols<2>().transpose() * edges).inverse();
}

Eigen::Matrix2d TriangleStrain::small() const {
    const Eigen::Matrix2d within = axes.leftCols<2>().transpose() * gradient;
    return 0.5 * (within + within.transpose());
}

std::vector<TriangleStrain> triangle_strains(const SurfaceMesh& surface, const Eigen::Ref<const Eigen::Matrix3Xd>& u) {
    std::vector<TriangleStrain> strains;
    strains.reserve(static_cast<std::size_t>(surface.n_triangles()));
    for (Eigen::Index k = 0; k < surface.n_triangles(); ++k) strains.emplace_back(surface, k, u);
    return strains;
}

Eigen::Matrix3Xd triangle_tractions(const SurfaceMesh& surface, const Material& material,
                                    const std::vector<TriangleStrain>& strains, const Eigen::Matrix3Xd& tractions,
                                    bool large_deformations) {
    std::vector<Around> around(static_cast<std::size_t>(surface.n_vertices()));
    std::vector<int> loaded;
    for (int k = 0; k < surface.n_triangles(); ++k) {
        const Eigen::Vector3i corners = surface.triangles.col(k);
        // Squares may underflow.
        if (!(tractions(Eigen::all, corners).array().abs() > 0.0).colwise().any().all()) continue;
        loaded.push_back(k);
        const TriangleStrain& strain = strains[static_cast<std::size_t>(k)];
        for (const int v : corners) {
            Around& at = around[static_cast<std::size_t>(v)];
            at.triangles.push_back(&strain);
            at.area += strain.area;
            at.normal += strain.area * strain.axes.col(2);
        }
    }
    const double E = material.young_modulus, nu = material.poisson_ratio;
    std::vector<std::optional<TractionOn>> stresses(around.size());
    for (std::size_t v = 0; v < around.size(); ++v) {
        Around& at = around[v];
        if (!(at.area > 0.0)) continue;
        at.normal /= at.area;
        at.traction = tractions.col(static_cast<Eigen::Index>(v)) / E;
        if (!at.flat()) stresses[v] = large_deformations ? of_large(at, nu) : of_small(at, nu);
    }
    Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, surface.n_triangles());
    for (const int k : loaded)
        for (const int v : surface.triangles.col(k)) {
            const std::optional<TractionOn>& on = stresses[static_cast<std::size_t>(v)];
            const Vector3d normal = strains[static_cast<std::size_t>(k)].axes.col(2);
            result.col(k) += (on ? Vector3d(E * (*on)(normal)) : Vector3d(tractions.col(v))) / 3.0;
        }
    return result;
}

}  // namespace elastolab
