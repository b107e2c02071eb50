#include <array>
#include <Eigen/Geometry>
#include <memory>
#include <numbers>

#include "base/timer.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "study/error/organic_body.hpp"
#include "study/report/report.hpp"
#include "study/setups.hpp"
#include "study/study.hpp"

namespace elastolab {

namespace {

/// A body, what is held and pulled, and how far: degrees, or per cent of its length.
struct LargeScene {
    Body body;
    ConstrainedSet set;
    std::function<Eigen::VectorXd(double amount)> values;
};

struct LargeMotion {
    std::string name, what, unit;
    LargeScene (*make)(bool quick);
};

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
LargeScene bar(bool quick,
               const std::function<Eigen::VectorXd(const SurfaceMesh&, const std::vector<int>&, double)>& motion) {
    SurfaceMesh mesh = make_box(quick ? 2 : 4, Eigen::Vector3d(kLength, 1.0, 1.0));
    LargeScene scene;
    scene.set.base = vertices_where(mesh, [](const auto& p) { return p[0] < 1e-9; });
    scene.set.handles = vertices_where(mesh, [](const auto& p) { return p[0] > kLength - 1e-9; });
    scene.body = study_body(std::move(mesh), kRubber, "bar");
    scene.values = [surface = scene.body.surface, handles = scene.set.handles, motion](double amount) {
        return motion(*surface, handles, amount);
    };
    return scene;
}

LargeScene twisted_bar(bool quick) {
    return bar(quick, [](const SurfaceMesh& mesh, const std::vector<int>& end, double degrees) {
        return moved(mesh, end, turned(degrees, Eigen::Vector3d::UnitX()), {kLength, 0.5, 0.5}, {0, 0, 0});
    });
}

/// The end follows the arc of a bar of constant curvature.
LargeScene bent_bar(bool quick) {
    return bar(quick, [](const SurfaceMesh& mesh, const std::vector<int>& end, double degrees) {
        const double angle = degrees * std::numbers::pi / 180.0, radius = kLength / angle;
        const Eigen::Vector3d shift(radius * std::sin(angle) - kLength, radius * (1.0 - std::cos(angle)), 0.0);
        return moved(mesh, end, turned(degrees, Eigen::Vector3d::UnitZ()), {kLength, 0.5, 0.5}, shift);
    });
}

LargeScene stretched_bar(bool quick) {
    return bar(quick, [](const SurfaceMesh& mesh, const std::vector<int>& end, double per_cent) {
        return moved(mesh, end, Eigen::Matrix3d::Identity(), {0, 0, 0}, {kLength * per_cent / 100.0, 0.0, 0.0});
    });
}

LargeScene turned_ear(bool quick) {
    const auto rabbit = std::make_shared<const OrganicBody>(make_rabbit(quick ? 350 : 600));
    LargeScene scene;
    scene.body = study_body(rabbit->surface, kRubber, rabbit->name);
    scene.set = {rabbit->base, rabbit->pull};
    scene.values = [rabbit](double degrees) {
        const Positions all = rabbit->turned_values(degrees * std::numbers::pi / 180.0);
        return Eigen::VectorXd(all.rightCols(std::ssize(rabbit->pull)).reshaped());
    };
    return scene;
}

const std::vector<LargeMotion>& motions() {
    static const std::vector<LargeMotion> all = {{"twist", "bar twisted", "degrees", twisted_bar},
                                                 {"bend", "bar bent", "degrees", bent_bar},
                                                 {"stretch", "bar stretched", "per cent", stretched_bar},
                                                 {"ear", "ear of the rabbit turned", "degrees", turned_ear}};
    return all;
}

/// Volume below a surface moved by u.
double volume(const SurfaceMesh& mesh, const Eigen::VectorXd& u) {
    const Positions x = mesh.vertices + u.reshaped(3, mesh.n_vertices());
    double sum = 0.0;
    for (const auto& t : mesh.triangles.colwise()) sum += x.col(t[0]).dot(x.col(t[1]).cross(x.col(t[2]))) / 6.0;
    return sum;
}

Row measure_motion(const LargeScene& scene, double amount, Control& control) {
    Deformer deformer(precompute(scene.body, {.kind = kNonlinearFem}, control));
    deformer.constrain(scene.set, control);
    const Eigen::VectorXd values = scene.values(amount);
    const DragResponse rest = deformer.drag_response(Eigen::VectorXd::Zero(values.size()), values, control);
    const Stopwatch watch;
    const Deformer::Answer finite = deformer.answer(values, {.residual = true}, control);
    const double seconds = watch.seconds();
    const Eigen::VectorXd linear = rest.X.col(0);
    const SurfaceMesh& mesh = *scene.body.surface;
    const double whole = volume(mesh, Eigen::VectorXd::Zero(linear.size()));
    Row row = Row().set("vertices", mesh.n_vertices()).set("tetrahedra", deformer.model().facts().n_tetrahedra);
    row.set("largest_error", largest_error(linear, finite.displacements));
    row.set("rms_error", relative_error(linear, finite.displacements));
    row.set("linear_volume", volume(mesh, linear) / whole)
        .set("finite_volume", volume(mesh, finite.displacements) / whole);
    row.set("iterations", finite.facts->iterations).set("residual", *finite.residual);
    row.set("largest_stretch", finite.facts->largest_stretch).set("energy", finite.facts->energy);
    return row.set("solve_s", seconds);
}

std::string large_table(const Table& table) {
    std::vector<std::vector<std::string>> lines;
    for (const Row& row : table.rows)
        lines.push_back({row.text("what"), row.text("amount") + " " + row.text("unit"),
                         percent(row.number("largest_error")), percent(row.number("rms_error")),
                         percent(row.number("linear_volume") - 1.0), percent(row.number("finite_volume") - 1.0),
                         row.text("iterations"), duration(row.number("solve_s"))});
    return markdown_table({"motion", "by", "largest error of linear theory", "rms", "volume, linear", "volume, finite",
                           "iterations", "time"},
                          lines);
}

Conclusions conclude_large(const Table& table) {
    Conclusions conclusions;
    conclusions.findings =
        "Linear elasticity against neo-Hookean equilibrium of the same ten-node tetrahedra and constraints: what is "
        "left is the error of linear theory itself. Errors are over the largest displacement, or over the rms one. "
        "Iterations are of Newton's method from rest.\n\n" +
        large_table(table);
    Plot angle{.name = "angle", .title = "Linear theory against the angle of the motion"};
    angle.caption = "Error of linear theory over the largest displacement. Below the line it is silent.";
    angle.x_label = "angle [degrees]";
    angle.y_label = "error of linear theory";
    angle.log_x = angle.log_y = true;
    Plot stretch = angle;
    stretch.name = "stretch";
    stretch.title = "Linear theory against the stretch of a bar";
    stretch.x_label = "stretch [per cent]";
    angle.extra = stretch.extra =
        "set arrow from graph 0, first 0.02 to graph 1, first 0.02 nohead dt 2 lc rgb '#888888'";
    int color = 0;
    for (const LargeMotion& motion : motions()) {
        Series series{.title = motion.what, .where = {{"motion", motion.name}}, .x = "amount", .y = "largest_error"};
        series.color = color++;
        (motion.unit == "degrees" ? angle : stretch).series.push_back(series);
    }
    conclusions.plots = {angle, stretch};
    return conclusions;
}

}  // namespace

Study make_large_study(const StudyOptions& options) {
    Study study;
    study.name = "large";
    study.title = "How far linear theory is off as motions grow";
    study.columns = {"motion",          "amount",    "unit",          "what",          "vertices",   "tetrahedra",
                     "largest_error",   "rms_error", "linear_volume", "finite_volume", "iterations", "residual",
                     "largest_stretch", "energy",    "solve_s"};
    const std::vector<int> angles =
        options.quick ? std::vector{5, 20, 60, 90} : std::vector{1, 2, 5, 10, 20, 30, 45, 60, 90, 120};
    const std::vector<int> stretches = options.quick ? std::vector{5, 50} : std::vector{1, 2, 5, 10, 20, 50, 100, 200};
    for (const LargeMotion& motion : motions())
        for (const int amount : motion.unit == "degrees" ? angles : stretches) {
            const Row id = Row().set("motion", motion.name).set("amount", amount);
            study.cases.push_back({id, 1.0, [motion, amount, quick = options.quick](Control& control) {
                                       Row row = measure_motion(motion.make(quick), amount, control);
                                       row.set("unit", motion.unit).set("what", motion.what);
                                       return std::vector<Row>{row};
                                   }});
        }
    study.conclude = [](const Table& table, Control&) { return conclude_large(table); };
    return study;
}

}  // namespace elastolab
