#pragma once

#include <concepts>
#include <istream>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace elastolab {

/// Names with values, as text, in the order in which they were set.
class Row {
public:
    Row() = default;
    Row(std::initializer_list<std::pair<std::string, std::string>> cells) : cells_(cells) {}

    Row& set(std::string_view column, std::string text);
    /// Six significant digits; nothing when it is not a number.
    Row& set(std::string_view column, double value);
    Row& set(std::string_view column, std::integral auto value) { return set(column, std::to_string(value)); }
    /// Sets all cells of `other`, and overwrites those that are here already.
    Row& add(const Row& other);

    /// Empty when the column is not set.
    const std::string& text(std::string_view column) const;
    /// Not a number when the column is empty or does not begin with one.
    double number(std::string_view column) const;
    const std::vector<std::pair<std::string, std::string>>& cells() const { return cells_; }

    bool operator==(const Row&) const = default;

private:
    std::vector<std::pair<std::string, std::string>> cells_;
};

/// Rows under the same columns.
struct Table {
    std::vector<std::string> columns;
    std::vector<Row> rows;

    /// The rows whose cells equal those of `where`.
    Table where(const Row& where) const;
    /// The different texts of a column, in the order of first appearance; empty ones left out.
    std::vector<std::string> values(std::string_view column) const;
    std::vector<double> numbers(std::string_view column) const;
};

/// Several messages as the text of one cell, separated by semicolons.
std::string joined(const std::vector<std::string>& messages);

/// Header, then a line for each row.
void write_csv(std::ostream& out, const Table& table);
/// Reads what write_csv wrote. Throws Error naming the line when it is no such table, or an incomplete one.
Table read_csv(std::istream& in);

}  // namespace elastolab
