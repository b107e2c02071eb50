#include "study/report/journal.hpp"

#include "base/error.hpp"

namespace elastolab {

namespace {

// A line for each row: "row", key, column, text, column, text, ...; after the last of a case: "done", key.
constexpr const char* kRow = "row";
constexpr const char* kDone = "done";

}  // namespace

Journal::Journal(std::filesystem::path file, const std::string& fingerprint) : file_(std::move(file)) {
    read(fingerprint);
    stream_.open(file_, std::ios::trunc);
    stream_ << csv_line({fingerprint}) << '\n';
    for (const auto& [key, rows] : finished_) write(key, rows);
    if (!stream_.flush()) throw Error(file_.string() + ": cannot be written. Choose another folder with --out.");
}

void Journal::read(const std::string& fingerprint) {
    std::ifstream in(file_);
    std::string line;
    if (!std::getline(in, line) || line != csv_line({fingerprint})) return;
    std::map<std::string, std::vector<Row>> open;
    while (std::getline(in, line)) {
        const std::vector<std::string> fields = csv_fields(line);
        if (in.eof() || fields.size() < 2) return;  // the last line has no end: it was being written
        if (fields[0] == kDone) finished_[fields[1]] = std::move(open[fields[1]]);
        if (fields[0] != kRow) continue;
        Row& row = open[fields[1]].emplace_back();
        for (std::size_t i = 2; i + 1 < fields.size(); i += 2) row.set(fields[i], fields[i + 1]);
    }
}

std::optional<std::vector<Row>> Journal::find(const std::string& key) const {
    const auto found = finished_.find(key);
    if (found == finished_.end()) return std::nullopt;
    return found->second;
}

void Journal::add(const std::string& key, const std::vector<Row>& rows) {
    write(key, rows);
    if (!stream_.flush()) throw Error(file_.string() + ": cannot be written any more. Is the disk full?");
    finished_[key] = rows;
}

void Journal::write(const std::string& key, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        std::vector<std::string> fields = {kRow, key};
        for (const auto& [column, text] : row.cells()) {
            fields.push_back(column);
            fields.push_back(text);
        }
        stream_ << csv_line(fields) << '\n';
    }
    stream_ << csv_line({kDone, key}) << '\n';
}

void Journal::remove() {
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
}

}  // namespace elastolab
