#include "study/paper/paper_picture.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

#include "base/text.hpp"
#include "elasticity/exact_fields.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

constexpr double kStretch = 0.4;
constexpr double kOnFace = 1e-9;

/// On how many faces of the unit cube a point lies.
int n_faces(const Eigen::Vector3d& x) {
    int n = 0;
    for (const double coordinate : x) n += coordinate < kOnFace || coordinate > 1.0 - kOnFace ? 1 : 0;
    return n;
}

/// Orthographic view: rows are right, up and towards the eye.
Eigen::Matrix3d view() {
    const Eigen::Vector3d eye = Eigen::Vector3d(1.0, -1.6, 1.0).normalized();
    const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(eye).normalized();
    Eigen::Matrix3d rows;
    rows << right.transpose(), eye.cross(right).transpose(), eye.transpose();
    return rows;
}

struct Polygon {
    double depth, light;
    Eigen::Matrix<double, 2, 3> corners;
};

/// Triangles that face the eye, the farthest first.
std::vector<Polygon> visible(const SurfaceMesh& mesh) {
    const Eigen::Matrix3Xd seen = view() * mesh.vertices;
    const Eigen::Vector3d lamp = Eigen::Vector3d(-0.15, 0.6, 0.75).normalized();
    std::vector<Polygon> polygons;
    for (const auto& t : mesh.triangles.colwise()) {
        const Eigen::Vector3d a = seen.col(t[0]), b = seen.col(t[1]), c = seen.col(t[2]);
        const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
        if (normal.z() <= 0.0) continue;
        Polygon polygon{(a + b + c).z(), std::clamp(normal.dot(lamp), 0.0, 1.0), {}};
        polygon.corners << a.head<2>(), b.head<2>(), c.head<2>();
        polygons.push_back(polygon);
    }
    std::sort(polygons.begin(), polygons.end(), [](const auto& a, const auto& b) { return a.depth < b.depth; });
    return polygons;
}

std::string object(const Polygon& p) {
    const auto shade = [&](double full) { return static_cast<int>(std::lround(full * (0.45 + 0.55 * p.light))); };
    const auto& c = p.corners;
    return formatted(
        "set object polygon from %.4f,%.4f to %.4f,%.4f to %.4f,%.4f to %.4f,%.4f fc rgb '#%02x%02x%02x' "
        "fs solid border lc rgb '#5a5a5a' lw 0.5\n",
        c(0, 0), c(1, 0), c(0, 1), c(1, 1), c(0, 2), c(1, 2), c(0, 0), c(1, 0), shade(235), shade(225), shade(200));
}

Eigen::AlignedBox2d bounds(const std::vector<Polygon>& polygons) {
    Eigen::AlignedBox2d box;
    for (const Polygon& polygon : polygons)
        for (const auto& corner : polygon.corners.colwise()) box.extend(corner);
    return box;
}

}  // namespace

EdgeArtefact edge_artefact(MethodKind kind, int cells, Control& control) {
    const SurfaceMesh mesh = make_box(cells);
    const UniaxialStretch field{{1.0, 0.3}, kStretch};
    const Eigen::VectorXd exact = displacements(field, mesh.vertices);
    const std::vector<int> ends =
        vertices_where(mesh, [](const auto& x) { return x[0] < kOnFace || x[0] > 1.0 - kOnFace; });
    Deformer deformer(precompute(study_body(mesh, field.material), {.kind = kind}, control));
    deformer.constrain({{}, ends}, control);
    const Eigen::VectorXd u = deformer.displace(values_at(exact, ends));
    EdgeArtefact artefact{text(kind), mesh, 0.0, 0.0};
    artefact.deformed.vertices += u.reshaped(3, mesh.n_vertices());
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        double& worst = n_faces(mesh.vertices.col(v)) > 1 ? artefact.on_edges : artefact.on_faces;
        worst = std::max(worst, (u - exact).segment<3>(3 * v).norm() / kStretch);
    }
    return artefact;
}

Plot edge_picture(const std::vector<EdgeArtefact>& artefacts) {
    Plot plot;
    plot.name = "fig1-edge-artefact";
    plot.title = "Fig. 1: edges of a stretched cube by constant and by linear elements";
    plot.caption = "Both cubes have their left and right faces displaced in the same way.";
    plot.body = "unset border\nunset tics\nunset key\nset size ratio -1\n";
    constexpr double kGap = 0.2;
    double right = 0.0, bottom = 0.0, top = 0.0;
    for (const EdgeArtefact& artefact : artefacts) {
        std::vector<Polygon> polygons = visible(artefact.deformed);
        const double shift = right - bounds(polygons).min().x();
        for (Polygon& polygon : polygons) {
            polygon.corners.row(0).array() += shift;
            plot.body += object(polygon);
        }
        const Eigen::AlignedBox2d box = bounds(polygons);
        plot.body += formatted("set label '%s' at %.3f,%.3f center\n", artefact.method.c_str(), box.center().x(),
                               box.min().y() - kGap);
        right = box.max().x() + kGap;
        bottom = std::min(bottom, box.min().y());
        top = std::max(top, box.max().y());
    }
    plot.body += formatted("set xrange [%.3f:%.3f]\nset yrange [%.3f:%.3f]\nplot NaN notitle\n", -0.5 * kGap,
                           right - 0.5 * kGap, bottom - 2.0 * kGap, top + 0.5 * kGap);
    return plot;
}

}  // namespace elastolab
