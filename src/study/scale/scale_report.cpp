#include "study/scale/scale_report.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.hpp"
#include "methods/registry.hpp"
#include "study/report/report.hpp"
#include "study/report/statistics.hpp"

namespace elastolab {

namespace {

const std::vector<std::string> kModes = {"on-demand", "full", "full-volume"};

/// Index of the first large mesh, where fixed costs no longer count: at 5000 vertices, from where a method may store
/// its matrices differently, if three meshes are that large; else where the larger half begins.
std::size_t first_large(const Table& rows) {
    constexpr double kLarge = 5000.0;
    const std::vector<double> n = rows.numbers("vertices");
    const auto first = std::find_if(n.begin(), n.end(), [](double vertices) { return vertices >= kLarge; });
    return n.end() - first >= 3 ? static_cast<std::size_t>(first - n.begin()) : n.size() / 2;
}

double exponent(const Table& rows, const std::string& quantity) {
    const std::vector<double> x = rows.numbers("vertices"), y = rows.numbers(quantity);
    const auto first = static_cast<std::ptrdiff_t>(first_large(rows));
    return fitted_exponent(std::vector(x.begin() + first, x.end()), std::vector(y.begin() + first, y.end()));
}

std::string bytes(double value) { return std::isfinite(value) ? readable_bytes(value) : "-"; }

std::string growth_table(const Table& table) {
    std::vector<std::vector<std::string>> lines;
    for (const std::string& method : table.values("method"))
        for (const std::string& mode : kModes) {
            const Table rows = table.where({{"method", method}, {"mode", mode}});
            if (rows.rows.empty()) continue;
            const Row& last = rows.rows.back();
            lines.push_back({method, mode, last.text("vertices"), duration(last.number("precompute_s")),
                             short_number(exponent(rows, "precompute_s")), duration(last.number("set_change_s")),
                             short_number(exponent(rows, "set_change_s")), duration(last.number("frame_s")),
                             bytes(last.number("measured_bytes")), short_number(exponent(rows, "measured_bytes"))});
        }
    return markdown_table({"method", "mode", "vertices of the largest", "precomputation", "exponent", "set change",
                           "exponent", "frame", "memory", "exponent"},
                          lines);
}

/// What a prediction is compared with: time until the first set can be pulled; memory of the precomputation, or, where
/// the factorisation waits for a set (FEM on demand), with that.
double measured(const Row& row, const std::string& of) {
    const std::optional<MethodKind> kind = parse_method_kind(row.text("method"));
    const bool with_set = kind && (*kind)->sparse && row.text("mode") == "on-demand";
    if (of == "bytes") return row.number(with_set ? "with_set_bytes" : "measured_bytes");
    return row.number("precompute_s") + row.number("set_change_s");
}

std::string prediction_table(const Table& table) {
    std::vector<std::vector<std::string>> lines;
    for (const std::string& method : table.values("method"))
        for (const std::string& mode : kModes) {
            const Table rows = table.where({{"method", method}, {"mode", mode}});
            if (rows.rows.empty()) continue;
            const auto span = [&](const std::string& predicted, const std::string& of) {
                double least = 1e300, most = 0.0;
                for (std::size_t i = first_large(rows); i < rows.rows.size(); ++i) {
                    const double ratio = rows.rows[i].number(predicted) / measured(rows.rows[i], of);
                    least = std::min(least, ratio);
                    most = std::max(most, ratio);
                }
                return short_number(least) + " to " + short_number(most);
            };
            const Row& last = rows.rows.back();
            lines.push_back({method, mode, last.text("vertices"), bytes(last.number("predicted_bytes")),
                             bytes(measured(last, "bytes")), bytes(last.number("with_set_bytes")),
                             span("predicted_bytes", "bytes"), duration(last.number("predicted_s")),
                             duration(measured(last, "seconds")), span("predicted_s", "seconds")});
        }
    return "Time until a first set can be pulled, and memory of the factorisation, predicted and measured. A set of a "
           "tenth of the vertices is reckoned with; the ones measured have up to a quarter.\n\n" +
           markdown_table({"method", "mode", "vertices", "memory predicted", "measured", "with a constrained set",
                           "predicted / measured", "time predicted", "measured", "predicted / measured"},
                          lines);
}

Plot growth_plot(const Table& table, const std::string& column, const std::string& title, const std::string& label) {
    Plot plot{.name = "scale-" + column.substr(0, column.rfind('_')), .title = title};
    plot.caption = "Solid: on demand; dashed: full; points: FEM over all nodes.";
    plot.x_label = "vertices";
    plot.y_label = label;
    plot.log_x = plot.log_y = true;
    for (const std::string& method : table.values("method"))
        for (const std::string& mode : kModes) {
            const Row where{{"method", method}, {"mode", mode}};
            if (table.where(where).rows.empty()) continue;
            plot.series.push_back({method + ", " + mode, where, "vertices", column, method_color(method),
                                   mode == "full", mode == "full-volume" ? "points" : "linespoints"});
        }
    return plot;
}

Plot memory_plot(const Table& table) {
    Plot plot = growth_plot(table, "measured_bytes", "Peak memory of the precomputation", "bytes");
    plot.name = "scale-memory";
    plot.caption = "Measured (with points) and predicted before it begins (dashed lines without), on demand.";
    std::erase_if(plot.series, [](const Series& series) { return series.where.text("mode") != "on-demand"; });
    const std::vector<Series> measured = plot.series;
    for (Series series : measured) {
        series.title += ", predicted";
        series.y = "predicted_bytes";
        series.dashed = true;
        series.style = "lines";
        plot.series.push_back(series);
    }
    return plot;
}

}  // namespace

Conclusions conclude_scale(const Table& table) {
    Conclusions conclusions;
    conclusions.findings =
        "Cubes with one face fixed and a patch of the opposite one as a handle. Exponents are those of the growth with "
        "the number of surface vertices, fitted over meshes from 5000 vertices on where there are three of them, else "
        "over the larger half; a frame is "
        "a drag of the handle.\n\n" +
        growth_table(table) +
        "\nMemory is the peak beyond what the program held before; TetGen runs in a process of its own and is not in "
        "it.\n\n" +
        prediction_table(table);
    conclusions.plots = {growth_plot(table, "precompute_s", "Precomputation", "precomputation [s]"),
                         growth_plot(table, "set_change_s", "First constrained set", "set change [s]"),
                         memory_plot(table)};
    return conclusions;
}

}  // namespace elastolab
