#include "mesh/section/cap.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <Eigen/Geometry>
#include <map>
#include <utility>

#include "mesh/section/planar_delaunay.hpp"

namespace elastolab {

namespace {

/// Distance of points inside from the rim, in edges; length of a rim segment at most.
constexpr double kFromRim = 0.55, kLongestRim = 1.4;
constexpr int kMostRounds = 40;

using Point2 = Eigen::Vector2d;
using Plane2 = Eigen::Matrix<double, 2, 3>;

Plane2 axes_of(const Plane& plane) {
    Plane2 axes;
    axes.row(0) = plane.normal.unitOrthogonal().transpose();
    axes.row(1) = plane.normal.cross(axes.row(0).transpose()).transpose();
    return axes;
}

double distance(const Point2& p, const Point2& a, const Point2& b) {
    const Point2 along = b - a;
    const double square = along.squaredNorm();
    const double s = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
    return (p - a - s * along).norm();
}

class CapMaker {
public:
    CapMaker(const SurfaceMesh& surface, const OpenedSurface& opened, const Plane& plane, double edge, int max_inside)
        : surface_(surface), plane_(plane), axes_(axes_of(plane)) {
        const Positions at = opened.vertices.mean(surface.vertices);
        std::map<int, int> rim_of;
        const auto rim_point = [&](int v) {
            const auto [place, is_new] = rim_of.try_emplace(v, static_cast<int>(rim_.size()));
            if (is_new)
                rim_.push_back({opened.vertices.nodes.col(v), opened.vertices.weights.col(v), axes_ * at.col(v)});
            return place->second;
        };
        for (const OpenedSurface::Segment& s : opened.outline)
            segments_.push_back({rim_point(s.from), rim_point(s.to), s.triangle});
        choose_edge(edge, max_inside);
    }

    Cap run() {
        if (segments_.empty() || !(size_ > 0.0)) return {Anchors{Triangles(3, 0), Eigen::Matrix3Xd(3, 0)}, {}, {}};
        split_long_segments();
        find_inside();
        for (std::size_t i = 0; i < rim_.size(); ++i) insert(rim_[i].at, static_cast<int>(i));
        for (const Point2& p : inside_) insert(p, -1);
        recover_segments();
        return result(inner_triangles());
    }

private:
    struct RimPoint {
        Eigen::Vector3i nodes;
        Eigen::Vector3d weights;
        Point2 at;
    };
    struct Segment {
        int from, to, triangle;
    };
    const Point2& at(int rim) const { return rim_[static_cast<std::size_t>(rim)].at; }

    void choose_edge(double edge, int max_inside) {
        double area = 0.0;
        Point2 low = Point2::Constant(1e300), high = -low;
        for (const RimPoint& p : rim_) low = low.cwiseMin(p.at), high = high.cwiseMax(p.at);
        for (const Segment& s : segments_) {
            const Point2 a = at(s.from) - low, b = at(s.to) - low;
            area += 0.5 * (a.x() * b.y() - a.y() * b.x());
        }
        low_ = low;
        size_ = rim_.empty() ? 0.0 : (high - low).maxCoeff();
        if (!(size_ > 0.0)) return;
        area = std::clamp(std::abs(area), 1e-6 * size_ * size_, size_ * size_);
        // A point of a triangular grid has sqrt(3)/2 edge^2 to itself.
        const double finest = std::sqrt(area / (0.866 * std::max(1, max_inside)));
        edge_ = std::max({std::min(edge, std::sqrt(area) / kEdgesAcrossCap), finest, 1e-3 * size_});
        // Where sides face opposite ways their areas cancel, though the outline encloses much by parity.
        const double most = std::max(1, max_inside);
        double n = n_grid_points();
        while (n > most) {
            edge_ *= 1.01 * std::sqrt(n / most);
            n = n_grid_points();
        }
    }

    /// Rows of the triangular grid that may meet the outline, and where one does: from and to in turns.
    double row_height() const { return std::sqrt(0.75) * edge_; }
    std::int64_t first_row() const { return static_cast<std::int64_t>(std::floor(low_.y() / row_height())); }
    std::int64_t last_row() const { return static_cast<std::int64_t>(std::ceil((low_.y() + size_) / row_height())); }
    static double shift_of(std::int64_t row) { return row % 2 == 0 ? 0.0 : 0.5; }
    std::vector<double> crossings(double y) const {
        std::vector<double> all;
        for (const Segment& s : segments_) {
            const Point2 &a = at(s.from), &b = at(s.to);
            if ((a.y() <= y) != (b.y() <= y)) all.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
        }
        std::sort(all.begin(), all.end());
        return all;
    }

