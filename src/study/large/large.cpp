#include "base/timer.hpp"
#include "fem/nonlinear/method.hpp"
#include "methods/precompute.hpp"
#include "study/large/large_refinement.hpp"
#include "study/large/large_scenes.hpp"
#include "study/report/report.hpp"
#include "study/setups.hpp"
#include "study/study.hpp"

namespace elastolab {

namespace {

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
        if (row.text("part") == "theory")
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
        large_table(table) + "\n" + refinement_table(table);
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
    for (const LargeMotion& motion : large_motions()) {
        Series series{.title = motion.what,
                      .where = {{"part", "theory"}, {"motion", motion.name}},
                      .x = "amount",
                      .y = "largest_error"};
        series.color = color++;
        (motion.unit == "degrees" ? angle : stretch).series.push_back(series);
    }
    conclusions.plots = {angle, stretch, refinement_plot()};
    return conclusions;
}

}  // namespace

Study make_large_study(const StudyOptions& options) {
    Study study;
    study.name = "large";
    study.title = "How far linear theory is off as motions grow";
    study.columns = {"part",          "motion",          "amount",        "unit",          "what",
                     "vertices",      "tetrahedra",      "elements",      "cells",         "error",
                     "largest_error", "rms_error",       "linear_volume", "finite_volume", "iterations",
                     "residual",      "largest_stretch", "energy",        "solve_s"};
    const std::vector<int> angles =
        options.quick ? std::vector{5, 20, 60, 90} : std::vector{1, 2, 5, 10, 20, 30, 45, 60, 90, 120};
    const std::vector<int> stretches = options.quick ? std::vector{5, 50} : std::vector{1, 2, 5, 10, 20, 50, 100, 200};
    for (const LargeMotion& motion : large_motions())
        for (const int amount : motion.unit == "degrees" ? angles : stretches) {
            const Row id = Row().set("part", "theory").set("motion", motion.name).set("amount", amount);
            study.cases.push_back({id, 1.0, [motion, amount, quick = options.quick](Control& control) {
                                       Row row = measure_motion(motion.make(quick ? 2 : 4), amount, control);
                                       row.set("unit", motion.unit).set("what", motion.what);
                                       return std::vector<Row>{row};
                                   }});
        }
    add_large_refinements(options.quick, study.cases);
    study.conclude = [](const Table& table, Control&) { return conclude_large(table); };
    return study;
}

}  // namespace elastolab
