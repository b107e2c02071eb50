#include "bem/given_loads.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"
#include "bem/assembly.hpp"
#include "bem/source_strips.hpp"
#include "elasticity/rigid_motion.hpp"

namespace elastolab {

namespace {

/// Numbers of a strip of the single layer that are held at once.
constexpr int kGivenNumbers = 8'000'000;
/// Vertices and triangles of a block of the double layer.
constexpr int kGivenVertices = 64, kGivenTriangles = 256;

/// The tractions of some loads: shape functions on the loaded triangles, and coefficients of each load.
struct Given {
    Elements elements;
    Eigen::MatrixXd coefficients;  ///< 3*elements.n_slots x n_loads
};

Given constant_tractions(std::span<const UnitLoad> loads) {
    std::vector<int> triangles;
    for (const UnitLoad& load : loads) triangles.insert(triangles.end(), load.triangles.begin(), load.triangles.end());
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    Given given{constant_elements(triangles), Eigen::MatrixXd::Zero(3 * std::ssize(triangles), std::ssize(loads))};
    for (std::size_t i = 0; i < loads.size(); ++i)
        for (std::size_t k = 0; k < loads[i].triangles.size(); ++k) {
            const auto slot =
                std::lower_bound(triangles.begin(), triangles.end(), loads[i].triangles[k]) - triangles.begin();
            given.coefficients.block<3, 1>(3 * slot, static_cast<Eigen::Index>(i)) +=
                loads[i].tractions.col(static_cast<Eigen::Index>(k));
        }
    return given;
}

/// (b . x) n, linear on every triangle.
Given tractions_of_body_forces(const Boundary& boundary, std::span<const UnitLoad> loads) {
    const SurfaceMesh& mesh = boundary.mesh();
    const BodyForceField field(mesh, 0.0);
    Given given;
    given.elements.order = Elements::Order::linear;
    given.elements.n_slots = 3 * boundary.n_triangles();
    given.coefficients.setZero(3 * given.elements.n_slots, std::ssize(loads));
    for (int t = 0; t < boundary.n_triangles(); ++t) {
        given.elements.elements.push_back({t, {3 * t, 3 * t + 1, 3 * t + 2}});
        const Eigen::Vector3d normal = Eigen::Map<const Eigen::Vector3d>(boundary.triangle(t).n);
        for (int corner = 0; corner < 3; ++corner)
            for (std::size_t i = 0; i < loads.size(); ++i)
                given.coefficients.block<3, 1>(3 * (3 * t + corner), static_cast<Eigen::Index>(i)) =
                    field.potential(mesh.vertices.col(mesh.triangles(corner, t)), loads[i].body_force) * normal;
    }
    return given;
}

/// Calls use(given, columns) for the body forces among the loads and for the others.
template <class Use>
void for_kinds(const Boundary& boundary, std::span<const UnitLoad> loads, const Use& use) {
    for (const bool body : {true, false}) {
        std::vector<UnitLoad> some;
        std::vector<Eigen::Index> columns;
        for (std::size_t i = 0; i < loads.size(); ++i)
            if (loads[i].is_body_force() == body) {
                some.push_back(loads[i]);
                columns.push_back(static_cast<Eigen::Index>(i));
            }
        if (!some.empty()) use(body ? tractions_of_body_forces(boundary, some) : constant_tractions(some), columns);
    }
}

/// The loaded triangles and, for each load, the mean traction on each of them: 3*triangles.size() x n_loads.
struct MeanTractions {
    std::vector<int> triangles;
    Eigen::MatrixXd values;

