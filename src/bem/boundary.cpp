#include "bem/boundary.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "elasticity/triangle_geometry.hpp"

namespace elastolab {

namespace {

std::size_t as_size(int i) { return static_cast<std::size_t>(i); }

constexpr CollocationPoints::Weight kUnused{-1, 0.0};

}  // namespace

Boundary::Boundary(const SurfaceMesh& mesh) : mesh_(mesh) {
    triangles_.reserve(as_size(mesh.n_triangles()));
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const Eigen::Vector3i v = mesh.triangles.col(t);
        triangles_.push_back(
            make_triangle_geometry(mesh.vertices.col(v[0]), mesh.vertices.col(v[1]), mesh.vertices.col(v[2]), t));
    }
}

CollocationPoints CollocationPoints::subset(std::span<const int> numbers) const {
    CollocationPoints some;
    some.positions.resize(3, static_cast<Eigen::Index>(numbers.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        some.positions.col(static_cast<Eigen::Index>(i)) = positions.col(numbers[i]);
        some.own_triangle.push_back(own_triangle[as_size(numbers[i])]);
        some.weights.push_back(weights[as_size(numbers[i])]);
    }
    return some;
}

void CollocationPoints::append(const CollocationPoints& more) {
    Positions all(3, positions.cols() + more.positions.cols());
    all << positions, more.positions;
    positions = std::move(all);
    own_triangle.insert(own_triangle.end(), more.own_triangle.begin(), more.own_triangle.end());
    weights.insert(weights.end(), more.weights.begin(), more.weights.end());
}

CollocationPoints vertex_collocation_points(const Boundary& boundary) {
    const int n = boundary.mesh().n_vertices();
    CollocationPoints points{boundary.mesh().vertices, std::vector<int>(as_size(n), -1), {}};
    for (int v = 0; v < n; ++v) points.weights.push_back({CollocationPoints::Weight{v, 1.0}, kUnused, kUnused});
    return points;
}

CollocationPoints centroid_collocation_points(const Boundary& boundary) {
    CollocationPoints points;
    points.positions.resize(3, boundary.n_triangles());
    for (int t = 0; t < boundary.n_triangles(); ++t) {
        points.positions.col(t) = Eigen::Map<const Eigen::Vector3d>(boundary.triangle(t).centroid);
        points.own_triangle.push_back(t);
        points.weights.push_back({CollocationPoints::Weight{t, 1.0}, kUnused, kUnused});
    }
    return points;
}

CollocationPoints inner_collocation_points(const Boundary& boundary, std::span<const int> triangles) {
    CollocationPoints points;
    points.positions.resize(3, 3 * static_cast<Eigen::Index>(triangles.size()));
    Eigen::Index next = 0;
    for (const int t : triangles)
        for (int corner = 0; corner < 3; ++corner) {
            const Eigen::Vector3i v = boundary.mesh().triangles.col(t);
            Eigen::Vector3d barycentric = Eigen::Vector3d::Constant(1.0 / 6.0);
            barycentric[corner] = 2.0 / 3.0;
            std::array<CollocationPoints::Weight, 3> weights{};
            Eigen::Vector3d point = Eigen::Vector3d::Zero();
            for (int i = 0; i < 3; ++i) {
                point += barycentric[i] * boundary.mesh().vertices.col(v[i]);
                weights[as_size(i)] = {v[i], barycentric[i]};
            }
            points.positions.col(next++) = point;
            points.own_triangle.push_back(t);
            points.weights.push_back(weights);
        }
    return points;
}

void append(Elements& elements, std::span<const Elements::Element> more, int n_slots) {
    for (Elements::Element element : more) {
        for (int& slot : element.slots)
            if (slot >= 0) slot += elements.n_slots;
        elements.elements.push_back(element);
    }
    elements.n_slots += n_slots;
}

Elements merged(const Elements& elements) {
    Elements result{elements.order, elements.n_slots, {}};
    std::unordered_map<int, std::size_t> last_of_triangle;
    for (const Elements::Element& element : elements.elements) {
        const auto [entry, is_new] = last_of_triangle.try_emplace(element.triangle, result.elements.size());
        const auto fits = [&](const Elements::Element& other) {
            for (std::size_t k = 0; k < 3; ++k)
                if (element.slots[k] >= 0 && other.slots[k] >= 0) return false;
            return true;
        };
        if (is_new || !fits(result.elements[entry->second])) {
            entry->second = result.elements.size();
            result.elements.push_back(element);
        } else {
            auto& slots = result.elements[entry->second].slots;
            for (std::size_t k = 0; k < 3; ++k) slots[k] = std::max(slots[k], element.slots[k]);
        }
    }
    return result;
}

Elements vertex_elements(const Boundary& boundary) {
    Elements elements{Elements::Order::linear, boundary.mesh().n_vertices(), {}};
    for (int t = 0; t < boundary.n_triangles(); ++t) {
        const Eigen::Vector3i v = boundary.mesh().triangles.col(t);
        elements.elements.push_back({t, {v[0], v[1], v[2]}});
    }
    return elements;
}

Elements constant_elements(std::span<const int> triangles) {
    Elements elements{Elements::Order::constant, static_cast<int>(triangles.size()), {}};
    for (const int t : triangles)
        elements.elements.push_back({t, {static_cast<int>(elements.elements.size()), -1, -1}});
    return elements;
}

}  // namespace elastolab
