#include "study/report/table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace elastolab {

Row& Row::set(std::string_view column, std::string text) {
    const auto same =
        std::find_if(cells_.begin(), cells_.end(), [&](const auto& cell) { return cell.first == column; });
    if (same != cells_.end())
        same->second = std::move(text);
    else
        cells_.emplace_back(std::string(column), std::move(text));
    return *this;
}

Row& Row::set(std::string_view column, double value) {
    if (std::isnan(value)) return set(column, std::string());
    return set(column, formatted("%.6g", value));
}

Row& Row::add(const Row& other) {
    for (const auto& [column, text] : other.cells_) set(column, text);
    return *this;
}

const std::string& Row::text(std::string_view column) const {
    static const std::string kNone;
    for (const auto& [name, text] : cells_)
        if (name == column) return text;
    return kNone;
}

double Row::number(std::string_view column) const {
    const std::string& cell = text(column);
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    return end == cell.c_str() ? std::numeric_limits<double>::quiet_NaN() : value;
}

Table Table::where(const Row& where) const {
    Table selected{columns, {}};
    for (const Row& row : rows)
        if (std::all_of(where.cells().begin(), where.cells().end(),
                        [&](const auto& cell) { return row.text(cell.first) == cell.second; }))
            selected.rows.push_back(row);
    return selected;
}

std::vector<std::string> Table::values(std::string_view column) const {
    std::vector<std::string> values;
    for (const Row& row : rows)
        if (const std::string& text = row.text(column);
            !text.empty() && std::find(values.begin(), values.end(), text) == values.end())
            values.push_back(text);
    return values;
}

std::vector<double> Table::numbers(std::string_view column) const {
    std::vector<double> numbers;
    for (const Row& row : rows) numbers.push_back(row.number(column));
    return numbers;
}

std::string joined(const std::vector<std::string>& messages) {
    std::string text;
    for (const std::string& message : messages) text += (text.empty() ? "" : "; ") + message;
    return text;
}

void write_csv(std::ostream& out, const Table& table) {
    out << csv_line(table.columns) << '\n';
    for (const Row& row : table.rows) {
        std::vector<std::string> fields;
        for (const std::string& column : table.columns) fields.push_back(row.text(column));
        out << csv_line(fields) << '\n';
    }
}

Table read_csv(std::istream& in) {
    Table table;
    std::string line;
    const auto fail = [](std::size_t number, const std::string& finding) {
        throw Error("line " + std::to_string(number) + " " + finding);
    };
    for (std::size_t number = 1; std::getline(in, line); ++number) {
        if (in.eof()) fail(number, "has no end");
        if (line.find('\0') != std::string::npos) fail(number, "is not text");
        const std::vector<std::string> fields = csv_fields(line);
        if (number == 1) {
            table.columns = fields;
            continue;
        }
        if (fields.size() != table.columns.size())
            fail(number, "has " + std::to_string(fields.size()) + " cells where " +
                             std::to_string(table.columns.size()) + " belong");
        Row& row = table.rows.emplace_back();
        for (std::size_t i = 0; i < fields.size(); ++i)
            if (!fields[i].empty()) row.set(table.columns[i], fields[i]);
    }
    return table;
}

}  // namespace elastolab