    /// Points of the grid inside, however near to the rim.
    double n_grid_points() const {
        double n = 0.0;
        for (std::int64_t row = first_row(); row <= last_row(); ++row) {
            const std::vector<double> ends = crossings(static_cast<double>(row) * row_height());
            for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
                n += std::ceil(ends[i + 1] / edge_ - shift_of(row)) - std::ceil(ends[i] / edge_ - shift_of(row));
        }
        return n;
    }

    /// A point of a segment, which lies in one triangle of the surface.
    int add_between(const Segment& s, double share) {
        const Eigen::Vector3i corners = surface_.triangles.col(s.triangle);
        RimPoint middle{corners, Eigen::Vector3d::Zero(), (1.0 - share) * at(s.from) + share * at(s.to)};
        for (const auto& [end, part] : {std::pair{s.from, 1.0 - share}, {s.to, share}}) {
            const RimPoint& p = rim_[static_cast<std::size_t>(end)];
            for (int k = 0; k < 3; ++k)
                for (int corner = 0; corner < 3; ++corner)
                    if (corners[corner] == p.nodes[k]) {
                        middle.weights[corner] += part * p.weights[k];
                        break;
                    }
        }
        rim_.push_back(middle);
        return static_cast<int>(rim_.size()) - 1;
    }

    void split_long_segments() {
        std::vector<Segment> pieces;
        for (const Segment& s : segments_) {
            const int n =
                std::max(1, static_cast<int>(std::ceil((at(s.to) - at(s.from)).norm() / (kLongestRim * edge_))));
            int from = s.from;
            for (int k = 1; k <= n; ++k) {
                const int to = k == n ? s.to : add_between(s, static_cast<double>(k) / n);
                pieces.push_back({from, to, s.triangle});
                from = to;
            }
        }
        segments_ = std::move(pieces);
    }

    /// Points of a triangular grid that is at rest in space, inside and away from the rim.
    void find_inside() {
        for (std::int64_t row = first_row(); row <= last_row(); ++row) {
            const double y = static_cast<double>(row) * row_height();
            const std::vector<double> ends = crossings(y);
            std::vector<const Segment*> close;
            for (const Segment& s : segments_) {
                const Point2 &a = at(s.from), &b = at(s.to);
                if (std::min(a.y(), b.y()) < y + edge_ && std::max(a.y(), b.y()) > y - edge_) close.push_back(&s);
            }
            const double shift = shift_of(row);
            for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
                for (double k = std::ceil(ends[i] / edge_ - shift); (k + shift) * edge_ < ends[i + 1]; k += 1.0) {
                    const Point2 p((k + shift) * edge_, y);
                    const bool free = std::none_of(close.begin(), close.end(), [&](const Segment* s) {
                        return distance(p, at(s->from), at(s->to)) < kFromRim * edge_;
                    });
                    if (free) inside_.push_back(p);
                }
        }
    }

    /// rim: its number, or -1 for the next point inside.
    void insert(const Point2& p, int rim) {
        const Eigen::Array2d unit = (p - low_).array() / size_ * static_cast<double>(PlanarDelaunay::kSize);
        const Eigen::Array2d snapped = unit.round().cwiseMax(0.0).cwiseMin(static_cast<double>(PlanarDelaunay::kSize));
        const int number =
            delaunay_.insert({static_cast<std::int64_t>(snapped[0]), static_cast<std::int64_t>(snapped[1])});
        const auto n = static_cast<std::size_t>(delaunay_.n_points());
        vertex_of_.resize(n, -1);
        // Points closer together than the grid of integers are one; the rim comes first.
        if (rim >= 0) {
            if (point_of_.size() <= static_cast<std::size_t>(rim))
                point_of_.resize(static_cast<std::size_t>(rim) + 1, -1);
            point_of_[static_cast<std::size_t>(rim)] = number;
            if (vertex_of_[static_cast<std::size_t>(number)] == -1) vertex_of_[static_cast<std::size_t>(number)] = rim;
        } else {
            if (vertex_of_[static_cast<std::size_t>(number)] == -1)
                vertex_of_[static_cast<std::size_t>(number)] = kInside - n_inside_;
            ++n_inside_;
        }
    }

