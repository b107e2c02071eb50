#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/study.hpp"
#include "study/report/table.hpp"

namespace elastolab {

/// README.md of a finished study in `folder`: machine, the command that reproduces it, findings, plots, files.
std::string report(const Study& study, const Conclusions& conclusions, const Table& table, const std::string& folder);

/// A Markdown table: a title for each column, then the rows.
std::string markdown_table(const std::vector<std::string>& titles, const std::vector<std::vector<std::string>>& rows);

/// A number for people: three significant digits, "-" when it is not a number.
std::string short_number(double value);
/// A computed count for people: "1016", "-" when it is not a number.
std::string count(double value);
/// A ratio for people: "4.2 times".
std::string times(double value);
/// "1.3 %"
std::string percent(double share);
/// A duration for people, "-" when it is not a number.
std::string duration(double seconds);

}  // namespace elastolab
