#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "study/report/plot.hpp"
#include "study/report/table.hpp"

namespace elastolab {

/// What a study is asked for.
struct StudyOptions {
    bool quick = false;  ///< small sizes, about a minute: to see that it works
    unsigned seed = 1;   ///< of the known nodes of `paper` and the edits of `stability`; all else is always the same
};

/// One measurement of a study, independent of all others.
struct Case {
    Row id;               ///< cells of all its rows; no two cases have the same
    double weight = 1.0;  ///< share of the running time, for the time left
    /// An Error that it throws becomes the `note` of a row.
    std::function<std::vector<Row>(Control&)> run;

    std::string key() const;
};

/// A file beside the table, with its text.
struct StudyFile {
    std::string name;
    std::string text;
};

/// What follows from the rows of a study.
struct Conclusions {
    std::string findings;  ///< Markdown; every number in it comes from the rows
    std::vector<Plot> plots;
    std::vector<StudyFile> files;
};

/// A list of cases, and what to make of their rows.
struct Study {
    std::string name;   ///< also of its files
    std::string title;  ///< one line
    std::vector<std::string> columns;
    std::vector<Case> cases;
    std::function<Conclusions(const Table&, Control&)> conclude;
};

/// A study by name, made for some options.
struct StudyEntry {
    std::string name, description;
    Study (*make)(const StudyOptions&);
};

/// All studies.
const std::vector<StudyEntry>& studies();

Study make_paper_study(const StudyOptions& options);
Study make_error_study(const StudyOptions& options);
Study make_stability_study(const StudyOptions& options);
Study make_scale_study(const StudyOptions& options);
Study make_skip_study(const StudyOptions& options);
Study make_large_study(const StudyOptions& options);

}  // namespace elastolab
