#include "study/report/journal.hpp"

#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/error.hpp"

namespace elastolab {

namespace {

// A line for each row: "row", key, column, text, column, text, ...; after the last of a case: "done", key, number of
// its rows.
constexpr const char* kRow = "row";
constexpr const char* kDone = "done";

std::vector<std::string> fingerprint_of(const Row& origin) {
    std::vector<std::string> fields;
    for (const auto& [column, value] : origin.cells()) fields.push_back(column + "=" + value);
    return fields;
}

/// In words, where two fingerprints differ.
std::string difference(const std::vector<std::string>& theirs, const std::vector<std::string>& ours) {
    if (theirs.size() != ours.size()) return "of another version";
    std::vector<std::string> words;
    for (std::size_t i = 0; i < ours.size(); ++i)
        if (theirs[i] != ours[i]) words.push_back(theirs[i] + ", now " + ours[i]);
    return joined(words);
}

bool has_zeros(const std::string& line) { return line.find('\0') != std::string::npos; }

/// NAME-1.csv for NAME.csv, or the first number that is not taken.
std::filesystem::path free_name_beside(const std::filesystem::path& file) {
    for (int i = 1;; ++i) {
        std::filesystem::path name = file;
        name.replace_filename(file.stem().string() + "-" + std::to_string(i) + file.extension().string());
        if (!std::filesystem::exists(name)) return name;
    }
}

}  // namespace

Journal::Journal(std::filesystem::path file, const Row& origin) : file_(std::move(file)) {
    const std::vector<std::string> fingerprint = fingerprint_of(origin);
    read(fingerprint);
    AtomicFile whole(file_);
    whole.stream() << csv_line(fingerprint) << '\n';
    for (const auto& [key, rows] : finished_) write(whole.stream(), key, rows);
    whole.commit();
    stream_.open(file_, std::ios::app);
    if (!stream_) throw Error(file_.string() + ": cannot be written. Choose another folder with --out.");
}

void Journal::read(const std::vector<std::string>& fingerprint) {
    std::ifstream in(file_);
    std::string line;
    if (!std::getline(in, line)) return;
    const std::vector<std::string> theirs = csv_fields(line);
    read_cases(in);
    if (theirs == fingerprint || finished_.empty()) return;
    const std::filesystem::path aside = free_name_beside(file_);
    std::error_code error;
    std::filesystem::rename(file_, aside, error);
    if (error) throw Error(file_.string() + ": cannot be set aside (" + error.message() + "). Move it elsewhere.");
    notice_ += (notice_.empty() ? "" : " ") + file_.string() + ": its " + std::to_string(finished_.size()) +
               " finished cases are of another run (" + difference(theirs, fingerprint) + "). They are kept as " +
               aside.filename().string() + "; this run starts over.";
    finished_.clear();
}

void Journal::read_cases(std::istream& in) {
    std::string line;
    std::map<std::string, std::vector<Row>> open;
    int n_damaged = 0;
    while (std::getline(in, line) && !in.eof()) {  // a last line without an end was being written
        const std::vector<std::string> fields = csv_fields(line);
        const bool is_row = fields.size() >= 2 && fields[0] == kRow && fields.size() % 2 == 0;
        const bool is_done = fields.size() == 3 && fields[0] == kDone;
        bool whole = false;
        if (is_row && !has_zeros(line)) {
            Row& row = open[fields[1]].emplace_back();
            for (std::size_t i = 2; i < fields.size(); i += 2) row.set(fields[i], fields[i + 1]);
            whole = true;
        } else if (is_done && !has_zeros(line)) {
            auto rows = open.extract(fields[1]);  // too few: some are missing; none: the case was done before
            whole = rows && std::to_string(rows.mapped().size()) == fields[2];
            if (whole) finished_[fields[1]] = std::move(rows.mapped());
        }
        if (!whole) ++n_damaged;
    }
    if (n_damaged > 0)
        notice_ = file_.string() + ": " + std::to_string(n_damaged) +
                  " lines are damaged. The cases that they belong to are computed again.";
}

std::optional<std::vector<Row>> Journal::find(const std::string& key) const {
    const auto found = finished_.find(key);
    if (found == finished_.end()) return std::nullopt;
    return found->second;
}

void Journal::add(const std::string& key, const std::vector<Row>& rows) {
    write(stream_, key, rows);
    if (!stream_.flush())
        throw Error(file_.string() +
                    ": cannot be written any more. Is the disk full, or the size of files limited (ulimit -f)?");
    finished_[key] = rows;
}

void Journal::write(std::ostream& out, const std::string& key, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        std::vector<std::string> fields = {kRow, key};
        for (const auto& [column, text] : row.cells()) {
            fields.push_back(column);
            fields.push_back(text);
        }
        out << csv_line(fields) << '\n';
    }
    out << csv_line({kDone, key, std::to_string(rows.size())}) << '\n';
}

void Journal::remove() {
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
}

}  // namespace elastolab
