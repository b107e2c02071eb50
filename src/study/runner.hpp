#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "study/report/progress.hpp"
#include "study/study.hpp"

namespace elastolab {

/// Where and how a study runs.
struct RunSettings {
    std::filesystem::path folder;
    StudyOptions options;
    bool fresh = false;        ///< do not resume a stopped run
    bool report_only = false;  ///< run nothing: plots and report from the existing STUDY.csv
    /// Called after each case with its key and seconds (0: finished in an earlier run).
    std::function<void(const std::string& key, double seconds)> on_case = [](const std::string&, double) {};
    /// Called with what the person should know before the first case runs.
    std::function<void(const std::string& notice)> on_notice = [](const std::string&) {};
};

/// What a run has produced.
struct RunResult {
    Table table;
    std::vector<std::filesystem::path> files;
    std::vector<std::string> warnings;  ///< plots that could not be drawn
};

/// Runs the cases that are not finished yet, then writes STUDY.csv, plots with their scripts, and README.md. Until all
/// cases are done they are kept in STUDY.partial.csv, from which the next run goes on when program, machine, threads,
/// seed and options are the same; otherwise the file is kept under another name. Two runs at a time in one folder
/// are refused.
///
/// STUDY.csv: a header, the study's columns, `note`, then those of provenance().
/// Throws Error when a file cannot be written (or, for the report only, read), Cancelled (the finished cases are kept).
RunResult run_study(const Study& study, const RunSettings& settings, StudyProgress& progress, Control& control);

/// Cells that every row carries: version, cpu, cores, memory_bytes, blas_kernels, threads, seed, quick.
Row provenance(const StudyOptions& options);

}  // namespace elastolab
