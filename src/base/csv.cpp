#include "base/csv.hpp"

#include <sstream>

#include "base/text.hpp"

namespace elastolab {

CsvWriter& CsvWriter::text(std::string_view text) {
    if (begun_) out_ << ',';
    begun_ = true;
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
        out_ << text;
        return *this;
    }
    out_ << '"';
    for (const char c : text) out_ << (c == '"' ? "\"\"" : std::string_view(&c, 1));
    out_ << '"';
    return *this;
}

CsvWriter& CsvWriter::number(double value, int digits) {
    return text(digits == 17 ? exact(value) : formatted("%.*g", digits, value));
}

CsvWriter& CsvWriter::nothing(int n_cells) {
    for (int i = 0; i < n_cells; ++i) text({});
    return *this;
}

void CsvWriter::end_row() {
    out_ << '\n';
    begun_ = false;
}

std::string csv_line(const std::vector<std::string>& fields) {
    std::ostringstream line;
    CsvWriter row(line);
    for (const std::string& field : fields) row.text(one_line(field));
    return std::move(line).str();
}

std::vector<std::string> csv_fields(std::string_view line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

}  // namespace elastolab
