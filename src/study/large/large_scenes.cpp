#include "study/large/large_scenes.hpp"

#include <Eigen/Geometry>
#include <memory>
#include <numbers>

#include "mesh/primitives.hpp"
#include "study/error/organic_body.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

constexpr double kLength = 4.0;
const Material kRubber{1.0, 0.3};

Eigen::VectorXd moved(const SurfaceMesh& mesh, const std::vector<int>& vertices, const Eigen::Matrix3d& R,
                      const Eigen::Vector3d& center, const Eigen::Vector3d& shift) {
    Eigen::VectorXd values(3 * std::ssize(vertices));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Eigen::Vector3d x = mesh.vertices.col(vertices[i]);
        values.segment<3>(3 * static_cast<Eigen::Index>(i)) = center + R * (x - center) + shift - x;
    }
    return values;
}

Eigen::Matrix3d turned(double degrees, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis).toRotationMatrix();
}

/// A bar of 4 x 1 x 1 along x, its left end fixed and its right end moved by `motion`.
LargeScene held_bar(int cells,
                    const std::function<Eigen::VectorXd(const SurfaceMesh&, const std::vector<int>&, double)>& motion) {
    SurfaceMesh mesh = make_box(cells, Eigen::Vector3d(kLength, 1.0, 1.0));
    LargeScene scene;
    scene.set.fixed = vertices_where(mesh, [](const auto& p) { return p[0] < 1e-9; });
    scene.set.handles = vertices_where(mesh, [](const auto& p) { return p[0] > kLength - 1e-9; });
    scene.body = study_body(std::move(mesh), kRubber, "bar");
    scene.values = [surface = scene.body.surface, handles = scene.set.handles, motion](double amount) {
        return motion(*surface, handles, amount);
    };
    return scene;
}

LargeScene twisted_bar(int cells) {
    return held_bar(cells, [](const SurfaceMesh& mesh, const std::vector<int>& end, double degrees) {
        return moved(mesh, end, turned(degrees, Eigen::Vector3d::UnitX()), {kLength, 0.5, 0.5}, {0, 0, 0});
    });
}

/// The end follows the arc of a bar of constant curvature.
LargeScene bent_bar(int cells) {
    return held_bar(cells, [](const SurfaceMesh& mesh, const std::vector<int>& end, double degrees) {
        const double angle = degrees * std::numbers::pi / 180.0, radius = kLength / angle;
        const Eigen::Vector3d shift(radius * std::sin(angle) - kLength, radius * (1.0 - std::cos(angle)), 0.0);
        return moved(mesh, end, turned(degrees, Eigen::Vector3d::UnitZ()), {kLength, 0.5, 0.5}, shift);
    });
}

LargeScene stretched_bar(int cells) {
    return held_bar(cells, [](const SurfaceMesh& mesh, const std::vector<int>& end, double per_cent) {
        return moved(mesh, end, Eigen::Matrix3d::Identity(), {0, 0, 0}, {kLength * per_cent / 100.0, 0.0, 0.0});
    });
}

LargeScene turned_ear(int cells) {
    const auto rabbit = std::make_shared<const OrganicBody>(make_rabbit(cells < 4 ? 350 : 600));
    LargeScene scene;
    scene.body = study_body(rabbit->surface, kRubber, rabbit->name);
    scene.set = {rabbit->fixed, rabbit->pull};
    scene.values = [rabbit](double degrees) {
        const Positions all = rabbit->turned_values(degrees * std::numbers::pi / 180.0);
        return Eigen::VectorXd(all.rightCols(std::ssize(rabbit->pull)).reshaped());
    };
    return scene;
}

}  // namespace

const std::vector<LargeMotion>& large_motions() {
    static const std::vector<LargeMotion> all = {{"twist", "bar twisted", "degrees", twisted_bar},
                                                 {"bend", "bar bent", "degrees", bent_bar},
                                                 {"stretch", "bar stretched", "per cent", stretched_bar},
                                                 {"ear", "ear of the rabbit turned", "degrees", turned_ear, false}};
    return all;
}

}  // namespace elastolab
