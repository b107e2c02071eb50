#include "fuzz/body_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace elastolab::fuzz {

namespace {

using Json = nlohmann::ordered_json;
using Point = std::array<double, 3>;
using Triangle = std::array<int, 3>;

struct Body {
    std::vector<Point> points;
    std::vector<Triangle> triangles;

    template <class Map>
    Body& move(const Map& map) {
        for (Point& p : points) p = map(p);
        return *this;
    }
};

/// [0, size] in cells of two triangles, its faces outward.
Body box(std::array<int, 3> cells, Point size) {
    Body body;
    std::map<std::array<int, 3>, int> known;
    const auto corner = [&](const std::array<int, 3>& at) {
        const auto [place, is_new] = known.try_emplace(at, static_cast<int>(body.points.size()));
        if (is_new) {
            Point p{};
            for (std::size_t c = 0; c < 3; ++c) p[c] = size[c] * at[c] / cells[c];
            body.points.push_back(p);
        }
        return place->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true}) {
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (int i = 0; i < cells[u]; ++i)
                for (int j = 0; j < cells[v]; ++j) {
                    std::array<int, 4> quad{};
                    for (int k = 0; k < 4; ++k) {
                        std::array<int, 3> at{};
                        at[axis] = upper ? cells[axis] : 0;
                        at[u] = i + (k == 1 || k == 2 ? 1 : 0);
                        at[v] = j + (k >= 2 ? 1 : 0);
                        quad[static_cast<std::size_t>(k)] = corner(at);
                    }
                    if (!upper) std::swap(quad[1], quad[3]);
                    body.triangles.push_back({quad[0], quad[1], quad[2]});
                    body.triangles.push_back({quad[0], quad[2], quad[3]});
                }
        }
    return body;
}

/// A cylinder whose caps are fans around their middles.
Body drum(int n_sides, double height) {
    Body body{{{0, 0, 0}, {0, 0, height}}, {}};
    for (int i = 0; i < n_sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / n_sides;
        body.points.push_back({std::cos(angle), std::sin(angle), 0});
        body.points.push_back({std::cos(angle), std::sin(angle), height});
        const int a = 2 + 2 * i, c = 2 + 2 * ((i + 1) % n_sides);
        body.triangles.insert(body.triangles.end(), {{0, c, a}, {1, a + 1, c + 1}, {a, c, c + 1}, {a, c + 1, a + 1}});
    }
    return body;
}

