#include "app/files/series.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "app/files/export_source.hpp"
#include "base/atomic_file.hpp"
#include "base/control.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

std::string step_name(const fs::path& list, std::size_t number) {
    std::array<char, 32> ending{};
    std::snprintf(ending.data(), ending.size(), "-%04zu.vtp", number);
    return list.stem().string() + ending.data();
}

}  // namespace

bool is_part_of_series(const fs::path& list, const fs::path& file) {
    if (list.empty() || file.empty()) return false;
    if (fs::absolute(list).lexically_normal().parent_path() != fs::absolute(file).lexically_normal().parent_path())
        return false;
    const std::string name = file.filename().string(), start = list.stem().string() + "-", end = ".vtp";
    if (name.size() < start.size() + end.size() || !name.starts_with(start) || !name.ends_with(end)) return false;
    const std::string number = name.substr(start.size(), name.size() - start.size() - end.size());
    return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
}

SeriesWriter::SeriesWriter(fs::path list) : list_(std::move(list)) { AtomicFile::require_writable(list_); }

void SeriesWriter::add(double seconds, const LiveScene& scene, const EmbeddedRunner& answer) {
    const ExportSource source = export_source(scene, answer);
    if (!source.deformer) return;
    if (last_.size() == source.displacement.size() && last_ == source.displacement) return;
    const std::string name = step_name(list_, steps_.size());
    Control never_cancelled;
    write_export(list_.parent_path() / name, source, never_cancelled);
    steps_.push_back({seconds, name});
    last_ = source.displacement;
}

void SeriesWriter::finish() const {
    std::vector<SeriesStep> steps = steps_;
    const auto is_late = [](const SeriesStep& a, const SeriesStep& b) { return !(a.time < b.time); };
    if (std::adjacent_find(steps.begin(), steps.end(), is_late) != steps.end())  // recorded without a clock
        for (std::size_t i = 0; i < steps.size(); ++i) steps[i].time = static_cast<double>(i);
    AtomicFile file(list_);
    write_pvd(file.stream(), steps);
    file.commit();
}

}  // namespace elastolab
