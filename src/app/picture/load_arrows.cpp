#include "app/picture/load_arrows.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>
#include <numbers>

#include "base/overloaded.hpp"
#include "base/text.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace {

constexpr double kShortest = 0.15, kLongest = 0.7;  ///< of an arrow, of the scene's radius
constexpr double kOfPunch = 0.2;                    ///< how much of a punch's stiffness a body is taken to have

Eigen::Vector3d scaled_normal(const Positions& x, const Eigen::Vector3i& t) {
    return (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0]));
}

Eigen::Vector3d middle_of(const Positions& x, const Eigen::Vector3i& t) {
    return (x.col(t[0]) + x.col(t[1]) + x.col(t[2])) / 3.0;
}

/// The loaded triangle nearest to the middle of all of them: it carries the arrow, also where they close a surface.
int middle_triangle(const AppliedLoad& load, const SurfaceMesh& surface) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int t : load.triangles) middle += centroid(surface, t) / static_cast<double>(load.triangles.size());
    const auto distance = [&](int t) { return (centroid(surface, t) - middle).squaredNorm(); };
    return *std::min_element(load.triangles.begin(), load.triangles.end(),
                             [&](int a, int b) { return distance(a) < distance(b); });
}

double loaded_area(const AppliedLoad& load, const SurfaceMesh& surface) {
    double area = 0.0;
    for (const int t : load.triangles) area += 0.5 * area_vector(triangle_points(surface, t)).norm();
    return area;
}

/// From what is loaded to the nearest fixed vertex, at rest.
double distance_to_support(const LiveScene& scene, const AppliedLoad& load) {
    const SurfaceMesh& surface = scene.mesh();
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int t : load.triangles) middle += centroid(surface, t) / static_cast<double>(load.triangles.size());
    double nearest = std::numeric_limits<double>::infinity();
    for (const int v : scene.vertices(LiveScene::kFixed))
        nearest = std::min(nearest, (surface.vertices.col(v) - middle).norm());
    return nearest;
}

/// A rigid round punch of this area on a half-space needs 2 E times its radius for a unit length of motion; bodies that
/// bend give way more easily.
double natural_ratio(const LiveScene& scene, const AppliedLoad& load, double radius) {
    const double E = scene.document().material.young_modulus;
    if (load.kind == AppliedLoad::Kind::gravity) {
        const double volume = std::abs(enclosed_volume(scene.mesh()));
        return kOfPunch * 2.0 * E * radius / (scene.document().density * std::max(volume, 1e-3 * std::pow(radius, 3)));
    }
    const double area = loaded_area(load, scene.mesh());
    const double punch = kOfPunch * 2.0 * E * std::sqrt(area / std::numbers::pi);
    if (load.kind != AppliedLoad::Kind::force) return punch / area;
    return std::min(punch, bending_stiffness(scene, distance_to_support(scene, load)));
}

LoadArrow arrow_of(const LiveScene& scene, const AppliedLoad& load, const Positions& positions) {
    LoadArrow arrow{.load = load.number};
    if (load.kind == AppliedLoad::Kind::gravity) {
        arrow.place = positions.rowwise().mean();
        return arrow;
    }
    const Eigen::Vector3i corners = scene.mesh().triangles.col(middle_triangle(load, scene.mesh()));
    arrow.place = middle_of(positions, corners);
    const Eigen::Vector3d normal = scaled_normal(positions, corners);
    if (normal.squaredNorm() > 0.0) arrow.normal = normal.stableNormalized();
    return arrow;
}

/// Puts the end where a load of this value has it.
void put_end(const Eigen::VectorXd& value, bool is_pressure, LoadArrow& arrow) {
    if (is_pressure) {
        arrow.inward = value[0] > 0.0;
        arrow.end = arrow.place + std::abs(value[0]) / arrow.value_per_length * arrow.normal;
    } else {
        arrow.end = arrow.place + (arrow.inward ? -1.0 : 1.0) / arrow.value_per_length * value;
    }
}

}  // namespace

double bending_stiffness(const LiveScene& scene, double distance) {
    const MeshReport& report = scene.report();
    if (!(report.volume > 0.0 && std::isfinite(distance))) return std::numeric_limits<double>::infinity();
    const double thickness = 4.0 * report.volume / report.area;
    return 0.25 * scene.document().material.young_modulus * std::pow(thickness, 4) / std::pow(distance, 3);
}

std::optional<LoadArrow> load_arrow(const LiveScene& scene, int load, const Positions& positions, double radius) {
    const AppliedLoad* applied = scene.applied_load(load);
    if (applied == nullptr) return std::nullopt;
    LoadArrow arrow = arrow_of(scene, *applied, positions);
    const Eigen::VectorXd value = load_value(scene, load);
    const double ratio = natural_ratio(scene, *applied, radius), size = value.stableNorm();
    const double length = std::clamp(size / ratio, kShortest * radius, kLongest * radius);
    arrow.value_per_length = size > 0.0 ? size / length : ratio;
    const bool is_vector = applied->kind == AppliedLoad::Kind::force || applied->kind == AppliedLoad::Kind::traction;
    if (is_vector) arrow.inward = arrow.normal.dot(value) < 0.0;
    put_end(value, applied->kind == AppliedLoad::Kind::pressure, arrow);
    return arrow;
}

std::vector<LoadArrow> load_arrows(const LiveScene& scene, const Positions& positions, double radius,
                                   const std::optional<DraggedLoad>& dragged) {
    std::vector<LoadArrow> all;
    for (const AppliedLoad& applied : scene.constraints().loads) {
        std::optional<LoadArrow> arrow = load_arrow(scene, applied.number, positions, radius);
        if (dragged && dragged->load == applied.number) {
            arrow->value_per_length = dragged->value_per_length.value_or(arrow->value_per_length);
            arrow->inward = dragged->inward;
            put_end(load_value(scene, applied.number), applied.kind == AppliedLoad::Kind::pressure, *arrow);
        }
        all.push_back(*arrow);
    }
    return all;
}

const std::vector<LoadArrow>& KeptLoadArrows::update(const LiveScene& scene, const Positions& positions,
                                                     std::uint64_t revision, double radius,
                                                     const std::optional<DraggedLoad>& dragged) {
    const Key key{scene.revision(), revision, radius, dragged};
    if (key_ == key) return arrows_;
    arrows_ = load_arrows(scene, positions, radius, dragged);
    key_ = key;
    ++n_computed_;
    return arrows_;
}

Eigen::VectorXd load_value(const LiveScene& scene, int load) {
    if (load == LiveScene::kGravity) return scene.document().gravity.value_or(Eigen::Vector3d::Zero());
    return load_factors(scene.document().loads[static_cast<std::size_t>(load)].value);
}

double load_size(const LiveScene& scene, int load) {
    const Eigen::VectorXd value = load_value(scene, load);
    return value.size() == 1 ? value[0] : value.stableNorm();
}

std::string load_text(const LiveScene& scene, int load, const UnitNames& units) {
    const std::string size = plain_number(load_size(scene, load), 4);
    if (load == LiveScene::kGravity) return "gravity " + size;
    const LoadValue& value = scene.document().loads[static_cast<std::size_t>(load)].value;
    return std::visit(
               Overloaded{[](const ForceLoad&) { return "force "; }, [](const TractionLoad&) { return "traction "; },
                          [](const PressureLoad&) { return "pressure "; }},
               value) +
           size + (std::holds_alternative<ForceLoad>(value) ? units.after_force() : units.after_stress());
}

}  // namespace elastolab
