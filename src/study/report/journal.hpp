#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/report/table.hpp"

namespace elastolab {

/// The finished cases of an unfinished study, in a file: a case's rows are there completely or not at all, so that a
/// stopped or crashed study resumes where it was.
class Journal {
public:
    /// `fingerprint`: what must be the same for rows to be kept. Rows with another one are dropped.
    /// Throws Error when the file cannot be written.
    Journal(std::filesystem::path file, const std::string& fingerprint);

    int n_finished() const { return static_cast<int>(finished_.size()); }
    /// The rows of a case, when it is finished.
    std::optional<std::vector<Row>> find(const std::string& key) const;
    /// Throws Error, say when the disk is full.
    void add(const std::string& key, const std::vector<Row>& rows);
    /// Removes the file.
    void remove();

private:
    void read(const std::string& fingerprint);
    void write(const std::string& key, const std::vector<Row>& rows);

    std::filesystem::path file_;
    std::ofstream stream_;
    std::map<std::string, std::vector<Row>> finished_;
};

}  // namespace elastolab
