#include "mesh/input/merge.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

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

SurfaceMesh without_unused(const std::vector<Eigen::Vector3d>& places, Triangles triangles) {
    std::vector<int> number(places.size(), -1);
    for (const int v : triangles.reshaped()) number[static_cast<std::size_t>(v)] = 0;
    std::vector<Eigen::Vector3d> used;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (number[i] == 0) {
            number[i] = static_cast<int>(used.size());
            used.push_back(places[i]);
        }
    SurfaceMesh mesh{Positions(3, static_cast<Eigen::Index>(used.size())), std::move(triangles)};
    for (std::size_t i = 0; i < used.size(); ++i) mesh.vertices.col(static_cast<Eigen::Index>(i)) = used[i];
    for (int& v : mesh.triangles.reshaped()) v = number[static_cast<std::size_t>(v)];
    return mesh;
}

}  // namespace

SurfaceMesh merged(const SurfaceMesh& mesh) {
    PlaceNumbers numbers;
    std::vector<int> number;
    for (const auto& p : mesh.vertices.colwise()) number.push_back(numbers[p]);
    Triangles triangles = mesh.triangles;
    for (int& v : triangles.reshaped()) v = number[static_cast<std::size_t>(v)];
    return without_unused(numbers.places(), std::move(triangles));
}

}  // namespace elastolab
