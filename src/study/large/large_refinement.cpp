#include "study/large/large_refinement.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <string_view>

#include "base/timer.hpp"
#include "methods/precompute.hpp"
#include "study/large/large_scenes.hpp"
#include "study/report/report.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

constexpr double kLargeAngle = 60.0, kLargeStretch = 50.0;  // degrees, per cent

double amount_of(const LargeMotion& motion) { return motion.unit == "degrees" ? kLargeAngle : kLargeStretch; }

struct Solved {
    LargeScene scene;
    Deformer::Answer answer;
    int n_tetrahedra = 0;
    double seconds = 0.0;
};

Solved solved_bar(const LargeMotion& motion, int cells, ElementDegree elements, Control& control) {
    Solved result{.scene = motion.make(cells), .answer = {}};
    Deformer deformer(precompute(result.scene.body, nonlinear_method(elements), control));
    deformer.constrain(result.scene.set, control);
    const Stopwatch watch;
    result.answer = deformer.answer(result.scene.values(amount_of(motion)), {.residual = true}, control);
    result.seconds = watch.seconds();
    result.n_tetrahedra = deformer.model().facts().n_tetrahedra;
    return result;
}

/// Displacements of the finer bar at the vertices of the other one, all of which it has.
Eigen::VectorXd at_vertices_of(const SurfaceMesh& coarse, const Solved& fine) {
    const SurfaceMesh& mesh = *fine.scene.body.surface;
    Eigen::VectorXd u(3 * coarse.n_vertices());
    for (int v = 0; v < coarse.n_vertices(); ++v) {
        Eigen::Index same = 0;
        (mesh.vertices.colwise() - coarse.vertices.col(v)).colwise().squaredNorm().minCoeff(&same);
        u.segment<3>(3 * v) = fine.answer.displacements.segment<3>(3 * same);
    }
    return u;
}

/// The finest bar of each motion, made when it is first asked for.
class References {
public:
    explicit References(int cells) : cells_(cells) {}
    const Solved& of(const LargeMotion& motion, Control& control) {
        auto found = all_.find(motion.name);
        if (found == all_.end())
            found = all_.emplace(motion.name, solved_bar(motion, cells_, ElementDegree::quadratic, control)).first;
        return found->second;
    }

private:
    int cells_;
    std::map<std::string, Solved> all_;
};

Row measure_refinement(const LargeMotion& motion, int cells, ElementDegree elements, References& references,
                       Control& control) {
    const Solved own = solved_bar(motion, cells, elements, control);
    const SurfaceMesh& surface = *own.scene.body.surface;
    const Eigen::VectorXd truth = at_vertices_of(surface, references.of(motion, control));
    Row row = Row().set("what", motion.what).set("unit", motion.unit).set("amount", amount_of(motion));
    row.set("vertices", surface.n_vertices()).set("tetrahedra", own.n_tetrahedra);
    row.set("error", relative_error(own.answer.displacements, truth)).set("residual", *own.answer.residual);
    row.set("iterations", own.answer.facts->iterations).set("solve_s", own.seconds);
    return row.set("energy", own.answer.facts->energy).set("largest_stretch", own.answer.facts->largest_stretch);
}

}  // namespace

void add_large_refinements(bool quick, std::vector<Case>& cases) {
    const std::vector<int> sizes = quick ? std::vector{1, 2} : std::vector{1, 2, 4};
    const auto references = std::make_shared<References>(2 * sizes.back());
    for (const LargeMotion& motion : large_motions())
        for (const ElementDegree elements : {ElementDegree::linear, ElementDegree::quadratic})
            for (const int cells : sizes) {
                if (!motion.is_bar) continue;
                const Row id = Row()
                                   .set("part", "refinement")
                                   .set("motion", motion.name)
                                   .set("elements", elements == ElementDegree::linear ? 4 : 10)
                                   .set("cells", cells);
                cases.push_back({id, 1.0, [motion, cells, elements, references](Control& control) {
                                     return std::vector<Row>{
                                         measure_refinement(motion, cells, elements, *references, control)};
                                 }});
            }
}

std::string refinement_table(const Table& table) {
    std::vector<std::vector<std::string>> lines;
    std::map<std::string, std::pair<double, double>> before;  // cells and error of the last size
    for (const Row& row : table.rows) {
        if (row.text("part") != "refinement") continue;
        const std::string kind = row.text("motion") + row.text("elements");
        const double cells = row.number("cells"), error = row.number("error");
        std::string order = "-";
        if (const auto last = before.find(kind); last != before.end())
            order = short_number(std::log(last->second.second / error) / std::log(cells / last->second.first));
        before[kind] = {cells, error};
        lines.push_back({row.text("what"), row.text("elements"), row.text("cells"), row.text("vertices"),
                         percent(error), order, row.text("iterations"), duration(row.number("solve_s"))});
    }
    return "Bars turned by 60 degrees or stretched by half of their length, against the answer of twice as many cells "
           "as the last ones have. The rims of the fixed ends are singular, which bounds the order.\n\n" +
           markdown_table(
               {"motion", "nodes of an element", "cells", "vertices", "error", "order", "iterations", "time"}, lines);
}

Plot refinement_plot() {
    Plot plot{.name = "refinement", .title = "Error of the elements against their size"};
    plot.caption = "Error (rms) of nonlinear FEM on coarser bars. Dashed: four nodes, else ten.";
    plot.x_label = "cells across the bar";
    plot.y_label = "error";
    plot.log_x = plot.log_y = true;
    int color = 0;
    for (const LargeMotion& motion : large_motions()) {
        if (!motion.is_bar) continue;
        for (const char* elements : {"4", "10"}) {
            plot.series.push_back(
                element_series(motion.what + ", " + elements + " nodes",
                               {{"part", "refinement"}, {"motion", motion.name}, {"elements", elements}}, "cells",
                               color, std::string_view(elements) == "4"));
        }
        ++color;
    }
    return plot;
}

}  // namespace elastolab
