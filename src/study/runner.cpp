#include "study/runner.hpp"

#include <fstream>
#include <optional>
#include <sstream>

#include "base/atomic_file.hpp"
#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/machine.hpp"
#include "base/timer.hpp"
#include "base/version.hpp"
#include "study/report/folder_lock.hpp"
#include "study/report/journal.hpp"
#include "study/report/report.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

/// A number that changes with the running program (FNV-1a), so that rows of an older build are not taken over.
std::uint64_t program_hash() {
    std::ifstream file("/proc/self/exe", std::ios::binary);
    std::uint64_t hash = 14695981039346656037ULL;
    std::vector<char> block(1 << 16);
    while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
        for (std::streamsize i = 0; i < file.gcount(); ++i)
            hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) * 1099511628211ULL;
    return hash;
}

/// What must be the same for the rows of a stopped run to be taken over.
Row origin_of(const Study& study, const StudyOptions& options) {
    return Row().set("study", study.name).add(provenance(options)).set("build", std::to_string(program_hash()));
}

std::vector<std::string> columns_of(const Study& study, const Row& origin) {
    std::vector<std::string> columns = study.columns;
    columns.emplace_back("note");
    for (const auto& cell : origin.cells()) columns.push_back(cell.first);
    return columns;
}

std::vector<Row> run_case(const Case& one, Control& control) {
    std::vector<Row> rows;
    try {
        rows = one.run(control);
    } catch (const Error& error) {
        control.checkpoint();
        rows.push_back(Row().set("note", error.what()));
    }
    for (Row& row : rows) row = Row(one.id).add(row);
    return rows;
}

Table run_cases(const Study& study, const RunSettings& settings, Journal& journal, StudyProgress& progress,
                Control& control) {
    double weight = 0.0;
    for (const Case& one : study.cases)
        if (!journal.find(one.key())) weight += one.weight;
    progress.begin(static_cast<int>(study.cases.size()), journal.n_finished(), weight);
    const Row origin = provenance(settings.options);
    Table table{columns_of(study, origin), {}};
    for (const Case& one : study.cases) {
        control.checkpoint();
        std::optional<std::vector<Row>> rows = journal.find(one.key());
        if (!rows) {
            const Stopwatch watch;
            progress.begin_case(one.key());
            rows = run_case(one, control);
            journal.add(one.key(), *rows);
            progress.end_case(one.weight);
            settings.on_case(one.key(), watch.seconds());
        }
        for (const Row& row : *rows) table.rows.push_back(Row(row).add(origin));
    }
    return table;
}

/// The table of an earlier run.
Table read_table(const fs::path& path, const std::vector<std::string>& columns) {
    std::ifstream in(path);
    if (!in) throw Error(path.string() + ": cannot be read. Run the study without --report first.");
    const auto damaged = [&](const std::string& finding) {
        return Error(path.string() + ": " + finding + ". It is damaged or of another version; run the study again.");
    };
    try {
        Table table = read_csv(in);
        if (table.columns != columns) throw Error("has not the columns of this study");
        if (table.rows.empty()) throw Error("has no rows");
        return table;
    } catch (const Error& error) {
        throw damaged(error.what());
    }
}

void write_file(const fs::path& path, const std::string& text, RunResult& result) {
    AtomicFile file(path);
    file.stream() << text;
    file.commit();
    result.files.push_back(path);
}

void draw_plots(const std::vector<Plot>& plots, const std::string& csv, const fs::path& folder, RunResult& result,
                Control& control) {
    for (const Plot& plot : plots)
        write_file(folder / (plot.name + ".gp"), gnuplot_script(plot, plot.csv.empty() ? csv : plot.csv), result);
    for (const Plot& plot : plots) {
        const std::string failure = draw(plot.name, folder, control);
        if (!failure.empty()) {
            result.warnings.push_back(failure);
            return;
        }
        for (const char* kind : {".svg", ".png"}) result.files.push_back(folder / (plot.name + kind));
    }
}

}  // namespace

std::string Case::key() const {
    std::string key;
    for (const auto& [column, text] : id.cells()) key += (key.empty() ? "" : " ") + text;
    return key;
}

Row provenance(const StudyOptions& options) {
    const Machine machine = this_machine();
    return Row()
        .set("version", std::string(version()))
        .set("cpu", machine.cpu)
        .set("cores", machine.cores)
        .set("memory_bytes", machine.memory_bytes)
        .set("blas_kernels", blas_kernels())
        .set("threads", thread_count())
        .set("seed", options.seed)
        .set("quick", std::string(options.quick ? "yes" : "no"));
}

namespace {

/// Plots, files and report.
void write_conclusions(const Study& study, const RunSettings& settings, RunResult& result, Control& control) {
    const Conclusions conclusions = study.conclude(result.table, control);
    for (const StudyFile& file : conclusions.files) write_file(settings.folder / file.name, file.text, result);
    draw_plots(conclusions.plots, study.name + ".csv", settings.folder, result, control);
    write_file(settings.folder / "README.md", report(study, conclusions, result.table, settings.folder.string()),
               result);
}

}  // namespace

RunResult run_study(const Study& study, const RunSettings& settings, StudyProgress& progress, Control& control) {
    RunResult result;
    std::error_code error;
    if (!settings.report_only) fs::create_directories(settings.folder, error);
    if (error) throw Error(settings.folder.string() + ": cannot be made (" + error.message() + "). Choose another.");
    const FolderLock lock(settings.folder);
    const fs::path csv = settings.folder / (study.name + ".csv");
    if (settings.report_only) {
        result.table = read_table(csv, columns_of(study, provenance(settings.options)));
        write_conclusions(study, settings, result, control);
        return result;
    }
    for (const fs::path& output : {csv, settings.folder / "README.md"}) AtomicFile::require_writable(output);
    const fs::path journal_file = settings.folder / (study.name + ".partial.csv");
    if (settings.fresh) fs::remove(journal_file, error);
    Journal journal(journal_file, origin_of(study, settings.options));
    if (!journal.notice().empty()) settings.on_notice(journal.notice());
    result.table = run_cases(study, settings, journal, progress, control);
    std::ostringstream text;
    write_csv(text, result.table);
    write_file(csv, text.str(), result);
    write_conclusions(study, settings, result, control);
    journal.remove();
    return result;
}

}  // namespace elastolab
