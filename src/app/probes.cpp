#include "app/probes.hpp"

#include <algorithm>
#include <iomanip>

#include "base/atomic_file.hpp"

namespace elastolab {

namespace {

/// One more column of a row: a number of what may not be known.
template <class Numbers>
void write_optional(std::ostream& out, const std::optional<Numbers>& numbers, int i) {
    out << ',';
    if (numbers) out << (*numbers)[i];
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
    out.stream() << "time_s,field,vertex,x,y,z,ux,uy,uz,value,tx,ty,tz,sxx,syy,szz,sxy,syz,sxz\n"
                 << std::setprecision(17);
    for (const Sample& sample : samples_)
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            const ProbeValue& value = sample.values[i];
            out.stream() << sample.seconds << ',' << sample.field << ',' << vertices_[i];
            for (const Eigen::Vector3d& vector : {value.position, value.displacement})
                for (int axis = 0; axis < 3; ++axis) out.stream() << ',' << vector[axis];
            out.stream() << ',';
            if (value.field) out.stream() << *value.field;
            for (int axis = 0; axis < 3; ++axis) write_optional(out.stream(), value.traction, axis);
            for (int number = 0; number < 6; ++number) write_optional(out.stream(), value.stress, number);
            out.stream() << '\n';
        }
    out.commit();
}

}  // namespace elastolab
