#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/picture/shown_body.hpp"

namespace elastolab {

/// What is shown at one vertex.
struct ProbeValue {
    Eigen::Vector3d position, displacement;   ///< true to scale, whatever the picture's [L]
    std::optional<double> field;              ///< the value that is coloured, where there is one
    std::optional<Eigen::Vector3d> traction;  ///< [force / L^2], where it is known; likewise:
    std::optional<StressNumbers> stress;
};
ProbeValue probe(int vertex, const Positions& rest, const ShownBody& body, double deformation_scale);

/// Whose answer values are of, and how far it is: "exact", "converging", "following" or "preview".
struct ProbeSource {
    std::string method, state;
};

/// Vertices whose values a person keeps an eye on, and what these were over the last changes. Owned by one thread.
class Probes {
public:
    static constexpr std::size_t kMostSamples = 100000;

    /// Keeps the vertex from now on, or forgets it and what was recorded there.
    void toggle(int vertex);
    void clear();
    const std::vector<int>& vertices() const { return vertices_; }

    /// Adds what is shown now, when that is not what was added last. `seconds`: of the clock of frames.
    void record(double seconds, const Positions& rest, const ShownBody& body, const DisplaySettings& display,
                MethodKind reference, const ProbeSource& source);
    std::size_t n_samples() const { return samples_.size(); }
    /// Samples of one probe since it is kept, oldest first, where they are known: of this field, or, where it is none,
    /// how far the vertex has moved [L].
    std::vector<float> series(std::size_t probe, Field field) const;
    /// Rows of time_s,field,vertex,x,y,z,ux,uy,uz,value,tx,ty,tz,sxx,syy,szz,sxy,syz,sxz,method,state. Throws Error
    /// when it cannot be written.
    void write_csv(const std::filesystem::path& file) const;

private:
    struct Sample {
        double seconds;
        Field field;
        std::string title;  ///< of the field, with its unit
        ProbeSource source;
        std::vector<std::pair<int, ProbeValue>> values;  ///< of the vertices that were kept then
    };
    std::vector<int> vertices_;
    std::deque<Sample> samples_;
    std::uint64_t recorded_ = 0;  ///< revision of the body
};

}  // namespace elastolab
