#include "app/picture/filling_shape.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "mesh/measures.hpp"
#include "mesh/numbering.hpp"

namespace elastolab {

namespace {

constexpr std::size_t kMostLeaders = 64;

/// All of a list, or at most kMostLeaders of it, in equal steps.
std::vector<int> some_of(const std::vector<int>& all) {
    const std::size_t step = (all.size() + kMostLeaders - 1) / kMostLeaders;
    std::vector<int> some;
    for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
    return some;
}

/// Weights that are larger for nearer places; their sum is 1.
std::vector<double> shares_by_distance(const Eigen::Vector3d& x, const Positions& places) {
    std::vector<double> shares;
    for (const auto& place : places.colwise()) shares.push_back(1.0 / (place - x).squaredNorm());
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) share /= sum;
    return shares;
}

/// Whether two triangles of the same corners go round the same way.
bool same_way(const TrianglePoints& one, const TrianglePoints& other) {
    if (one.a == other.a) return one.b == other.b;
    return one.a == other.b ? one.b == other.c : one.b == other.a;
}

}  // namespace

FillingShape::FillingShape(const Proxy& filled) : surface_(filled.surface) {
    assert(filled.is_filled());
    // Those of the shown surface come first.
    triangles_ = surface_->triangles.rightCols(surface_->n_triangles() - filled.shown->n_triangles());
    vertices_ = used_vertices(triangles_);
    renumber(triangles_, vertices_);
    rest_ = surface_->vertices(Eigen::all, vertices_);
    find_leaders(filled);
    close(*filled.shown);
}

void FillingShape::find_leaders(const Proxy& filled) {
    const Positions& shown = filled.shown->vertices;
    std::vector<int> rim;                        // of the shown surface
    std::vector<int> own(vertices_.size(), -1);  // for each column of rest_: its vertex on the rim, or -1
    for (Eigen::Index v = 0; v < shown.cols(); ++v) {
        if (filled.places.distance[v] != 0.0 || filled.places.weights(0, v) != 1.0) continue;
        const auto place = std::lower_bound(vertices_.begin(), vertices_.end(), filled.places.nodes(0, v));
        if (place == vertices_.end() || *place != filled.places.nodes(0, v)) continue;
        own[static_cast<std::size_t>(place - vertices_.begin())] = static_cast<int>(v);
        rim.push_back(static_cast<int>(v));
    }
    const std::vector<int> leaders = some_of(rim);
    for (std::size_t i = 0; i < own.size(); ++i) {
        const Eigen::Vector3d x = rest_.col(static_cast<Eigen::Index>(i));
        Follower follower{own[i] < 0 ? leaders : std::vector<int>{own[i]}, {1.0}, x};
        if (own[i] < 0) follower.shares = shares_by_distance(x, shown(Eigen::all, leaders));
        for (std::size_t k = 0; k < follower.leaders.size(); ++k)
            follower.offset -= follower.shares[k] * shown.col(follower.leaders[k]);
        followers_.push_back(std::move(follower));
    }
}

void FillingShape::close(const SurfaceMesh& shown) {
    std::vector<Eigen::Index> extra;  // vertices that the shown surface does not have
    for (std::size_t v = 0; v < followers_.size(); ++v) {
        const bool is_own = followers_[v].leaders.size() == 1;
        places_.push_back(is_own ? followers_[v].leaders.front() : shown.n_vertices() + static_cast<int>(extra.size()));
        if (!is_own) extra.push_back(static_cast<Eigen::Index>(v));
    }
    SurfaceMesh closed;
    closed.vertices.resize(3, shown.vertices.cols() + std::ssize(extra));
    closed.vertices << shown.vertices, rest_(Eigen::all, extra);
    closed.triangles.resize(3, shown.triangles.cols() + triangles_.cols());
    closed.triangles << shown.triangles, triangles_;
    for (int& vertex : closed.triangles.rightCols(triangles_.cols()).reshaped())
        vertex = places_[static_cast<std::size_t>(vertex)];
    // The filled surface faces outward, which an open one need not.
    for (int t = 0; t < shown.n_triangles(); ++t)
        if (!same_way(triangle_points(shown, t), triangle_points(*surface_, t)))
            std::swap(closed.triangles(1, t), closed.triangles(2, t));
    closed_ = std::make_shared<const SurfaceMesh>(std::move(closed));
}

Eigen::MatrixXd FillingShape::joined(const Eigen::Ref<const Eigen::MatrixXd>& of_shown,
                                     const Eigen::Ref<const Eigen::MatrixXd>& of_filling) const {
    Eigen::MatrixXd all(of_shown.rows(), closed_->n_vertices());
    all.leftCols(of_shown.cols()) = of_shown;
    for (Eigen::Index v = 0; v < of_filling.cols(); ++v)
        if (const int place = places_[static_cast<std::size_t>(v)]; place >= of_shown.cols())
            all.col(place) = of_filling.col(v);
    return all;
}

Eigen::MatrixXd FillingShape::taken(const Eigen::Ref<const Eigen::MatrixXd>& of_surface) const {
    return of_surface(Eigen::all, vertices_);
}

Eigen::MatrixXd FillingShape::spread(const Eigen::Ref<const Eigen::MatrixXd>& of_shown) const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(of_shown.rows(), rest_.cols());
    for (std::size_t v = 0; v < followers_.size(); ++v)
        for (std::size_t i = 0; i < followers_[v].leaders.size(); ++i)
            result.col(static_cast<Eigen::Index>(v)) +=
                followers_[v].shares[i] * of_shown.col(followers_[v].leaders[i]);
    return result;
}

Positions FillingShape::following(const Positions& shown) const {
    Positions result = spread(shown);
    for (std::size_t v = 0; v < followers_.size(); ++v)
        result.col(static_cast<Eigen::Index>(v)) += followers_[v].offset;
    return result;
}

Positions FillingShape::displaced(const Eigen::VectorXd& of_surface, double scale) const {
    const Eigen::Map<const Eigen::Matrix3Xd> u(of_surface.data(), 3, of_surface.size() / 3);
    return rest_ + scale * u(Eigen::all, vertices_);
}

}  // namespace elastolab
