#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {

using Eigen::Vector3d;

namespace {

struct Primitive {
    std::string name;
    std::vector<double> size;  // by default; as many numbers as the primitive has lengths
    SurfaceMesh (*make)(int cells, const std::vector<double>& size);
    double (*n_vertices)(double cells, const std::vector<double>& size);  // about
};

double box_vertices(double cells, const std::vector<double>& s) {
    const double h = *std::min_element(s.begin(), s.end()) / cells;
    return 2.0 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]) / (h * h);
}

const std::array<Primitive, 7>& primitives() {
    using Size = std::vector<double>;
    static const std::array<Primitive, 7> table{{
        {"cube",
         {1.0},
         [](int n, const Size& s) { return make_box(n, Vector3d::Constant(s[0])); },
         [](double n, const Size&) { return 6.0 * n * n; }},
        {"box",
         {1.0, 1.0, 1.0},
         [](int n, const Size& s) {
             return make_box(n, {s[0], s[1], s[2]});
         },
         box_vertices},
        {"sphere",
         {1.0},
         [](int n, const Size& s) { return make_sphere(n, s[0]); },
         [](double n, const Size&) { return 4.0 * n * n; }},
        {"cylinder",
         {0.5, 2.0},
         [](int n, const Size& s) { return make_cylinder(n, s[0], s[1]); },
         [](double n, const Size& s) { return 4.0 * n * (n + 2.0 * n * s[1] / (std::numbers::pi * s[0])); }},
        {"torus",
         {1.0, 0.35},
         [](int n, const Size& s) { return make_torus(n, s[0], s[1]); },
         [](double n, const Size& s) { return 4.0 * n * std::max(4.0, 4.0 * n * s[1] / s[0]); }},
        {"beam",
         {4.0, 1.0, 1.0},
         [](int n, const Size& s) {
             return make_box(n, {s[0], s[1], s[2]});
         },
         box_vertices},
        {"hollow-sphere",
         {1.0, 0.5},
         [](int n, const Size& s) { return make_hollow_sphere(n, s[0], s[1]); },
         [](double n, const Size&) { return 8.0 * n * n; }},
    }};
    return table;
}

const Primitive& find_primitive(const std::string& name) {
    std::string known;
    for (const Primitive& primitive : primitives()) {
        if (primitive.name == name) return primitive;
        known += (known.empty() ? "" : ", ") + primitive.name;
    }
    throw MeshError("primitive '" + name + "' is unknown. Use one of: " + known + ".");
}

void require_sizes(const Primitive& primitive, const std::vector<double>& size) {
    const std::size_t expected = primitive.size.size();
    if (size.size() != expected)
        throw MeshError(primitive.name + ": " + std::to_string(size.size()) + " sizes are given, it has " +
                        std::to_string(expected) + ". Give " + std::to_string(expected) + " or none.");
    for (const double length : size)
        if (!(length > 0.0) || !std::isfinite(length))
            throw MeshError(primitive.name + ": a size is not positive and finite. Give positive lengths.");
    const bool second_is_smaller = primitive.name == "torus" || primitive.name == "hollow-sphere";
    if (second_is_smaller && size[1] >= size[0])
        throw MeshError(primitive.name + ": its second size is not less than its first. Give the larger radius first.");
}

}  // namespace

SurfaceMesh make_primitive(const std::string& name, int cells, const std::vector<double>& size) {
    const Primitive& primitive = find_primitive(name);
    if (cells < 1) throw MeshError(name + ": resolution " + std::to_string(cells) + " is below 1. Give at least 1.");
    const std::vector<double>& lengths = size.empty() ? primitive.size : size;
    require_sizes(primitive, lengths);
    constexpr double kMostVertices = 4e6;  // far beyond what any method can take
    if (!(primitive.n_vertices(cells, lengths) < kMostVertices))
        throw MeshError(name + ": resolution " + std::to_string(cells) +
                        " at these sizes makes more than 4 million vertices. Give a lower resolution.");
    return primitive.make(cells, lengths);
}

std::vector<std::string> primitive_names() {
    std::vector<std::string> names;
    for (const Primitive& primitive : primitives()) names.push_back(primitive.name);
    return names;
}

}  // namespace elastolab
