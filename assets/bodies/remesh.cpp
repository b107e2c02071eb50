#include "bodies/remesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Geometry>
#include <vector>

#include "bodies/shape.hpp"

namespace elastolab::bodies {

namespace {

using Eigen::Vector3d;

constexpr int kRounds = 20, kFinalRounds = 8;
constexpr double kLongest = 4.0 / 3.0, kShortest = 4.0 / 5.0;  // of the wanted length
constexpr double kPoor = 0.8;                                  // of Shape::badness: an angle below 37 degrees

class Remesher {
public:
    Remesher(Patchwork& surface, const Solid& solid) : surface_(surface), shape_(surface, solid) {}

    void split_long_edges();
    void collapse_short_edges();
    enum class Aim { valence, angle };
    void flip_edges(Aim aim);
    void smooth();
    void raise_smallest_angles();

private:
    struct End {
        int gone, kept;
        Vector3d place;
        double badness;  // of the triangles around it then
    };
    std::vector<End> ends(int a, int b) const;
    bool collapse_keeps_shape(const End& end, bool must) const;
    int excess_valence(int v) const { return static_cast<int>(surface_.around(v).size()) - 6; }
    bool flip_helps(int a, int b, const Patchwork::Wing& wing, Aim aim) const;
    Vector3d centre_around(int v) const;
    std::vector<int> sharp_neighbours(int v) const;
    void improve(int v);

