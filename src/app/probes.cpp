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
    samples_.clear();  // rows of one length
    recorded_ = 0;
    if (std::erase(vertices_, vertex) == 0) vertices_.push_back(vertex);
}

void Probes::clear() { *this = Probes(); }

void Probes::record(double seconds, const Positions& rest, const ShownBody& body, const DisplaySettings& display) {
    if (vertices_.empty() || body.revision() == recorded_ || display.deformation_scale == 0.0) return;
    recorded_ = body.revision();
    Sample sample{seconds, field_title(display.field, body.kind()), {}};
    for (const int vertex : vertices_) sample.values.push_back(probe(vertex, rest, body, display.deformation_scale));
    samples_.push_back(std::move(sample));
    if (samples_.size() > kMostSamples) samples_.pop_front();
}

std::vector<float> Probes::series(std::size_t probe) const {
    std::vector<float> result;
    for (const Sample& sample : samples_) {
        const ProbeValue& value = sample.values[probe];
        result.push_back(static_cast<float>(value.field.value_or(value.displacement.norm())));
    }
    return result;
}

void Probes::write_csv(const std::filesystem::path& file) const {
    AtomicFile out(file);
    out.stream() << "time_s,field,vertex,x,y,z,ux,uy,uz,value,tx,ty,tz,sxx,syy,szz,sxy,syz,sxz\n";
    CsvWriter row(out.stream());
    for (const Sample& sample : samples_)
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            const ProbeValue& value = sample.values[i];
            row.number(sample.seconds).text(sample.field).number(vertices_[i]);
            row.numbers(value.position).numbers(value.displacement);
            if (value.field)
                row.number(*value.field);
            else
                row.nothing();
            add_if_known(row, value.traction);
            add_if_known(row, value.stress);
            row.end_row();
        }
    out.commit();
}

}  // namespace elastolab
