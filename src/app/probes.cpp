#include "app/probes.hpp"

#include <algorithm>

#include "app/names.hpp"
#include "base/atomic_file.hpp"
#include "base/csv.hpp"

namespace elastolab {

namespace {

/// Columns for numbers that may be unknown.
template <class Numbers>
void add_if_known(CsvWriter& row, const std::optional<Numbers>& numbers) {
    if (numbers)
        row.numbers(*numbers);
    else
        row.nothing(static_cast<int>(Numbers::SizeAtCompileTime));
}

}  // namespace

ProbeValue probe(int vertex, const Positions& rest, const ShownBody& body, double deformation_scale) {
    ProbeValue value;
    value.displacement = (body.positions().col(vertex) - rest.col(vertex)) / deformation_scale;
    value.position = rest.col(vertex) + value.displacement;
    const std::vector<float>& values = body.values();
    const auto place = static_cast<std::size_t>(vertex);
    if (place < values.size() && std::isfinite(values[place])) value.field = values[place];
    if (vertex < body.tractions().cols()) {
        value.traction = body.tractions().col(vertex);
        value.stress = body.stresses().col(vertex);
    }
    return value;
}

void Probes::toggle(int vertex) {
    if (std::erase(vertices_, vertex) == 0) {
        vertices_.push_back(vertex);
        return;
    }
    for (Sample& sample : samples_)
        std::erase_if(sample.values, [&](const auto& value) { return value.first == vertex; });
    if (vertices_.empty()) clear();
}

void Probes::clear() { *this = Probes(); }

void Probes::record(double seconds, const Positions& rest, const ShownBody& body, const DisplaySettings& display,
                    MethodKind reference, const ProbeSource& source) {
    if (vertices_.empty() || display.deformation_scale == 0.0) return;
    const bool is_new = samples_.empty() || body.revision() != recorded_;
    if (!is_new && samples_.back().values.size() == vertices_.size()) return;
    recorded_ = body.revision();
    if (is_new)
        samples_.push_back({seconds, display.field, field_title(display.field, reference, display.units), source, {}});
    Sample& sample = samples_.back();  // vertices are kept in the order in which they were added
    for (std::size_t i = sample.values.size(); i < vertices_.size(); ++i)
        sample.values.emplace_back(vertices_[i], probe(vertices_[i], rest, body, display.deformation_scale));
    if (samples_.size() > kMostSamples) samples_.pop_front();
}

std::vector<float> Probes::series(std::size_t probe, Field field) const {
    std::vector<float> result;
    for (const Sample& sample : samples_) {
        if (sample.field != field || probe >= sample.values.size()) continue;  // not kept yet
        const ProbeValue& value = sample.values[probe].second;
        if (field == Field::none)
            result.push_back(static_cast<float>(value.displacement.norm()));
        else if (value.field)
            result.push_back(static_cast<float>(*value.field));
    }
    return result;
}

void Probes::write_csv(const std::filesystem::path& file) const {
    AtomicFile out(file);
    out.stream() << "time_s,field,vertex,x,y,z,ux,uy,uz,value,tx,ty,tz,sxx,syy,szz,sxy,syz,sxz,method,state\n";
    CsvWriter row(out.stream());
    for (const Sample& sample : samples_)
        for (const auto& [vertex, value] : sample.values) {
            row.number(sample.seconds).text(sample.title).number(vertex);
            row.numbers(value.position).numbers(value.displacement);
            if (value.field)
                row.number(*value.field);
            else
                row.nothing();
            add_if_known(row, value.traction);
            add_if_known(row, value.stress);
            row.text(sample.source.method).text(sample.source.state);
            row.end_row();
        }
    out.commit();
}

}  // namespace elastolab
