#include <optional>

#include "mesh/primitives.hpp"
#include "study/peak_memory.hpp"
#include "study/report/report.hpp"
#include "study/setups.hpp"
#include "study/skip/skip_work.hpp"
#include "study/study.hpp"

namespace elastolab {

namespace {

std::string skip_table(const Table& table) {
    std::vector<std::vector<std::string>> lines;
    for (const Row& row : table.rows)
        lines.push_back({row.text("what"), row.text("method"), duration(row.number("with_s")),
                         duration(row.number("without_s")), times(row.number("without_s") / row.number("with_s"))});
    return markdown_table({"skipped", "method", "time with the skip", "without it", "saved"}, lines);
}

Conclusions conclude_skip(const Table& table) {
    Conclusions conclusions;
    const std::string vertices = table.rows.empty() ? "" : table.rows.front().text("vertices");
    conclusions.findings =
        "A cube of " + vertices +
        " vertices, one face fixed, a patch of the opposite one as a handle. Every skip can be turned off, which is "
        "how "
        "the time without it was measured. That nothing is computed, uploaded or drawn while nothing changes is the "
        "viewer's part, and not measured here.\n\n" +
        skip_table(table);
    Plot plot{.name = "skip", .title = "What each skip saves"};
    plot.caption = "Time without the skip over time with it.";
    plot.body =
        "set datafile separator ','\nset title 'What each skip saves'\nset logscale x\nset format x '%g'\n"
        "set xlabel 'time without the skip / time with it'\nunset key\nset grid x lc rgb '#dddddd' lt 1\n"
        "set border 3\nset tics nomirror\nset yrange [-0.7:*] reverse\nset xrange [0.5:*]\nset lmargin 42\n"
        "plot 'skip.csv' using (column('without_s')/column('with_s')):0:(0.5):(column('without_s')/column('with_s')):"
        "($0-0.35):($0+0.35):ytic(strcol('skip').', '.strcol('method')) with boxxyerror fs solid 0.8 lc rgb "
        "'#0072b2'\n";
    conclusions.plots.push_back(plot);
    return conclusions;
}

}  // namespace

Study make_skip_study(const StudyOptions& options) {
    Study study;
    study.name = "skip";
    study.title = "What is saved by skipping what a scene does not need";
    study.columns = {"skip", "method", "what", "vertices", "with_s", "without_s"};
    for (const Skip& skip : all_skips()) {
        const Row id = Row().set("skip", skip.name).set("method", text(skip.kind));
        study.cases.push_back({id, 1.0, [skip, cells = options.quick ? 5 : 13](Control& control) {
                                   const SkipScene scene(skip.kind, cells, control);
                                   Row row =
                                       Row().set("what", skip.what).set("vertices", scene.body.surface->n_vertices());
                                   row.set("with_s", skip.with(scene)).set("without_s", skip.without(scene));
                                   return std::vector<Row>{row};
                               }});
    }
    study.conclude = [](const Table& table, Control&) { return conclude_skip(table); };
    return study;
}

}  // namespace elastolab
