#include "app/window/timings.hpp"

#include <algorithm>
#include <cmath>

#include "base/csv.hpp"

namespace elastolab {

void FrameHistory::add(const FrameTimes& times) {
    ring_[next_] = times;
    next_ = (next_ + 1) % kLength;
    size_ = std::min(size_ + 1, kLength);
}

std::vector<float> FrameHistory::series(double FrameTimes::*which) const {
    std::vector<float> values;
    values.reserve(size_);
    for (std::size_t i = 0; i < size_; ++i)
        values.push_back(static_cast<float>(ring_[(next_ + kLength - size_ + i) % kLength].*which));
    return values;
}

double FrameHistory::percentile(double FrameTimes::*which, double q) const {
    std::vector<float> values = series(which);
    if (values.empty()) return 0.0;
    const auto rank = static_cast<std::ptrdiff_t>(std::lround(q * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

TimingsRecorder::TimingsRecorder(const std::filesystem::path& file)
    : path_(file), file_(std::make_unique<AtomicFile>(file)) {
    file_->stream() << "frame,time_s,method,vertices,constrained_vertices,handle_vertices,state,update_ms,upload_ms,"
                       "draw_ms,gui_ms,frame_ms\n";
}

TimingsRecorder::~TimingsRecorder() {
    try {
        finish();
    } catch (const std::exception&) {  // whoever needs to know calls finish()
    }
}

void TimingsRecorder::add(const FrameRecord& record) {
    const FrameTimes& t = record.times;
    CsvWriter row(file_->stream());
    row.number(record.frame).number(record.time_s, 9).text(record.method).number(record.vertices);
    row.number(record.constrained_vertices).number(record.handle_vertices).text(record.state);
    for (const double ms : {t.update_ms, t.upload_ms, t.draw_ms, t.gui_ms, t.frame_ms}) row.number(ms, 6);
    row.end_row();
    ++n_rows_;
}

void TimingsRecorder::finish() {
    if (!file_) return;
    const std::unique_ptr<AtomicFile> file = std::move(file_);
    file->commit();
}

}  // namespace elastolab
