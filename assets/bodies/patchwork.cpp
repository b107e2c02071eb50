#include "bodies/patchwork.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace elastolab::bodies {

namespace {

using Triangle = Patchwork::Triangle;

bool has(const Triangle& t, int v) { return t[0] == v || t[1] == v || t[2] == v; }

Triangle with(Triangle t, int from, int to) {
    std::replace(t.begin(), t.end(), from, to);
    return t;
}

double rounded(double x) {
    const double r = std::round(x * 1e5) / 1e5;
    return r == 0.0 ? 0.0 : r;  // no minus zero
}

}  // namespace

int Patchwork::add_vertex(const Eigen::Vector3d& place, Sheets sheets) {
    places_.push_back(place);
    sheets_.push_back(sheets);
    around_.emplace_back();
    return n_vertices() - 1;
}

void Patchwork::add_triangle(const Triangle& corners, int sheet) {
    triangles_.push_back(corners);
    sheet_.push_back(sheet);
    attach(n_triangles() - 1);
}

int Patchwork::rank(int v) const { return std::popcount(sheets(v)); }

void Patchwork::attach(int t) {
    for (int v : triangle(t)) around_[static_cast<std::size_t>(v)].push_back(t);
}

void Patchwork::detach(int t) {
    for (int v : triangle(t)) std::erase(around_[static_cast<std::size_t>(v)], t);
}

void Patchwork::replace(int t, const Triangle& corners) {
    detach(t);
    triangles_[static_cast<std::size_t>(t)] = corners;
    if (corners[0] >= 0) attach(t);
}

std::vector<int> Patchwork::neighbours(int v) const {
    std::vector<int> found;
    for (int t : around(v))
        for (int w : triangle(t))
            if (w != v) found.push_back(w);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

std::vector<std::array<int, 2>> Patchwork::edges() const {
    std::vector<std::array<int, 2>> found;
    for (int v = 0; v < n_vertices(); ++v)
        for (int w : neighbours(v))
            if (v < w) found.push_back({v, w});
    return found;
}

Patchwork::Wing Patchwork::wing(int a, int b) const {
    Wing wing;
    for (int t : around(a)) {
        const Triangle& c = triangle(t);
        for (std::size_t i = 0; i < 3; ++i) {
            const int next = c[(i + 1) % 3], tip = c[(i + 2) % 3];
            if (c[i] == a && next == b) wing.left = t, wing.left_tip = tip;
            if (c[i] == b && next == a) wing.right = t, wing.right_tip = tip;
        }
    }
    return wing;
}

int Patchwork::split(int a, int b, const Eigen::Vector3d& place) {
    const Wing w = wing(a, b);
    const int middle = add_vertex(place, Sheets{1} << sheet(w.left) | Sheets{1} << sheet(w.right));
    for (int t : {w.left, w.right}) {
        const Triangle whole = triangle(t);
        replace(t, with(whole, b, middle));
        add_triangle(with(whole, a, middle), sheet(t));
    }
    return middle;
}

bool Patchwork::may_collapse(int a, int b) const {
    const std::vector<int> of_a = neighbours(a), of_b = neighbours(b);
    std::vector<int> common;
    std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
    return common.size() == 2 && of_a.size() + of_b.size() > 6;
}

void Patchwork::collapse(int a, int b) {
    const std::vector<int> triangles = around(a);
    for (int t : triangles) replace(t, has(triangle(t), b) ? Triangle{-1, -1, -1} : with(triangle(t), a, b));
}

void Patchwork::flip(int a, int b) {
    const Wing w = wing(a, b);
    replace(w.left, {w.left_tip, a, w.right_tip});
    replace(w.right, {w.right_tip, b, w.left_tip});
}

SurfaceMesh Patchwork::surface() const {
    std::vector<int> number(places_.size(), -1), order;
    std::vector<Triangle> kept;
    for (int t = 0; t < n_triangles(); ++t) {
        if (!exists(t)) continue;
        kept.push_back(triangle(t));
        for (int& v : kept.back()) {
            int& n = number[static_cast<std::size_t>(v)];
            if (n < 0) n = static_cast<int>(order.size()), order.push_back(v);
            v = n;
        }
    }
    SurfaceMesh mesh;
    mesh.vertices.resize(3, std::ssize(order));
    mesh.triangles.resize(3, std::ssize(kept));
    for (int v = 0; v < mesh.n_vertices(); ++v)
        mesh.vertices.col(v) = place(order[static_cast<std::size_t>(v)]).unaryExpr(&rounded);
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (int c = 0; c < 3; ++c)
            mesh.triangles(c, t) = kept[static_cast<std::size_t>(t)][static_cast<std::size_t>(c)];
    return mesh;
}

}  // namespace elastolab::bodies
