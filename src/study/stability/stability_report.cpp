#include "study/stability/stability_report.hpp"

#include <algorithm>
#include <cmath>

#include "bem/collocation/method.hpp"
#include "study/report/report.hpp"
#include "study/stability/trials.hpp"

namespace elastolab {

namespace {

std::string level_list(const Table& rows) {
    std::string text;
    for (const Row& row : rows.rows) text += (text.empty() ? "" : ", ") + row.text("level");
    return text.empty() ? "-" : text;
}

std::string first_message(const Table& rows) {
    for (const Row& row : rows.rows)
        if (!row.text("message").empty()) return "\"" + row.text("message").substr(0, 160) + "\"";
    return "-";
}

/// Worst error among the rows that count as right.
std::string worst_right(const Table& rows) {
    double worst = 0.0;
    for (const Row& row : rows.rows)
        worst = std::max(worst, row.number(row.text("error_max").empty() ? "error" : "error_max"));
    return rows.rows.empty() ? "-" : short_number(worst);
}

std::string group_table(const Table& table, const std::string& group) {
    const Table all = table.where({{"group", group}});
    std::vector<std::vector<std::string>> lines;
    for (const std::string& variant : all.values("variant")) {
        const Table rows = all.where({{"variant", variant}});
        const Table right = rows.where({{"outcome", "right"}}), told = rows.where({{"outcome", "told"}}),
                    refused = rows.where({{"outcome", "refused"}}), silent = rows.where({{"outcome", "silent"}});
        Table beyond = told;
        beyond.rows.insert(beyond.rows.end(), refused.rows.begin(), refused.rows.end());
        lines.push_back({variant, level_list(right), worst_right(right), level_list(told), level_list(refused),
                         level_list(silent), first_message(beyond)});
    }
    return markdown_table({"method", "right at", "worst error there", "wrong with a warning at", "refused at",
                           "wrong and silent at", "what the program says"},
                          lines);
}

std::string heading(const Table& table, const std::string& group) {
    const auto& groups = trial_groups(false);
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.name == group; });
    const std::string parameter = table.where({{"group", group}}).rows.front().text("parameter");
    const std::string what = found != groups.end() ? found->what
                             : group == "edits"
                                 ? "random edits of the constrained set and its values, against fresh solves"
                                 : "other numbers of threads than the machine has";
    return "### " + group + "\n\n" + what + "; levels: " + parameter + ".\n\n";
}

std::string count_findings(const Table& table) {
    const auto count = [&](const char* outcome) { return table.where({{"outcome", outcome}}).rows.size(); };
    const Table right = table.where({{"outcome", "right"}});
    const auto warned = std::count_if(right.rows.begin(), right.rows.end(),
                                      [](const Row& row) { return !row.text("message").empty(); });
    std::string text = "Of " + std::to_string(table.rows.size()) + " attempts " + std::to_string(right.rows.size()) +
                       " are right (" + std::to_string(warned) + " of them with a warning or remark), " +
                       std::to_string(count("told")) + " wrong with a warning, " + std::to_string(count("refused")) +
                       " refused with a reason, and " + std::to_string(count("silent")) + " wrong without a word; " +
                       std::to_string(count("failed")) + " ended in an error that they should not have.\n";
    return text;
}

std::string edit_findings(const Table& table) {
    double edits = 0.0, checks = 0.0, worst = 0.0;
    for (const Row& row : table.where({{"group", "edits"}}).rows) {
        if (row.text("outcome") == "failed") continue;
        edits += row.number("edits");
        checks += row.number("checks");
        worst = std::max(worst, row.number("error"));
    }
    return std::to_string(static_cast<long>(edits)) + " random edits, " + std::to_string(static_cast<long>(checks)) +
           " of them compared with a fresh solve: worst relative difference " + short_number(worst) + ".\n";
}

Plot sweep_plot(const Table& table, const std::string& group) {
    Plot plot{.name = "stability-" + group, .title = "Error in the trial: " + group};
    plot.caption = "Against the exact solution; where a method was refused there is no point.";
    // Poisson's ratios that matter are so close to 1/2 that they would be one point.
    const bool towards_half = group == "nu-to-half";
    const std::string parameter = table.where({{"group", group}}).rows.front().text("parameter");
    plot.x_label = towards_half ? "1/2 - " + parameter + " (1/2 itself: 1e-10)" : parameter;
    plot.y_label = "largest error / largest displacement";
    plot.log_x = plot.log_y = true;
    if (!towards_half) plot.extra = "set yrange [1e-16:*]";
    for (const TrialVariant& variant : trial_variants()) {
        plot.series.push_back({variant.name,
                               {{"group", group}, {"variant", variant.name}},
                               towards_half ? "(0.5 - column('level') + 1e-10)" : "level",
                               "error_max",
                               method_color(variant.name),
                               variant.name.find(' ') != std::string::npos});
    }
    return plot;
}

}  // namespace

Conclusions conclude_stability(const Table& table) {
    Conclusions conclusions;
    conclusions.findings =
        "Every attempt goes the way of the program: the mesh is checked, the model precomputed, the set constrained; "
        "whatever it says is quoted. An answer counts as right when the largest error of a vertex, against the exact "
        "solution, is at most, and the total force and moment of the worst constrained patch is off by at most " +
        percent(allowed_error(kLinearBem)) + " of the largest" +
        " (constant BEM, of first order: " + percent(allowed_error(kConstantBem)) +
        "). \"Told\" means that a warning names what is wrong.\n\n" + count_findings(table) + "\n" +
        edit_findings(table) + "\n";
    for (const std::string& group : table.values("group"))
        conclusions.findings += heading(table, group) + group_table(table, group) + "\n";
    for (const std::string group : {"nu-to-half", "plate", "slivers", "far-away"})
        if (!table.where({{"group", group}}).rows.empty()) conclusions.plots.push_back(sweep_plot(table, group));
    return conclusions;
}

}  // namespace elastolab