    MeanTractions(const Boundary& boundary, std::span<const UnitLoad> loads) {
        for_kinds(boundary, loads, [&](const Given& given, const auto&) {
            for (const auto& element : given.elements.elements) triangles.push_back(element.triangle);
        });
        std::sort(triangles.begin(), triangles.end());
        triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
        std::vector<int> place(static_cast<std::size_t>(boundary.n_triangles()), -1);
        for (std::size_t i = 0; i < triangles.size(); ++i)
            place[static_cast<std::size_t>(triangles[i])] = static_cast<int>(i);
        values.setZero(3 * std::ssize(triangles), std::ssize(loads));
        for_kinds(boundary, loads, [&](const Given& given, const std::vector<Eigen::Index>& columns) {
            const int n_corners = given.elements.order == Elements::Order::linear ? 3 : 1;
            for (const auto& element : given.elements.elements)
                for (int corner = 0; corner < n_corners; ++corner)
                    for (std::size_t c = 0; c < columns.size(); ++c)
                        values.block<3, 1>(3 * place[static_cast<std::size_t>(element.triangle)], columns[c]) +=
                            given.coefficients.block<3, 1>(3 * element.slots[static_cast<std::size_t>(corner)],
                                                           static_cast<Eigen::Index>(c)) /
                            n_corners;
        });
    }
};

/// B^T g, exactly: int phi_a g over each triangle.
Eigen::MatrixXd tested_with_hats(const Boundary& boundary, std::span<const UnitLoad> loads) {
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(boundary.mesh().vertices.size(), std::ssize(loads));
    for_kinds(boundary, loads, [&](const Given& given, const std::vector<Eigen::Index>& columns) {
        const bool linear = given.elements.order == Elements::Order::linear;
        for (const auto& element : given.elements.elements)
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t b = 0; b < (linear ? 3u : 1u); ++b) {
                    const double weight =
                        boundary.area(element.triangle) * (!linear ? 1.0 / 3.0 : (a == b ? 2.0 : 1.0) / 12.0);
                    const int v = boundary.mesh().triangles(static_cast<Eigen::Index>(a), element.triangle);
                    for (std::size_t c = 0; c < columns.size(); ++c)
                        f.block<3, 1>(3 * v, columns[c]) +=
                            weight * given.coefficients.block<3, 1>(3 * element.slots[b], static_cast<Eigen::Index>(c));
                }
    });
    return f;
}

/// K^T g for tractions constant on some triangles; rows node-major.
Eigen::MatrixXd transposed_double_layer(const std::shared_ptr<const BoundaryPairs>& pairs, const Material& material,
                                        const MeanTractions& given, Control& control) {
    const auto vertex_tree = pairs->cluster_vertices(kGivenVertices);
    const auto triangle_tree = pairs->cluster_triangles(given.triangles, kGivenTriangles);
    const DoubleLayerEntries K(pairs, given.triangles, *triangle_tree, vertex_tree, material);
    const int n_vertices = vertex_tree->size(), n_triangles = static_cast<int>(given.triangles.size());
    Eigen::MatrixXd ordered(given.values.rows(), given.values.cols()), f(3 * n_vertices, given.values.cols());
    for (int i = 0; i < n_triangles; ++i)
        ordered.middleRows<3>(3 * i) =
            given.values.middleRows<3>(3 * triangle_tree->order()[static_cast<std::size_t>(i)]);
    parallel_blocks(n_vertices, kGivenVertices, control, [&](int begin, int end) {
        Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * (end - begin), ordered.cols()), block;
        for (int first = 0; first < n_triangles; first += kGivenTriangles) {
            const int last = std::min(n_triangles, first + kGivenTriangles);
            block.resize(3 * (last - first), 3 * (end - begin));
            K.fill({first, last}, {begin, end}, block);
            sum.noalias() += block.transpose() * ordered.middleRows(3 * first, 3 * (last - first));
        }
        for (int i = begin; i < end; ++i)
            f.middleRows<3>(3 * vertex_tree->order()[static_cast<std::size_t>(i)]) = sum.middleRows<3>(3 * (i - begin));
    });
    return f;
}

/// u_h's inside with u_p and sigma_p on top.
class WithBodyForces : public InteriorField {
public:
    WithBodyForces(std::shared_ptr<const InteriorField> field, BodyForceField particular, Eigen::Matrix3Xd body_forces)
        : field_(std::move(field)), particular_(particular), body_forces_(std::move(body_forces)) {}

    InteriorValues at(const Positions& points, Control& control) const override {
        InteriorValues values = field_->at(points, control);
        for (Eigen::Index c = 0; c < body_forces_.cols(); ++c)
            for (Eigen::Index i = 0; i < points.cols(); ++i) {
                const Eigen::Vector3d x = points.col(i), b = body_forces_.col(c);
                values.displacements.col(c).segment<3>(3 * i) += particular_.displacement(x, b);
                values.stresses.col(c).segment<3>(6 * i).array() -= particular_.potential(x, b);
            }
        return values;
    }

private:
    std::shared_ptr<const InteriorField> field_;
    BodyForceField particular_;
    Eigen::Matrix3Xd body_forces_;  ///< of each solution
};

bool has_body_force(std::span<const UnitLoad> loads) {
    return std::any_of(loads.begin(), loads.end(), [](const UnitLoad& load) { return load.is_body_force(); });
}

}  // namespace

BodyForceField::BodyForceField(const SurfaceMesh& mesh, double nu)
    : middle(mesh.vertices.rowwise().mean()), poisson_ratio(nu) {}

Eigen::Vector3d BodyForceField::displacement(const Eigen::Vector3d& at, const Eigen::Vector3d& b) const {
    const Eigen::Vector3d x = at - middle;
    return -(1.0 - 2.0 * poisson_ratio) * (b.dot(x) * x - 0.5 * x.squaredNorm() * b);
}

double BodyForceField::potential(const Eigen::Vector3d& at, const Eigen::Vector3d& b) const {
    return b.dot(at - middle);
}

ParticularField particular_field(const SurfaceMesh& mesh, double poisson_ratio, const Positions& prescribed,
                                 std::span<const UnitLoad> loads) {
    if (!has_body_force(loads) || poisson_ratio == 0.5) return {};
    const BodyForceField field(mesh, poisson_ratio);
    const auto at = [&](const Positions& points) {
        Eigen::MatrixXd u = Eigen::MatrixXd::Zero(points.size(), std::ssize(loads));
        for (std::size_t i = 0; i < loads.size(); ++i)
            for (Eigen::Index k = 0; k < points.cols() && loads[i].is_body_force(); ++k)
                u.col(static_cast<Eigen::Index>(i)).segment<3>(3 * k) =
                    field.displacement(points.col(k), loads[i].body_force);
        return u;
    };
    return {at(prescribed), at(mesh.vertices)};
}

