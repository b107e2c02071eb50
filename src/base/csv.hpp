#pragma once

#include <concepts>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace elastolab {

/// Writes a table as CSV (RFC 4180), cell by cell: text with a comma, a quote or a line break is quoted, numbers have
/// all their digits. The stream outlives it.
class CsvWriter {
public:
    explicit CsvWriter(std::ostream& out) : out_(out) {}

    CsvWriter& text(std::string_view text);
    /// 17 significant digits, or as many as are asked for.
    CsvWriter& number(double value, int digits = 17);
    CsvWriter& number(std::integral auto value) { return text(std::to_string(value)); }
    CsvWriter& numbers(const auto& values) {
        for (const double value : values) number(value);
        return *this;
    }
    /// Empty cells, where nothing is known.
    CsvWriter& nothing(int n_cells = 1);
    void end_row();

private:
    std::ostream& out_;
    bool begun_ = false;  ///< this row has a cell
};

/// One line of CSV, without its end; line breaks inside fields become spaces.
std::string csv_line(const std::vector<std::string>& fields);
/// The fields of one line of CSV.
std::vector<std::string> csv_fields(std::string_view line);

}  // namespace elastolab
