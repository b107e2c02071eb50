#include "study/error/error_report.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "study/error/error_frontier.hpp"
#include "study/report/report.hpp"
#include "study/report/statistics.hpp"

namespace elastolab {

namespace {

const std::vector<std::string> kVariants = {"linear-bem", "linear-bem restricted", "linear-bem continuous", "fem",
                                            "constant-bem"};

int variant_color(const std::string& variant) {
    if (variant == "linear-bem restricted") return 3;
    if (variant == "linear-bem continuous") return 4;
    return method_color(variant);
}

/// Order of the error on the finer half of the meshes.
double observed_order(const Table& rows) {
    std::vector<double> h, error;
    const std::size_t n = rows.rows.size();
    for (std::size_t i = n > 3 ? n - 3 : 0; i < n; ++i) {
        h.push_back(1.0 / rows.rows[i].number("size"));
        error.push_back(rows.rows[i].number("error"));
    }
    return fitted_exponent(h, error);
}

std::string theory(const std::string& variant) {
    if (variant == "constant-bem") return "1";
    return variant == "linear-bem continuous" ? "1 to 2" : "2";
}

std::string order_findings(const Table& table) {
    const Table refinement = table.where({{"part", "refinement"}});
    std::vector<std::vector<std::string>> rows;
    for (const std::string& problem : refinement.values("problem"))
        for (const std::string& nu : refinement.values("nu"))
            for (const std::string& variant : kVariants) {
                const Table some = refinement.where({{"problem", problem}, {"nu", nu}, {"variant", variant}});
                if (some.rows.empty()) continue;
                const Row& finest = some.rows.back();
                rows.push_back({problem, nu, variant, short_number(observed_order(some)), theory(variant),
                                finest.text("vertices"), percent(finest.number("error")),
                                duration(finest.number("ready_s"))});
            }
    return "## Orders\n\nError against the exact solution, root mean square over the free vertices, relative; order "
           "fitted over the three finest meshes. Nothing here is compared with a finer mesh of the same method.\n\n" +
           markdown_table({"problem", "nu", "variant", "order", "theory", "vertices of the finest", "its error",
                           "ready to drag after"},
                          rows);
}

std::string target_text(double target) { return percent(target); }

std::string frontier_findings(const Table& table) {
    const std::vector<FrontierPoint> points = frontier(table, "ready_s");
    const std::vector<FrontierPoint> once = fastest(frontier(table, "once_s"));
    std::vector<std::vector<std::string>> rows;
    for (const FrontierPoint& best : fastest(points)) {
        std::vector<std::string> others;
        for (const std::string variant : {"linear-bem", "fem", "constant-bem"}) {
            const auto found = std::find_if(points.begin(), points.end(), [&](const FrontierPoint& p) {
                return p.problem == best.problem && p.nu == best.nu && p.target == best.target && p.variant == variant;
            });
            others.push_back(found == points.end() ? "not reached" : duration(found->seconds));
        }
        const auto single = std::find_if(once.begin(), once.end(), [&](const FrontierPoint& p) {
            return p.problem == best.problem && p.nu == best.nu && p.target == best.target;
        });
        rows.push_back({best.problem, best.nu, target_text(best.target), best.variant, count(best.vertices),
                        duration(best.seconds), others[0], others[1], others[2],
                        single == once.end() ? "-" : single->variant + ", " + duration(single->seconds)});
    }
    return "## Who is fastest at a given error\n\nTime from the mesh until handles can be dragged, between the "
           "measured "
           "sizes interpolated in logarithms.\n\n" +
           markdown_table({"problem", "nu", "error", "fastest", "vertices", "ready after", "linear-bem", "fem",
                           "constant-bem", "fastest for a single solve"},
                          rows);
}

std::string wins_finding(const Table& table) {
    int fem = 0, linear = 0, constant = 0;
    std::set<std::string> places;
    for (const FrontierPoint& best : fastest(frontier(table, "ready_s"))) {
        fem += best.variant == "fem" ? 1 : 0;
        constant += best.variant == "constant-bem" ? 1 : 0;
        linear += best.variant.starts_with("linear-bem") ? 1 : 0;
        if (best.variant == "fem")
            places.insert(best.problem + " (nu " + best.nu + ", " + target_text(best.target) + ")");
    }
    std::string text = "Of the " + std::to_string(fem + linear + constant) +
                       " combinations of problem, ratio and error, linear BEM is the fastest to be ready in " +
                       std::to_string(linear) + ", FEM in " + std::to_string(fem) + ", constant BEM in " +
                       std::to_string(constant) + ".";
    if (!places.empty()) {
        text += " FEM wins on";
        for (const std::string& place : places) text += " " + place + ",";
        text.back() = '.';
    }
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

std::string organic_findings(const Table& table) {
    const Table organic = table.where({{"part", "organic"}});
    std::vector<std::vector<std::string>> rows;
    for (const std::string& problem : organic.values("problem"))
        for (const std::string& nu : organic.values("nu")) {
            std::vector<std::string> row = {problem, nu, "", ""};
            for (const std::string& variant : kVariants) {
                const Table some = organic.where({{"problem", problem}, {"nu", nu}, {"variant", variant}});
                if (!some.rows.empty()) {
                    row[2] = some.rows.front().text("vertices");
                    row[3] = percent(some.rows.front().number("truth_error"));
                }
                row.push_back(some.rows.empty() ? "-"
                                                : percent(some.rows.front().number("error")) + " in " +
                                                      duration(some.rows.front().number("ready_s")));
            }
            rows.push_back(row);
        }
    std::vector<std::string> titles = {"body", "nu", "vertices", "truth known to"};
    titles.insert(titles.end(), kVariants.begin(), kVariants.end());
    return "## Organic bodies\n\nPulled at a small patch; error and time until ready. Truth: quadratic finite elements "
           "on the same polyhedron, graded towards the rims of the patches and extrapolated.\n\n" +
           markdown_table(titles, rows);
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
           "the "
           "surface's edge (the program uses 1.8) and on circumradius over shortest edge (1.4). Boundary elements: "
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
        plot.series.push_back({variant,
                               {{"part", "refinement"}, {"problem", problem}, {"nu", nu}, {"variant", variant}},
                               "ready_s",
                               "error",
                               variant_color(variant),
                               variant.find(' ') != std::string::npos});
    return plot;
}

Plot ratio_plot(const std::string& problem) {
    Plot plot{.name = "error-poisson-" + problem, .title = "Poisson's ratio: error on " + problem};
    plot.caption = "One mesh for all; linear tetrahedra lock towards one half.";
    plot.x_label = "Poisson's ratio";
    plot.y_label = "relative error (rms)";
    plot.log_y = true;
    for (const std::string& variant : kVariants)
        plot.series.push_back({variant,
                               {{"part", "poisson"}, {"problem", problem}, {"variant", variant}},
                               "nu",
                               "error",
                               variant_color(variant),
                               variant.find(' ') != std::string::npos});
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
        plot.series.push_back({variant,
                               {{"problem", problem}, {"nu", "0.3"}, {"time", "ready_s"}, {"variant", variant}},
                               "target",
                               "seconds",
                               variant_color(variant),
                               variant.find(' ') != std::string::npos});
    return plot;
}

}  // namespace

Conclusions conclude_error(const Table& table) {
    Conclusions conclusions;
    conclusions.findings = "## In short\n\n" + bar_finding(table) + "\n" + wins_finding(table) + "\n" +
                           frontier_findings(table) + "\n" + ratio_findings(table) + "\n" + reproduced_findings(table) +
                           "\n" + organic_findings(table) + "\n" + order_findings(table) + "\n" +
                           choice_findings(table);
    std::ostringstream text;
    const Table times = frontier_table(table);
    write_csv(text, times);
    conclusions.files.push_back({"error-frontier.csv", text.str()});
    for (const std::string& problem : times.where({{"nu", "0.3"}}).values("problem"))
        conclusions.plots.push_back(frontier_plot(problem));
    const Table refinement = table.where({{"part", "refinement"}});
    for (const std::string& problem : refinement.values("problem"))
        for (const std::string& nu : refinement.values("nu"))
            if (!problem.ends_with("irregular")) conclusions.plots.push_back(error_plot(problem, nu));
    for (const std::string& problem : table.where({{"part", "poisson"}}).values("problem"))
        conclusions.plots.push_back(ratio_plot(problem));
    return conclusions;
}

}  // namespace elastolab