    /// Splits segments that are no edges until all are: each piece is an edge when no point is in its circle.
    void recover_segments() {
        for (int round = 0; round < kMostRounds; ++round) {
            std::vector<Segment> pieces;
            bool split = false;
            for (const Segment& s : segments_) {
                const int a = point(s.from), b = point(s.to);
                if (a == b || delaunay_.has_edge(a, b)) {
                    pieces.push_back(s);
                    continue;
                }
                const int middle = add_between(s, 0.5);
                insert(at(middle), middle);
                if (point(middle) != a && point(middle) != b) split = true;
                pieces.push_back({s.from, middle, s.triangle});
                pieces.push_back({middle, s.to, s.triangle});
            }
            segments_ = std::move(pieces);
            if (!split) return;
        }
    }
    int point(int rim) const { return point_of_[static_cast<std::size_t>(rim)]; }

    /// By the parity of segments between a triangle and the outside.
    std::vector<std::size_t> inner_triangles() const {
        std::map<std::pair<int, int>, int> walls;
        for (const Segment& s : segments_) ++walls[std::minmax({point(s.from), point(s.to)})];
        const std::vector<PlanarDelaunay::Triangle>& all = delaunay_.triangles();
        std::vector<int> parity(all.size(), -1);
        std::vector<std::size_t> stack;
        for (std::size_t t = 0; t < all.size() && stack.empty(); ++t)
            if (all[t].alive && *std::min_element(all[t].corners.begin(), all[t].corners.end()) == 0) {
                parity[t] = 0;
                stack.push_back(t);
            }
        std::vector<std::size_t> inner;
        while (!stack.empty()) {
            const std::size_t t = stack.back();
            stack.pop_back();
            if (parity[t] == 1) inner.push_back(t);
            for (std::size_t i = 0; i < 3; ++i) {
                const int across = all[t].across[i];
                if (across < 0 || parity[static_cast<std::size_t>(across)] >= 0) continue;
                const auto wall = walls.find(std::minmax({all[t].corners[(i + 1) % 3], all[t].corners[(i + 2) % 3]}));
                const int crossed = wall == walls.end() ? 0 : wall->second % 2;
                parity[static_cast<std::size_t>(across)] = (parity[t] + crossed) % 2;
                stack.push_back(static_cast<std::size_t>(across));
            }
        }
        return inner;
    }

    Cap result(const std::vector<std::size_t>& inner) const {
        const auto n_rim = static_cast<Eigen::Index>(rim_.size());
        Cap cap{Anchors{Triangles(3, n_rim), Eigen::Matrix3Xd(3, n_rim)}, Positions(3, std::ssize(inside_)), {}};
        for (Eigen::Index i = 0; i < n_rim; ++i) {
            cap.rim.nodes.col(i) = rim_[static_cast<std::size_t>(i)].nodes;
            cap.rim.weights.col(i) = rim_[static_cast<std::size_t>(i)].weights;
        }
        for (std::size_t i = 0; i < inside_.size(); ++i)
            cap.inside.col(static_cast<Eigen::Index>(i)) =
                plane_.offset * plane_.normal + axes_.transpose() * inside_[i];
        std::vector<Eigen::Vector3i> triangles;
        for (const std::size_t t : inner) {
            Eigen::Vector3i corners;
            for (int k = 0; k < 3; ++k) {
                const int point = delaunay_.triangles()[t].corners[static_cast<std::size_t>(k)];
                const int vertex = vertex_of_[static_cast<std::size_t>(point)];
                corners[k] = vertex <= kInside ? static_cast<int>(n_rim) + kInside - vertex : vertex;
            }
            if (corners.minCoeff() >= 0) triangles.push_back(corners);
        }
        cap.triangles.resize(3, std::ssize(triangles));
        for (std::size_t i = 0; i < triangles.size(); ++i)
            cap.triangles.col(static_cast<Eigen::Index>(i)) = triangles[i];
        return cap;
    }

    /// vertex_of_ is a number of the rim, -1 for the points around all others, or kInside less a number of inside_.
    static constexpr int kInside = -2;

    const SurfaceMesh& surface_;
    Plane plane_;
    Plane2 axes_;
    std::vector<RimPoint> rim_;
    std::vector<Segment> segments_;
    std::vector<Point2> inside_;
    Point2 low_ = Point2::Zero();
    double size_ = 0.0, edge_ = 0.0;
    PlanarDelaunay delaunay_;
    std::vector<int> vertex_of_, point_of_;  ///< by points of delaunay_, and by those of the rim
    int n_inside_ = 0;
};

}  // namespace

Cap make_cap(const SurfaceMesh& surface, const OpenedSurface& opened, const Plane& plane, double edge, int max_inside) {
    return CapMaker(surface, opened, plane, edge, max_inside).run();
}

}  // namespace elastolab
