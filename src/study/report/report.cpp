#include "study/report/report.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace elastolab {

namespace {

/// Dashes stand for missing numbers.
std::string dash_or(const char* format, double value) { return std::isfinite(value) ? formatted(format, value) : "-"; }

std::string markdown_line(const std::vector<std::string>& fields) {
    std::string line = "|";
    for (const std::string& field : fields) {
        line += ' ';
        for (const char c : field) line += c == '|' ? std::string("\\|") : std::string(1, c);
        line += " |";
    }
    return line + "\n";
}

/// Of tables that were put together from several runs: their times do not compare.
std::string other_machines(const Table& table) {
    const std::string first = table.rows.front().text("cpu");
    const auto n =
        std::count_if(table.rows.begin(), table.rows.end(), [&](const Row& row) { return row.text("cpu") != first; });
    if (n == 0) return "";
    return "\n" + std::to_string(n) + " of " + std::to_string(table.rows.size()) +
           " rows are of another machine (column cpu): errors compare, times do not.\n";
}

std::string machine_text(const Table& table) {
    if (table.rows.empty()) return "No case was run.\n";
    const Row& row = table.rows.front();
    return "Elastolab " + row.text("version") + " on " + row.text("cpu") + ", " + row.text("cores") + " cores, " +
           readable_bytes(row.number("memory_bytes")) + " of memory; BLAS kernels " + row.text("blas_kernels") + ", " +
           row.text("threads") + " threads; seed " + row.text("seed") +
           (row.text("quick") == "yes" ? ". A quick run: small sizes, few repeats" : "") + ".\n" +
           other_machines(table);
}

/// As a shell reads it: quoted where it has more than plain letters.
std::string shell_word(const std::string& text) {
    constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+,:@%=";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string command(const std::string& study, const Table& table, const std::string& folder) {
    std::string text = "elastolab bench " + study + " --out " + shell_word(folder);
    if (table.rows.empty()) return text;
    const Row& row = table.rows.front();
    if (row.text("quick") == "yes") text += " --quick";
    return text + " --seed " + row.text("seed") + " --threads " + row.text("threads");
}

}  // namespace

std::string short_number(double value) { return dash_or("%.3g", value); }
std::string count(double value) { return dash_or("%.0f", value); }
std::string times(double value) { return dash_or(value < 10.0 ? "%.2g times" : "%.0f times", value); }
std::string percent(double share) { return dash_or(share < 0.1 ? "%.2g %%" : "%.0f %%", 100.0 * share); }
std::string duration(double seconds) {
    if (!std::isfinite(seconds)) return "-";
    return seconds < 1e-5 ? dash_or("%.2g us", 1e6 * seconds) : readable_seconds(seconds);
}

std::string markdown_table(const std::vector<std::string>& titles, const std::vector<std::vector<std::string>>& rows) {
    std::string text = markdown_line(titles) + markdown_line(std::vector<std::string>(titles.size(), "---"));
    for (const std::vector<std::string>& row : rows) text += markdown_line(row);
    return text;
}

std::string report(const Study& study, const Conclusions& conclusions, const Table& table, const std::string& folder) {
    std::string text = "# " + study.title + "\n\n" + machine_text(table) + "\n```sh\n" +
                       command(study.name, table, folder) + "\n```\n\n" + conclusions.findings + "\n";
    for (const Plot& plot : conclusions.plots)
        text += "## " + plot.title + "\n\n" + plot.caption + "\n\n![" + plot.title + "](" + plot.name + ".svg)\n\n";
    text += "## Files\n\n`" + study.name +
            ".csv` holds every number above: a line of names, then a row for each measurement; its last columns are "
            "the machine, the BLAS kernels, the threads, the seed and the version of the program. Plots are drawn from "
            "it by the `.gp` files (`gnuplot NAME.gp`), as SVG and PNG.\n";
    for (const StudyFile& file : conclusions.files) text += "`" + file.name + "` belongs to it.\n";
    return text;
}

}  // namespace elastolab
