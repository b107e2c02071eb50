#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "study/report/table.hpp"

namespace elastolab {

/// Rows of the study's CSV, drawn as one line.
struct Series {
    std::string title = {};
    Row where = {};              ///< cells that a row must have
    std::string x = {}, y = {};  ///< columns; or x as an expression of gnuplot in brackets
    int color = 0;               ///< number in the palette; the same thing has the same colour in all plots
    bool dashed = false;
    std::string style = "linespoints";
};

/// A plot of the columns of a study's CSV. Its script stands beside the CSV and reads it, so that anyone can redraw or
/// change it: gnuplot NAME.gp
struct Plot {
    std::string name;  ///< of its files: NAME.gp, NAME.svg, NAME.png
    std::string title = {};
    std::string caption = {};  ///< for the report
    std::string x_label = {}, y_label = {};
    bool log_x = false, log_y = false;
    std::vector<Series> series = {};
    std::string extra = {};  ///< further gnuplot settings, before the plot
    std::string body = {};   ///< a whole script instead of series; without terminal and output
    std::string csv = {};    ///< the file that it reads; empty: that of the study
};

/// The script of a plot that reads `csv`.
std::string gnuplot_script(const Plot& plot, const std::string& csv);

/// Runs gnuplot on NAME.gp in `folder`; needs no display. Returns what went wrong, empty when nothing did.
std::string draw(const std::string& name, const std::filesystem::path& folder, Control& control);

/// The colour of a method or of a variant of one, the same in all studies.
int method_color(const std::string& method);

/// The line of a variant, in the colour of its method: dashed where it is not the method by itself.
Series variant_series(const std::string& variant, Row where, std::string x, std::string y);
/// The errors of elements of ten nodes, or of four, which are dashed.
Series element_series(std::string title, Row where, std::string x, int color, bool four_nodes);

}  // namespace elastolab
