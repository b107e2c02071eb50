#include "study/error/error_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "methods/registry.hpp"
#include "study/error/error_frontier.hpp"
#include "study/error/problems.hpp"
#include "study/report/report.hpp"
#include "study/report/statistics.hpp"

namespace elastolab {

namespace {

const std::vector<std::string> kVariants = {"galerkin-bem",          "quadratic-fem",         "linear-bem",
                                            "linear-bem restricted", "linear-bem continuous", "fem",
                                            "constant-bem"};

/// Order of the error on the finer half of the meshes.
double observed_order(const Table& rows, const std::string& column) {
    std::vector<double> h, error;
    const std::size_t n = rows.rows.size();
    for (std::size_t i = n > 3 ? n - 3 : 0; i < n; ++i) {
        h.push_back(1.0 / rows.rows[i].number("size"));
        error.push_back(rows.rows[i].number(column));
    }
    return fitted_exponent(h, error);
}

/// "-" where the elements hold the field: the order of rounding means nothing.
std::string order_text(const Table& rows, const std::string& column) {
    constexpr double kRounding = 1e-9;
    return rows.rows.back().number(column) < kRounding ? "-" : short_number(observed_order(rows, column));
}

std::string theory(const std::string& variant) {
    if (variant == "constant-bem") return "1";
    if (variant == "quadratic-fem") return "3 (2 on curved sides)";
    return variant == "linear-bem continuous" ? "1 to 2" : "2";
}

/// A row for each problem, Poisson's ratio and variant of the table: these three, then what `cells` says of its meshes.
template <class Cells>
std::vector<std::vector<std::string>> rows_of_refinements(const Table& table, const std::vector<std::string>& variants,
                                                          const Cells& cells) {
    std::vector<std::vector<std::string>> rows;
    for (const std::string& problem : table.values("problem"))
        for (const std::string& nu : table.values("nu"))
            for (const std::string& variant : variants) {
                const Table meshes = table.where({{"problem", problem}, {"nu", nu}, {"variant", variant}});
                if (meshes.rows.empty()) continue;
                std::vector<std::string>& row = rows.emplace_back(std::vector{problem, nu, variant});
                for (const std::string& cell : cells(meshes, variant)) row.push_back(cell);
            }
    return rows;
}

std::string order_findings(const Table& table) {
    const Table refinement = table.where({{"part", "refinement"}});
    const auto cells = [](const Table& some, const std::string& variant) -> std::vector<std::string> {
        const Row& finest = some.rows.back();
        return {order_text(some, "error"),         theory(variant),
                finest.text("vertices"),           percent(finest.number("error")),
                order_text(some, "error_force"),   percent(finest.number("error_force")),
                duration(finest.number("ready_s"))};
    };
    const auto rows = rows_of_refinements(refinement, kVariants, cells);
    return "## Orders\n\nError against the exact solution, root mean square over the free vertices, relative; order "
           "fitted over the three finest meshes. Forces: total force and moment of the worst constrained patch, over "
           "the largest (those of hollow spheres add up to nothing, or there are none). Nothing here is compared with "
           "a "
           "finer mesh of the same method.\n\n" +
           markdown_table({"problem", "nu", "variant", "order", "theory", "vertices of the finest", "its error",
                           "order of forces", "error of forces", "ready to drag after"},
                          rows);
}

std::string target_text(double target) { return percent(target); }

std::string seconds_at(const std::vector<FrontierPoint>& points, const FrontierPoint& where,
                       const std::string& variant) {
    const auto found = std::find_if(points.begin(), points.end(), [&](const FrontierPoint& p) {
        return p.problem == where.problem && p.nu == where.nu && p.target == where.target && p.variant == variant;
    });
    return found == points.end() ? "not reached" : duration(found->seconds);
}

/// The winner at the problem, ratio and target of `where`, with its time; "-" where none reaches the target.
std::string winner_at(const std::vector<FrontierPoint>& winners, const FrontierPoint& where) {
    const auto found = std::find_if(winners.begin(), winners.end(), [&](const FrontierPoint& p) {
        return p.problem == where.problem && p.nu == where.nu && p.target == where.target;
    });
    return found == winners.end() ? "-" : found->variant + ", " + duration(found->seconds);
}

/// Those whose time is measured against their error.
std::vector<std::string> refined_methods(const Table& table) {
    const Table refinement = table.where({{"part", "refinement"}});
    std::vector<std::string> methods = method_names();
    std::erase_if(methods, [&](const auto& method) { return refinement.where({{"variant", method}}).rows.empty(); });
    return methods;
}

std::string frontier_lines(const Table& table, const std::string& error) {
    const std::vector<std::string> methods = refined_methods(table);
    const std::vector<FrontierPoint> points = frontier(table, "ready_s", error);
    const std::vector<FrontierPoint> best_default = fastest(defaults_of(points));
    const std::vector<FrontierPoint> once = fastest(defaults_of(frontier(table, "once_s", error)));
    std::vector<std::vector<std::string>> rows;
    for (const FrontierPoint& best : fastest(points)) {
        std::vector<std::string> row = {best.problem, best.nu, target_text(best.target), winner_at(best_default, best),
                                        best.variant + ", " + duration(best.seconds)};
        for (const std::string& method : methods) row.push_back(seconds_at(points, best, method));
        row.push_back(winner_at(once, best));
        rows.push_back(row);
    }
    std::vector<std::string> titles = {"problem", "nu", "error", "fastest default", "fastest variant"};
    titles.insert(titles.end(), methods.begin(), methods.end());
    titles.push_back("fastest default for a single solve");
    return markdown_table(titles, rows);
}

std::string frontier_findings(const Table& table) {
    return "## Who is fastest at a given error\n\nTime from the mesh until handles can be dragged, between the "
           "measured "
           "sizes interpolated in logarithms. Defaults are the methods as the program takes them; variants are linear "
           "BEM with other tractions as well.\n\nDisplacements:\n\n" +
           frontier_lines(table, "error") + "\nForces of the worst patch:\n\n" + frontier_lines(table, "error_force");
}

std::string wins_finding(const Table& table) {
    std::map<std::string, int> wins;
    int all = 0;
    for (const FrontierPoint& best : fastest(defaults_of(frontier(table, "ready_s")))) {
        ++wins[best.variant];
        ++all;
    }
    std::string text = "Of the " + std::to_string(all) +
                       " combinations of problem, ratio and error that a default reaches, the fastest to be ready is";
    for (const auto& [method, count_of] : wins) text += " " + method + " in " + std::to_string(count_of) + ",";
    text.back() = '.';
    return text + "\n";
}

std::string bar_finding(const Table& table) {
    const Table rows =
        table.where({{"part", "refinement"}, {"problem", "bending"}, {"nu", "0.3"}, {"variant", "linear-bem"}});
    for (const Row& row : rows.rows)
        if (row.number("error") <= 0.01)
            return "The bending bar to 1 %: linear BEM with its default tractions reaches " +
                   percent(row.number("error")) + " at " + row.text("vertices") + " vertices, after " +
                   duration(row.number("precompute_s")) + " of precomputation and " +
                   duration(row.number("set_change_s")) + " for the first set.\n";
    return "The bending bar to 1 %: not reached by linear BEM with its default tractions at the sizes of this run.\n";
}

std::string organic_cell(const Row& row) {
    return percent(row.number("error")) + " in " + duration(row.number("ready_s")) + "; worst vertex " +
           percent(row.number("error_max")) + " (said " + percent(row.number("estimate")) + "); forces " +
           percent(row.number("error_force")) + " (said " + percent(row.number("estimate_force")) + ")";
}

std::string organic_findings(const Table& table) {
    const Table organic = table.where({{"part", "organic"}});
    std::vector<std::string> variants = kVariants;
    variants.insert(variants.end(), {"galerkin-bem rims 1", "galerkin-bem rims 2"});
    std::vector<std::vector<std::string>> rows;
    for (const std::string& problem : organic.values("problem"))
        for (const std::string& nu : organic.values("nu")) {
            std::vector<std::string> row = {problem, nu, "", ""};
            for (const std::string& variant : variants) {
                const Table some = organic.where({{"problem", problem}, {"nu", nu}, {"variant", variant}});
                if (!some.rows.empty()) {
                    row[2] = some.rows.front().text("vertices");
                    row[3] = percent(some.rows.front().number("truth_error"));
                }
                row.push_back(some.rows.empty() ? "-" : organic_cell(some.rows.front()));
            }
            rows.push_back(row);
        }
    std::vector<std::string> titles = {"body", "nu", "vertices", "truth known to"};
    titles.insert(titles.end(), variants.begin(), variants.end());
    return "## Organic bodies\n\nMoved at a small patch, or bent by its weight (cantilever); error (rms) and time "
           "until ready, the worst vertex and the forces of the worst patch with what the program says of them. With "
           "\"rims\", so many rows of thin triangles are added along the rims of the patches. Truth: quadratic finite "
           "elements on the same polyhedron, graded towards the rims of the patches and extrapolated.\n\n" +
           markdown_table(titles, rows);
}

const std::vector<std::string> kFiniteVariants = {"nonlinear-fem", "nonlinear-fem of four nodes"};

std::string finite_findings(const Table& table) {
    const Table finite = table.where({{"part", "finite"}});
    const auto cells = [](const Table& some, const std::string&) -> std::vector<std::string> {
        const Row& finest = some.rows.back();
        return {some.rows.size() > 1 ? order_text(some, "error") : "-", finest.text("vertices"),
                percent(finest.number("error")), percent(finest.number("error_max")),
                duration(finest.number("once_s"))};
    };
    const auto rows = rows_of_refinements(finite, kFiniteVariants, cells);
    return "## Large deformations\n\nA neo-Hookean body: turned by 60 degrees, stretched by a half, bent and twisted "
           "by 60 degrees, a hollow sphere whose inner side is pushed out by a half. Truth: formulas and ordinary "
           "differential equations. The first two are fields that the elements hold exactly. Order as below, at most 2 "
           "where what is prescribed, or the body, is curved: elements have straight sides.\n\n" +
           markdown_table({"problem", "nu", "variant", "order", "vertices of the finest", "its error", "worst vertex",
                           "single solve"},
                          rows);
}

/// One row for each text of `column`, the error of every variant.
std::string error_table(const Table& table, const std::string& column) {
    std::vector<std::vector<std::string>> rows;
    for (const std::string& value : table.values(column)) {
        std::vector<std::string> row = {value};
        for (const std::string& variant : kVariants) {
            const Table some = table.where({{column, value}, {"variant", variant}});
            row.push_back(some.rows.empty() ? "-" : percent(some.rows.front().number("error")));
        }
        rows.push_back(row);
    }
    std::vector<std::string> titles = {column};
    titles.insert(titles.end(), kVariants.begin(), kVariants.end());
    return markdown_table(titles, rows);
}

std::string ratio_findings(const Table& table) {
    const Table poisson = table.where({{"part", "poisson"}});
    std::string text = "## Poisson's ratio\n\nError, the same mesh for all ratios and methods.\n";
    for (const std::string& problem : poisson.values("problem"))
        text += "\n" + problem + ":\n\n" + error_table(poisson.where({{"problem", problem}}), "nu");
    return text;
}

std::string reproduced_findings(const Table& table) {
    return "## Reproduced\n\nError on fields that linear elements hold exactly, on a bar with vertices moved at "
           "random.\n\n" +
           error_table(table.where({{"part", "reproduced"}}), "problem");
}

std::string choice_findings(const Table& table) {
    std::vector<std::vector<std::string>> rows;
    for (const Row& row : table.where({{"part", "choices"}}).rows)
        rows.push_back({row.text("variant"), row.text("unknowns"), percent(row.number("error")),
                        duration(row.number("precompute_s")), duration(row.number("once_s"))});
    return "## Choices within a method\n\nOn the bending bar, nu 0.3. Tetrahedra: bound on their volume in units of "
           "the surface's edge (the program uses 1.8) and on circumradius over shortest edge (1.4). Boundary elements: "
           "error allowed to an integral (1e-10).\n\n" +
           markdown_table({"choice", "unknowns", "error", "precomputation", "single solve"}, rows);
}

Plot error_plot(const std::string& problem, const std::string& nu) {
    Plot plot;
    plot.name = "error-" + problem + "-nu" + nu;
    plot.title = "Error against time: " + problem + ", nu " + nu;
    plot.caption = "Every point is a mesh. Lower left is better.";
    plot.x_label = "from the mesh until ready to drag [s]";
    plot.y_label = "relative error (rms)";
    plot.log_x = plot.log_y = true;
    for (const std::string& variant : kVariants)
        plot.series.push_back(
            variant_series(variant, {{"part", "refinement"}, {"problem", problem}, {"nu", nu}, {"variant", variant}},
                           "ready_s", "error"));
    return plot;
}

Plot ratio_plot(const std::string& problem) {
    Plot plot{.name = "error-poisson-" + problem, .title = "Poisson's ratio: error on " + problem};
    plot.caption = "One mesh for all; linear tetrahedra lock towards one half.";
    plot.x_label = "Poisson's ratio";
    plot.y_label = "relative error (rms)";
    plot.log_y = true;
    for (const std::string& variant : kVariants)
        plot.series.push_back(
            variant_series(variant, {{"part", "poisson"}, {"problem", problem}, {"variant", variant}}, "nu", "error"));
    return plot;
}

Plot finite_plot(const Table& finite) {
    Plot plot{.name = "error-finite", .title = "Error of large deformations against the size of the elements"};
    plot.caption = "Nonlinear FEM, nu 0.3. Dashed: four nodes, else ten.";
    plot.x_label = "cells";
    plot.y_label = "relative error (rms)";
    plot.log_x = plot.log_y = true;
    int color = 0;
    for (const std::string& problem : finite.values("problem")) {
        if (problem_family(problem).reproduced) continue;
        for (const std::string& variant : kFiniteVariants) {
            const bool four_nodes = variant != kFiniteVariants.front();
            plot.series.push_back(
                element_series(problem + (four_nodes ? ", four nodes" : ""),
                               {{"part", "finite"}, {"problem", problem}, {"nu", "0.3"}, {"variant", variant}}, "size",
                               color, four_nodes));
        }
        ++color;
    }
    return plot;
}

Plot frontier_plot(const std::string& problem) {
    Plot plot{.name = "error-frontier-" + problem, .title = "Time for a given error: " + problem + ", nu 0.3"};
    plot.caption = "Interpolated between the measured sizes, from error-frontier.csv.";
    plot.csv = "error-frontier.csv";
    plot.x_label = "error asked for";
    plot.y_label = "until ready to drag [s]";
    plot.log_x = plot.log_y = true;
    plot.extra = "set xrange [0.15:0.0007]";
    for (const std::string& variant : kVariants)
        plot.series.push_back(variant_series(
            variant,
            {{"error", "error"}, {"problem", problem}, {"nu", "0.3"}, {"time", "ready_s"}, {"variant", variant}},
            "target", "seconds"));
    return plot;
}

}  // namespace

Conclusions conclude_error(const Table& table) {
    Conclusions conclusions;
    conclusions.findings = "## In short\n\n" + bar_finding(table) + "\n" + wins_finding(table) + "\n" +
                           frontier_findings(table) + "\n" + ratio_findings(table) + "\n" + reproduced_findings(table) +
                           "\n" + organic_findings(table) + "\n" + finite_findings(table) + "\n" +
                           order_findings(table) + "\n" + choice_findings(table);
    std::ostringstream text;
    const Table times = frontier_table(table);
    write_csv(text, times);
    conclusions.files.push_back({"error-frontier.csv", text.str()});
    for (const std::string& problem : times.where({{"error", "error"}, {"nu", "0.3"}}).values("problem"))
        conclusions.plots.push_back(frontier_plot(problem));
    const Table refinement = table.where({{"part", "refinement"}});
    for (const std::string& problem : refinement.values("problem"))
        for (const std::string& nu : refinement.values("nu"))
            if (!problem.ends_with("irregular")) conclusions.plots.push_back(error_plot(problem, nu));
    if (const Table finite = table.where({{"part", "finite"}}); !finite.rows.empty())
        conclusions.plots.push_back(finite_plot(finite));
    for (const std::string& problem : table.where({{"part", "poisson"}}).values("problem"))
        conclusions.plots.push_back(ratio_plot(problem));
    return conclusions;
}

}  // namespace elastolab