Eigen::MatrixXd given_single_layer(const Boundary& boundary, const Sources& sources, const Material& material,
                                   double tolerance, std::span<const UnitLoad> loads, Control& control) {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * sources.size(), std::ssize(loads));
    for_kinds(boundary, loads, [&](const Given& given, const std::vector<Eigen::Index>& columns) {
        const int at_once = std::clamp(kGivenNumbers / (9 * given.elements.n_slots), 8, kSourcesAtOnce);
        for_source_strips(
            sources,
            [&](int first, const Sources& strip) {
                Eigen::MatrixXd G(3 * strip.size(), 3 * given.elements.n_slots);
                assemble(Layer::single_layer, boundary, strip, given.elements, material, tolerance, G, control);
                const Eigen::MatrixXd seen = G * given.coefficients;
                for (std::size_t c = 0; c < columns.size(); ++c)
                    result.col(columns[c]).segment(3 * first, G.rows()) = seen.col(static_cast<Eigen::Index>(c));
            },
            at_once);
    });
    return result;
}

Eigen::MatrixXd given_nodal_forces(const std::shared_ptr<const BoundaryPairs>& pairs, const Material& material,
                                   std::span<const UnitLoad> loads, Control& control) {
    const Boundary& boundary = pairs->boundary();
    Eigen::MatrixXd f = tested_with_hats(boundary, loads);
    if (loads.empty()) return f;
    // K is freed of the rigid motions of the body, as in the equations.
    Eigen::MatrixXd layer = transposed_double_layer(pairs, material, MeanTractions(boundary, loads), control);
    const Eigen::MatrixXd modes = rigid_modes(boundary.mesh().vertices);
    layer -= modes * (modes.transpose() * layer).eval();
    return f - layer;
}

Eigen::MatrixXd given_single_layer(const std::shared_ptr<const BoundaryPairs>& pairs, const ClosedSurfaces& surfaces,
                                   const GalerkinTractions& tractions, const Material& material,
                                   std::span<const UnitLoad> loads, Control& control) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(tractions.size(), std::ssize(loads));
    if (loads.empty() || tractions.size() == 0) return rows;
    const MeanTractions given(pairs->boundary(), loads);
    std::vector<int> tests = tractions.triangles;
    for (const int s : tractions.free_surfaces) {
        const std::vector<int>& all = surfaces.triangles[static_cast<std::size_t>(s)];
        tests.insert(tests.end(), all.begin(), all.end());
    }
    const SingleLayerEntries V(pairs, tests, given.triangles, material);
    const int n_given = static_cast<int>(given.triangles.size());
    Eigen::MatrixXd all(3 * std::ssize(tests), rows.cols());
    parallel_blocks(static_cast<int>(tests.size()), 32, control, [&](int begin, int end) {
        Eigen::MatrixXd block(3 * (end - begin), 3 * n_given);
        V.fill({begin, end}, {0, n_given}, block);
        all.middleRows(3 * begin, block.rows()).noalias() = block * given.values;
    });
    const Eigen::Index n_single = 3 * std::ssize(tractions.triangles);
    rows.topRows(n_single) = all.topRows(n_single);
    Eigen::Index from = n_single, to = n_single;
    for (const int s : tractions.free_surfaces) {
        const Eigen::MatrixXd fields =
            rigid_tractions(pairs->boundary(), surfaces.triangles[static_cast<std::size_t>(s)]);
        rows.middleRows(to, 6) = fields.transpose() * all.middleRows(from, fields.rows());
        from += fields.rows();
        to += 6;
    }
    return rows;
}

void add_given(const Boundary& boundary, std::span<const UnitLoad> loads, const Eigen::MatrixXd& factors,
               SurfaceTractions& tractions) {
    for_kinds(boundary, loads, [&](const Given& given, const std::vector<Eigen::Index>& columns) {
        tractions.add(given.elements, given.coefficients * factors(columns, Eigen::all));
    });
}

std::shared_ptr<const InteriorField> with_body_forces(std::shared_ptr<const InteriorField> field,
                                                      const SurfaceMesh& mesh, double poisson_ratio,
                                                      std::span<const UnitLoad> loads, const Eigen::MatrixXd& factors) {
    if (!has_body_force(loads)) return field;
    Eigen::Matrix3Xd body_forces = Eigen::Matrix3Xd::Zero(3, factors.cols());
    for (std::size_t i = 0; i < loads.size(); ++i)
        if (loads[i].is_body_force()) body_forces += loads[i].body_force * factors.row(static_cast<Eigen::Index>(i));
    return std::make_shared<const WithBodyForces>(std::move(field), BodyForceField(mesh, poisson_ratio),
                                                  std::move(body_forces));
}

}  // namespace elastolab