    Patchwork& surface_;
    Shape shape_;
};

void Remesher::split_long_edges() {
    for (const auto& [a, b] : surface_.edges()) {
        const Vector3d middle = 0.5 * (surface_.place(a) + surface_.place(b));
        if (shape_.length(a, b) <= kLongest * shape_.wanted_length(middle)) continue;
        const int v = surface_.split(a, b, middle);
        surface_.move(v, shape_.project(middle, surface_.sheets(v)));
    }
}

/// How an edge may go, the best shapes first; empty when sharp edges forbid it.
std::vector<Remesher::End> Remesher::ends(int a, int b) const {
    if (surface_.rank(a) > surface_.rank(b)) std::swap(a, b);
    const int rank_a = surface_.rank(a), rank_b = surface_.rank(b);
    if (rank_a >= 3) return {};
    if (rank_a == 2 && !surface_.is_sharp(surface_.wing(a, b))) return {};
    std::vector<End> ends{{a, b, surface_.place(b), 0.0}};
    if (rank_a == rank_b) {
        const Vector3d middle = 0.5 * (surface_.place(a) + surface_.place(b));
        ends.push_back({a, b, shape_.project(middle, surface_.sheets(b)), 0.0});
        ends.push_back({b, a, surface_.place(a), 0.0});
    }
    for (End& end : ends)
        end.badness = std::max(shape_.worst_around(end.gone, end.place, end.kept),
                               shape_.worst_around(end.kept, end.place, end.gone));
    std::stable_sort(ends.begin(), ends.end(), [](const End& x, const End& y) { return x.badness < y.badness; });
    return ends;
}

/// No triangle turns over, and none becomes worse than what was there and than a poor one; a vanishing edge must go
/// even where others become slivers. No edge becomes too long.
bool Remesher::collapse_keeps_shape(const End& end, bool must) const {
    const double before = std::max(shape_.worst_around(end.gone, surface_.place(end.gone)),
                                   shape_.worst_around(end.kept, surface_.place(end.kept)));
    if (end.badness > std::max(must ? 1.0 : kPoor + 0.1, before)) return false;
    for (int v : {end.gone, end.kept})
        for (int w : surface_.neighbours(v)) {
            const Vector3d middle = 0.5 * (surface_.place(w) + end.place);
            const double length = (surface_.place(w) - end.place).norm();
            if (length > kLongest * shape_.wanted_length(middle) && length > shape_.length(v, w)) return false;
        }
    return true;
}

void Remesher::collapse_short_edges() {
    for (const auto& [a, b] : surface_.edges()) {
        if (surface_.around(a).empty() || surface_.around(b).empty()) continue;
        const Patchwork::Wing wing = surface_.wing(a, b);
        if (wing.left < 0) continue;  // gone with another edge
        const double length = shape_.length(a, b), wanted = shape_.wanted_length(surface_.place(a));
        if (length >= kShortest * wanted) continue;
        if (!surface_.may_collapse(a, b)) continue;
        const std::vector<End> best_first = ends(a, b);
        if (best_first.empty() || !collapse_keeps_shape(best_first[0], length < 0.3 * wanted)) continue;
        surface_.collapse(best_first[0].gone, best_first[0].kept);
        surface_.move(best_first[0].kept, best_first[0].place);
    }
}

bool Remesher::flip_helps(int a, int b, const Patchwork::Wing& w, Aim aim) const {
    const int c = w.left_tip, d = w.right_tip, sheet = surface_.sheet(w.left);
    const double before = std::max(shape_.badness({a, b, c}, sheet), shape_.badness({b, a, d}, sheet));
    const double after = std::max(shape_.badness({c, a, d}, sheet), shape_.badness({d, b, c}, sheet));
    if (aim == Aim::angle || before > 0.95 || after > 0.95) return after < before - 1e-9;
    const auto square = [](int x) { return x * x; };
    const int now =
        square(excess_valence(a)) + square(excess_valence(b)) + square(excess_valence(c)) + square(excess_valence(d));
    const int then = square(excess_valence(a) - 1) + square(excess_valence(b) - 1) + square(excess_valence(c) + 1) +
                     square(excess_valence(d) + 1);
    return then < now;
}

void Remesher::flip_edges(Aim aim) {
    for (const auto& [a, b] : surface_.edges()) {
        const Patchwork::Wing wing = surface_.wing(a, b);
        if (wing.left < 0 || wing.right < 0 || surface_.is_sharp(wing)) continue;
        if (surface_.wing(wing.left_tip, wing.right_tip).left >= 0) continue;
        if (surface_.around(a).size() <= 3 || surface_.around(b).size() <= 3) continue;
        if (flip_helps(a, b, wing, aim)) surface_.flip(a, b);
    }
}

std::vector<int> Remesher::sharp_neighbours(int v) const {
    std::vector<int> found;
    for (int w : surface_.neighbours(v))
        if (surface_.is_sharp(surface_.wing(v, w))) found.push_back(w);
    return found;
}

/// Mean of the triangles' centres, by their area over that of a wanted triangle; on a sharp edge, of the two next
/// vertices on it.
Vector3d Remesher::centre_around(int v) const {
    Vector3d sum = Vector3d::Zero();
    double weights = 0.0;
    if (surface_.rank(v) == 2) {
        for (int w : sharp_neighbours(v)) {
            const double weight =
                shape_.length(v, w) / shape_.wanted_length(0.5 * (surface_.place(v) + surface_.place(w)));
            sum += weight * 0.5 * (surface_.place(v) + surface_.place(w));
            weights += weight;
        }
        return sum / weights;
    }
    for (int t : surface_.around(v)) {
        const auto& [a, b, c] = surface_.triangle(t);
        const Vector3d centre = (surface_.place(a) + surface_.place(b) + surface_.place(c)) / 3.0;
        const double wanted = shape_.wanted_length(centre);
        const Vector3d ab = surface_.place(b) - surface_.place(a), ac = surface_.place(c) - surface_.place(a);
        const double weight = ab.cross(ac).norm() / (wanted * wanted);
        sum += weight * centre;
        weights += weight;
    }
    return sum / weights;
}

void Remesher::smooth() {
    for (int v = 0; v < surface_.n_vertices(); ++v) {
        if (surface_.around(v).empty()) continue;
        const Vector3d here = surface_.place(v);
        const Vector3d there = surface_.rank(v) >= 3 ? here : Vector3d(centre_around(v));
        const Vector3d place = shape_.project(there, surface_.sheets(v));
        if ((place - here).norm() > shape_.wanted_length(here)) continue;
        if (shape_.worst_around(v, place) <= std::max(kPoor, shape_.worst_around(v, here))) surface_.move(v, place);
    }
}

/// Tries places around, nearer and nearer.
void Remesher::improve(int v) {
    const int rank = surface_.rank(v);
    Vector3d best = surface_.place(v);
    double badness = shape_.worst_around(v, best);
    if (rank >= 3 || badness < 0.7) return;
    const Vector3d n = shape_.normal(best, surface_.sheet(surface_.around(v).front()));
    const Vector3d across = n.unitOrthogonal(), along = n.cross(across);
    for (const double reach : {0.2, 0.1, 0.05, 0.02})
        for (const auto& [x, y] : {std::array{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
            const Vector3d step = reach * shape_.wanted_length(best) * (x * across + y * along);
            const Vector3d place = shape_.project(surface_.place(v) + step, surface_.sheets(v));
            const double then = shape_.worst_around(v, place);
            if (then < badness) best = place, badness = then;
        }
    surface_.move(v, best);
}

void Remesher::raise_smallest_angles() {
    for (int v = 0; v < surface_.n_vertices(); ++v)
        if (!surface_.around(v).empty()) improve(v);
}

}  // namespace

void remesh(Patchwork& surface, const Solid& solid) {
    Remesher remesher(surface, solid);
    for (int round = 0; round < kRounds; ++round) {
        remesher.split_long_edges();
        remesher.collapse_short_edges();
        remesher.flip_edges(Remesher::Aim::valence);
        remesher.smooth();
        remesher.smooth();
    }
    for (int round = 0; round < kFinalRounds; ++round) {
        remesher.flip_edges(Remesher::Aim::angle);
        remesher.raise_smallest_angles();
    }
}

}  // namespace elastolab::bodies
