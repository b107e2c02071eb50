#include "mesh/input/merge.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mesh/numbering.hpp"

namespace elastolab {

namespace {

using Place = std::array<std::uint64_t, 3>;

struct PlaceHash {
    std::size_t operator()(const Place& place) const {
        std::uint64_t hash = 0;
        for (const std::uint64_t word : place) {
            hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 29;
        }
        return hash;
    }
};

Place place_of(const Eigen::Vector3d& p) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x == 0.0 ? 0.0 : x); };
    return {bits(p.x()), bits(p.y()), bits(p.z())};
}

/// Numbers places in the order of their first appearance.
class PlaceNumbers {
public:
    int operator[](const Eigen::Vector3d& p) {
        const auto [entry, added] = numbers_.try_emplace(place_of(p), static_cast<int>(places_.size()));
        if (added) places_.push_back(p);
        return entry->second;
    }
    const std::vector<Eigen::Vector3d>& places() const { return places_; }

private:
    std::unordered_map<Place, int, PlaceHash> numbers_;
    std::vector<Eigen::Vector3d> places_;
};

}  // namespace

SurfaceMesh merged(const SurfaceMesh& mesh) {
    PlaceNumbers numbers;
    std::vector<int> number;
    for (const auto& p : mesh.vertices.colwise()) number.push_back(numbers[p]);
    const std::vector<Eigen::Vector3d>& places = numbers.places();
    SurfaceMesh joined{Positions(3, std::ssize(places)), mesh.triangles};
    for (std::size_t i = 0; i < places.size(); ++i) joined.vertices.col(static_cast<Eigen::Index>(i)) = places[i];
    for (int& v : joined.triangles.reshaped()) v = number[static_cast<std::size_t>(v)];
    return without_unused(joined);
}

}  // namespace elastolab
