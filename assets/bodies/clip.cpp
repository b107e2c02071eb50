#include "bodies/clip.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <Eigen/Geometry>
#include <map>
#include <tuple>

namespace elastolab::bodies {

namespace {

using Eigen::Vector3d;
using Sheets = Patchwork::Sheets;
using Tet = std::array<int, 4>;

/// Clips tetrahedra one by one; vertices that they share are made once, so that the pieces fit.
class Clipper {
public:
    explicit Clipper(const Solid& solid) : solid_(solid) {}

    int add_corner(const Vector3d& place) {
        const double least = 1e-3 * solid_.cell;  // no vertex on a sheet by chance
        std::vector<double> values;
        for (const Field& sheet : solid_.sheets) {
            const double value = sheet(place);
            values.push_back(std::abs(value) < least ? least : value);
        }
        return add_vertex(place, std::move(values), 0);
    }
    void clip(const Tet& tet) {
        std::vector<Tet> pieces{tet};
        bool cut = false;
        for (std::size_t sheet = 0; sheet < solid_.sheets.size(); ++sheet) {
            std::vector<Tet> rest;
            for (const Tet& piece : pieces) cut |= clip(piece, sheet, rest);
            pieces = std::move(rest);
        }
        if (!cut) return;
        for (const Tet& piece : pieces) collect(piece);
    }
    Patchwork surface() const;

private:
    int add_vertex(const Vector3d& place, std::vector<double> values, Sheets on) {
        places_.push_back(place);
        values_.push_back(std::move(values));
        on_.push_back(on);
        return static_cast<int>(places_.size()) - 1;
    }
    const Vector3d& place(int v) const { return places_[static_cast<std::size_t>(v)]; }
    double value(int v, std::size_t sheet) const { return values_[static_cast<std::size_t>(v)][sheet]; }

    int crossing(int a, int b, std::size_t sheet);
    bool clip(Tet tet, std::size_t sheet, std::vector<Tet>& rest);
    static void split_prism(const std::array<int, 6>& p, std::vector<Tet>& rest);
    void collect(const Tet& tet);