Body soup(int n_triangles, Random& random) {
    Body body;
    for (int t = 0; t < n_triangles; ++t) {
        for (int k = 0; k < 3; ++k) body.points.push_back({random.unit(), random.unit(), random.unit()});
        body.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return body;
}

Body twisted_bar(double turn) {
    return box({8, 2, 2}, {4, 1, 1}).move([&](const Point& p) {
        const double angle = turn * p[0], y = p[1] - 0.5, z = p[2] - 0.5;
        return Point{p[0], y * std::cos(angle) - z * std::sin(angle), y * std::sin(angle) + z * std::cos(angle)};
    });
}

Body with_triangles_twice(Body body, Random& random) {
    for (std::size_t n = 1 + random.below(5); n > 0; --n) {
        const Triangle again = random.pick(body.triangles);
        body.triangles.push_back(again);
    }
    return body;
}

Body with_holes(Body body, Random& random) {
    for (std::size_t n = 1 + random.below(60); n > 0 && body.triangles.size() > 1; --n)
        body.triangles.erase(body.triangles.begin() + static_cast<std::ptrdiff_t>(random.below(body.triangles.size())));
    return body;
}

/// A cube and a smaller one, inside, across or beside it, and facing either way.
Body nested(Random& random) {
    Body body = box({3, 3, 3}, {1, 1, 1});
    const double offset = random.pick(std::array{0.1, 0.25, 0.6, -0.25, 1.5});
    const Body other = box({1, 1, 1}, {0.5, 0.5, 0.5}).move([&](const Point& p) {
        return Point{p[0] + offset, p[1] + offset, p[2] + offset};
    });
    const bool is_cavity = random.once_in(2);
    const int first = static_cast<int>(body.points.size());
    body.points.insert(body.points.end(), other.points.begin(), other.points.end());
    for (Triangle t : other.triangles) {
        if (is_cavity) std::swap(t[0], t[1]);
        body.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return body;
}

Body random_shape(Random& random) {
    const auto cells = [&](int most) { return 1 + static_cast<int>(random.below(static_cast<std::size_t>(most))); };
    const double thin = std::pow(10.0, -8.0 * random.unit());
    switch (random.below(9)) {
        case 0:
            return box({cells(6), cells(6), 1}, {1, 1, thin});
        case 1:
            return box({1 + cells(11), 1, 1}, {1, thin, thin});
        case 2:
            return drum(random.pick(std::array{3, 4, 5, 12, 60, 140}), thin);
        case 3:
            return box({3, 3, 3}, {1, 1, 1}).move([&](const Point& p) {
                return Point{p[0] + 50.0 * thin * p[2], p[1], p[2]};
            });
        case 4:
            return with_triangles_twice(box({3, 2, 2}, {1, 1, 1}), random);
        case 5:
            return with_holes(box({4, 4, 4}, {1, 1, 1}), random);
        case 6:
            return twisted_bar(6.0 * random.unit());
        case 7:
            return soup(random.pick(std::array{1, 3, 10, 25}), random);
        default:
            return nested(random);
    }
}

std::string off_text(const Body& body) {
    std::string text =
        "OFF\n" + std::to_string(body.points.size()) + " " + std::to_string(body.triangles.size()) + " 0\n";
    for (const Point& p : body.points) {
        std::array<char, 128> line{};
        std::snprintf(line.data(), line.size(), "%.17g %.17g %.17g\n", p[0], p[1], p[2]);
        text += line.data();
    }
    for (const Triangle& t : body.triangles)
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    return text;
}

/// The lowest and the highest coordinates.
std::pair<Point, Point> corners(const Body& body) {
    std::pair<Point, Point> result{body.points.front(), body.points.front()};
    for (const Point& p : body.points)
        for (std::size_t c = 0; c < 3; ++c) {
            result.first[c] = std::min(result.first[c], p[c]);
            result.second[c] = std::max(result.second[c], p[c]);
        }
    return result;
}

/// What acts on the selected end: one way of each kind that a scene knows.
void act(Json& scene, const Json& end, double length, Random& random) {
    const double size = random.pick(std::array{1e-6, 1.0, 1e6});
    const auto any = [&] { return 2.0 * random.unit() - 1.0; };
    const auto put = [&](const char* list, const char* key, Json value) {
        Json one = {{"select", end}};
        one[key] = std::move(value);
        scene[list] = Json::array({std::move(one)});
    };
    switch (random.below(7)) {
        case 0:
            return put("handles", "translate", {0.1 * length * any(), 0.1 * length * any(), 0.0});
        case 1:
            return put("handles", "rotate", {{"axis", {any(), any(), 1.0}}, {"degrees", 90 * any()}});
        case 2:
            return put("handles", "force", {size, 0.0, size * any()});
        case 3:
            return put("loads", "traction", {0.0, size, size * any()});
        case 4:
            return put("loads", "pressure", size);
        case 5:
            scene["gravity"] = {0.0, 0.0, -9.81 * size};
            scene["density"] = random.pick(std::array{1.0, 1e3, 1e-6});
            return;
        default:
            return;  // only held
    }
}

/// Nothing holds the body, and a pressure all over it, which balances itself, acts alone.
void blow_up(Json& scene, const Point& low, const Point& high) {
    for (const char* key : {"fixed", "handles", "gravity", "density"}) scene.erase(key);
    const Json everything = {{"box", {{"min", low}, {"max", high}}}};
    scene["loads"] = Json::array({{{"select", everything}, {"pressure", -1e-3}}});
}

}  // namespace

Input make_body(std::uint64_t seed, std::uint64_t number) {
    Random random(seed, number);
    Body body = random_shape(random);
    const double size = random.pick(std::array{1.0, 1.0, 1.0, 1e-3, 1e3, 1e-40, 1e40});
    body.move([&](const Point& p) { return Point{size * p[0], size * p[1], size * p[2]}; });

    const auto [low, high] = corners(body);
    const std::size_t axis = random.below(3);
    const double length = high[axis] - low[axis];
    Point normal{};
    normal[axis] = 1.0;
    const auto slab = [&](const Point& point) -> Json {
        const double tolerance = length * random.pick(std::array{1e-9, 0.1, 0.4});
        return {{"plane", {{"point", point}, {"normal", normal}, {"tolerance", tolerance}}}};
    };
    Json scene = {{"elastolab", 1},
                  {"mesh", {{"file", "body.off"}}},
                  {"material",
                   {{"young_modulus", random.pick(std::array{1.0, 1e5, 1e-10, 1e11})},
                    {"poisson_ratio", random.pick(std::array{0.0, 0.3, 0.45, 0.49, 0.499999, 0.5, -0.5})}}},
                  {"method", random.pick(std::array{"fem", "constant-bem", "linear-bem", "galerkin-bem",
                                                    "quadratic-fem", "nonlinear-fem"})}};
    if (!random.once_in(5)) scene["fixed"] = slab(low);
    act(scene, slab(high), length, random);
    if (random.once_in(8)) blow_up(scene, low, high);
    return {"input.json", scene.dump(1), {{"body.off", off_text(body)}}};
}

}  // namespace elastolab::fuzz
