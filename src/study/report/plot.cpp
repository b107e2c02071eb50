#include "study/report/plot.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.hpp"
#include "mesh/input/child_process.hpp"
#include "methods/registry.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

/// Okabe and Ito's colours, which people with colour-blindness can tell apart; the yellow is left out.
constexpr std::array kPalette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                 "#e69f00", "#56b4e9", "#666666", "#000000"};

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

/// A gnuplot expression: the value of the column in rows that are wanted, a missing value in others.
std::string selected(const Series& series, const std::string& column) {
    std::string condition;
    for (const auto& [name, text] : series.where.cells())
        condition += (condition.empty() ? "" : " && ") + std::string("strcol('") + name + "') eq " + quoted(text);
    const std::string value = column.starts_with('(') ? column : "column('" + column + "')";
    return condition.empty() ? value : "(" + condition + " ? " + value + " : NaN)";
}

void write_series(std::ostream& out, const Plot& plot, const std::string& csv) {
    out << "plot \\\n";
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const Series& series = plot.series[i];
        const std::string color = kPalette.at(static_cast<std::size_t>(series.color) % kPalette.size());
        out << "  " << quoted(csv) << " using (" << selected(series, series.x) << "):(column('" << series.y
            << "')) with " << series.style << " lc rgb '" << color << "' lw 2";
        if (series.style.find("points") != std::string::npos)
            out << " pt " << std::array{7, 5, 9, 13, 11, 6, 4, 8}.at(static_cast<std::size_t>(series.color) % 8)
                << " ps 0.8";
        if (series.style != "points") out << " dt " << (series.dashed ? 2 : 1);
        out << " title " << quoted(series.title) << (i + 1 < plot.series.size() ? ", \\\n" : "\n");
    }
}

fs::path find_program(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    std::error_code ignored;
    for (std::string folder; std::getline(folders, folder, ':');)
        if (fs::is_regular_file(fs::path(folder) / name, ignored)) return fs::path(folder) / name;
    return {};
}

/// What is drawn, between the choice of the terminal and the end of the output.
std::string drawing(const Plot& plot, const std::string& csv) {
    if (!plot.body.empty()) return plot.body;
    std::ostringstream out;
    out << "set datafile separator ','\nset datafile missing NaN\n"
        << "set title " << quoted(plot.title) << "\nset xlabel " << quoted(plot.x_label) << "\nset ylabel "
        << quoted(plot.y_label) << "\n"
        << "set grid lc rgb '#dddddd' lt 1\nset key outside right top Left reverse\nset tics nomirror\nset border 3\n";
    if (plot.log_x) out << "set logscale x\nset format x '%g'\n";
    if (plot.log_y) out << "set logscale y\nset format y '%g'\n";
    out << plot.extra << (plot.extra.empty() || plot.extra.ends_with('\n') ? "" : "\n");
    write_series(out, plot, csv);
    return out.str();
}

}  // namespace

int method_color(const std::string& method) {
    if (method == "linear-bem restricted") return 5;
    if (method == "linear-bem continuous") return 6;
    const std::optional<MethodKind> kind = parse_method_kind(method);
    return kind ? (*kind)->colour : 7;
}

Series variant_series(const std::string& variant, Row where, std::string x, std::string y) {
    const bool is_variant = variant.find(' ') != std::string::npos;
    return {variant, std::move(where), std::move(x), std::move(y), method_color(variant), is_variant};
}

Series element_series(std::string title, Row where, std::string x, int color, bool four_nodes) {
    return {std::move(title), std::move(where), std::move(x), "error", color, four_nodes};
}

std::string gnuplot_script(const Plot& plot, const std::string& csv) {
    return "# Draws " + plot.name + ".svg and " + plot.name + ".png: gnuplot " + plot.name +
           ".gp\n"
           "set encoding utf8\n"
           "do for [kind in 'svg png'] {\n"
           "if (kind eq 'svg') {\n"
           "set terminal svg size 900,520 font 'sans,14' background 'white'\n"
           "} else {\n"
           "set terminal pngcairo size 1350,780 font 'sans,18'\n"
           "}\n"
           "set output '" +
           plot.name + ".'.kind\n" + drawing(plot, csv) + "unset output\nreset\n}\n";
}

std::string draw(const std::string& name, const fs::path& folder, Control& control) {
    const fs::path gnuplot = find_program("gnuplot");
    if (gnuplot.empty()) return "gnuplot is not installed, so no plot was drawn. Install it and run gnuplot *.gp";
    ChildProcess process(gnuplot);
    const std::string path = fs::absolute(folder).string();
    if (path.find('\'') != std::string::npos) return path + ": has a quote in its name, which gnuplot cannot open.";
    process.exchange("cd '" + path + "'\nload '" + name + ".gp'\nexit\n", control);
    if (process.wait(control) == 0) return {};
    return name + ".gp: gnuplot failed: " + process.output();
}

}  // namespace elastolab