    const Solid& solid_;
    std::vector<Vector3d> places_;
    std::vector<std::vector<double>> values_;  // of each sheet
    std::vector<Sheets> on_;
    std::map<std::tuple<int, int, std::size_t>, int> crossings_;
    std::vector<std::pair<Patchwork::Triangle, int>> faces_;  // with their sheets
};

int Clipper::crossing(int a, int b, std::size_t sheet) {
    if (a > b) std::swap(a, b);
    const auto [entry, is_new] = crossings_.try_emplace({a, b, sheet}, 0);
    if (!is_new) return entry->second;
    const double t = value(a, sheet) / (value(a, sheet) - value(b, sheet));
    std::vector<double> values;
    for (std::size_t s = 0; s < solid_.sheets.size(); ++s) values.push_back((1.0 - t) * value(a, s) + t * value(b, s));
    const Sheets on = (on_[static_cast<std::size_t>(a)] & on_[static_cast<std::size_t>(b)]) | Sheets{1} << sheet;
    return entry->second = add_vertex((1.0 - t) * place(a) + t * place(b), std::move(values), on);
}

/// Whether the sheet cuts the tetrahedron; what is inside goes into `rest`.
bool Clipper::clip(Tet tet, std::size_t sheet, std::vector<Tet>& rest) {
    const auto inside = [&](int v) { return value(v, sheet) < 0.0; };
    const auto n = std::stable_partition(tet.begin(), tet.end(), inside) - tet.begin();
    const auto [a, b, c, d] = tet;
    const auto x = [&](int v, int w) { return crossing(v, w, sheet); };
    if (n == 4) rest.push_back(tet);
    if (n == 1) rest.push_back({a, x(a, b), x(a, c), x(a, d)});
    if (n == 2) split_prism({a, x(a, c), x(a, d), b, x(b, c), x(b, d)}, rest);
    if (n == 3) split_prism({a, b, c, x(a, d), x(b, d), x(c, d)}, rest);
    return n > 0 && n < 4;
}

/// Into tetrahedra; each four-sided face is cut from its smallest vertex, as its other side does.
void Clipper::split_prism(const std::array<int, 6>& p, std::vector<Tet>& rest) {
    // clang-format off
    static constexpr std::array<std::array<std::size_t, 6>, 6> kTurned{{
        {0, 1, 2, 3, 4, 5}, {1, 2, 0, 4, 5, 3}, {2, 0, 1, 5, 3, 4},
        {3, 5, 4, 0, 2, 1}, {4, 3, 5, 1, 0, 2}, {5, 4, 3, 2, 1, 0}}};
    // clang-format on
    const auto& turned = kTurned[static_cast<std::size_t>(std::min_element(p.begin(), p.end()) - p.begin())];
    std::array<int, 6> q;
    for (std::size_t i = 0; i < 6; ++i) q[i] = p[turned[i]];
    rest.push_back({q[0], q[3], q[4], q[5]});
    if (std::min(q[1], q[5]) < std::min(q[2], q[4])) {
        rest.push_back({q[0], q[1], q[2], q[5]});
        rest.push_back({q[0], q[1], q[5], q[4]});
    } else {
        rest.push_back({q[0], q[1], q[2], q[4]});
        rest.push_back({q[0], q[4], q[2], q[5]});
    }
}

/// The faces of a piece that lie on a sheet.
void Clipper::collect(const Tet& tet) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
        Patchwork::Triangle face{tet[(left_out + 1) % 4], tet[(left_out + 2) % 4], tet[(left_out + 3) % 4]};
        Sheets on = ~Sheets{0};
        for (int v : face) on &= on_[static_cast<std::size_t>(v)];
        if (on == 0) continue;
        const Vector3d edge = place(face[1]) - place(face[0]), other = place(face[2]) - place(face[0]);
        if (edge.cross(other).dot(place(tet[left_out]) - place(face[0])) > 0.0) std::swap(face[1], face[2]);
        faces_.emplace_back(face, std::countr_zero(on));
    }
}

Patchwork Clipper::surface() const {
    Patchwork surface;
    std::vector<int> number(places_.size(), -1);
    for (const auto& [face, sheet] : faces_) {
        Patchwork::Triangle corners;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto v = static_cast<std::size_t>(face[c]);
            if (number[v] < 0) number[v] = surface.add_vertex(places_[v], on_[v]);
            corners[c] = number[v];
        }
        surface.add_triangle(corners, sheet);
    }
    return surface;
}

/// The six tetrahedra of a cell: the ways from its first to its last corner along its edges.
constexpr std::array<std::array<int, 3>, 6> kWays{{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

}  // namespace

Patchwork clip(const Solid& solid) {
    Clipper clipper(solid);
    // Off any symmetry, else edges of the grid meet edges of the body.
    const Vector3d start = solid.box.min() - solid.cell * Vector3d(0.137, 0.291, 0.423);
    const Eigen::Array3i n = (solid.box.sizes() / solid.cell).array().ceil().cast<int>() + 2;
    std::vector<int> corners;
    for (int k = 0; k <= n[2]; ++k)
        for (int j = 0; j <= n[1]; ++j)
            for (int i = 0; i <= n[0]; ++i)
                corners.push_back(clipper.add_corner(start + solid.cell * Vector3d(i, j, k)));
    const auto corner = [&](const Eigen::Array3i& at) {
        return corners[static_cast<std::size_t>(at[0] + (n[0] + 1) * (at[1] + (n[1] + 1) * at[2]))];
    };
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i)
                for (const auto& way : kWays) {
                    Eigen::Array3i at(i, j, k);
                    Tet tet{corner(at), 0, 0, 0};
                    for (std::size_t step = 0; step < 3; ++step) {
                        at[way[step]] += 1;
                        tet[step + 1] = corner(at);
                    }
                    clipper.clip(tet);
                }
    return clipper.surface();
}

}  // namespace elastolab::bodies
