#include "app/picture/section_shape.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numbers>

#include "mesh/measures.hpp"

namespace elastolab {

namespace {

constexpr int kSweeps = 20;
constexpr double kDegree = std::numbers::pi / 180.0;

/// The plane's normal before it is turned (0 steps), and the axes that follow it in cyclic order.
Eigen::Vector3d section_axis(const DisplaySettings& display, int steps) {
    return Eigen::Vector3d::Unit((display.cut.axis + steps) % 3);
}

Eigen::AngleAxisd section_turn(const DisplaySettings& display) {
    return Eigen::AngleAxisd(kDegree * display.cut.turn, section_axis(display, 1));
}

}  // namespace

Eigen::Matrix<double, 3, 2> section_hinges(const DisplaySettings& display) {
    Eigen::Matrix<double, 3, 2> hinges;
    hinges << section_axis(display, 1), section_turn(display) * section_axis(display, 2);
    return hinges;
}

Plane section_plane(const Positions& rest, const DisplaySettings& display) {
    const Eigen::Vector3d normal =
        section_turn(display) *
        (Eigen::AngleAxisd(kDegree * display.cut.tilt, section_axis(display, 2)) * section_axis(display, 0));
    const Eigen::RowVectorXd along = normal.transpose() * rest;
    const double low = along.minCoeff(), high = along.maxCoeff();
    const Plane plane{normal, low + display.cut.place * (high - low)};
    return display.cut.flip ? Plane{-plane.normal, -plane.offset} : plane;
}

SectionShape::SectionShape(std::shared_ptr<const SurfaceMesh> surface, const Plane& plane, int n_filling)
    : surface_(std::move(surface)), plane_(plane) {
    const OpenedSurface opened = open_surface(*surface_, plane);
    const Cap cap = make_cap(*surface_, opened, plane, mean_edge(*surface_));
    n_rim_ = cap.rim.size();
    inside_ = cap.inside;
    const int n = surface_->n_vertices();
    // Whole vertices of the skin are those of the surface.
    std::vector<int> skin(static_cast<std::size_t>(opened.vertices.size()));
    std::vector<Eigen::Index> cut;
    for (Eigen::Index v = 0; v < opened.vertices.size(); ++v) {
        const bool whole = opened.vertices.weights(0, v) == 1.0;
        skin[static_cast<std::size_t>(v)] = whole ? opened.vertices.nodes(0, v) : n + static_cast<int>(cut.size());
        if (!whole) cut.push_back(v);
    }
    const auto n_cut = std::ssize(cut);
    between_ = {Triangles(3, n_cut + n_rim_), Eigen::Matrix3Xd(3, n_cut + n_rim_)};
    between_.nodes << opened.vertices.nodes(Eigen::all, cut), cap.rim.nodes;
    between_.weights << opened.vertices.weights(Eigen::all, cut), cap.rim.weights;
    Triangles all = opened.triangles;
    for (int& vertex : all.reshaped()) vertex = skin[static_cast<std::size_t>(vertex)];
    const auto first_filling =
        std::lower_bound(opened.origins.begin(), opened.origins.end(), surface_->n_triangles() - n_filling);
    const auto n_skin = first_filling - opened.origins.begin();
    filling_ = all.rightCols(all.cols() - n_skin);
    triangles_.resize(3, n_skin + cap.triangles.cols());
    triangles_.leftCols(n_skin) = all.leftCols(n_skin);
    triangles_.rightCols(cap.triangles.cols()) = cap.triangles.array() + (n + static_cast<int>(n_cut));
    rest_ = joined(surface_->vertices, inside_);
    around_.resize(static_cast<std::size_t>(n_rim_ + n_inside()));
    for (const auto& t : cap.triangles.colwise())
        for (int i = 0; i < 3; ++i) around_[static_cast<std::size_t>(t[i])].push_back(t[(i + 1) % 3]);
}

Eigen::MatrixXd SectionShape::joined(const Eigen::Ref<const Eigen::MatrixXd>& of_surface,
                                     const Eigen::Ref<const Eigen::MatrixXd>& inside) const {
    Eigen::MatrixXd all(of_surface.rows(), of_surface.cols() + between_.size() + inside.cols());
    all.leftCols(of_surface.cols()) = of_surface;
    all.middleCols(of_surface.cols(), between_.size()) = between_.mean(of_surface);
    all.rightCols(inside.cols()) = inside;
    return all;
}

Eigen::MatrixXd SectionShape::spread_from_rim(const Eigen::Ref<const Eigen::MatrixXd>& of_surface) const {
    Eigen::MatrixXd of_cap = Eigen::MatrixXd::Zero(of_surface.rows(), n_rim_ + n_inside());
    of_cap.leftCols(n_rim_) = between_.mean(of_surface).rightCols(n_rim_);
    std::vector<char> known(static_cast<std::size_t>(of_cap.cols()), 0);
    std::fill_n(known.begin(), n_rim_, 1);
    relax(std::move(known), of_cap);
    return of_cap.rightCols(n_inside());
}

void SectionShape::fill(const std::vector<char>& known, Eigen::MatrixXd& inside) const {
    // The rim is not known here: values spread among the vertices inside only.
    Eigen::MatrixXd of_cap = Eigen::MatrixXd::Zero(inside.rows(), n_rim_ + n_inside());
    of_cap.rightCols(n_inside()) = inside;
    std::vector<char> all(static_cast<std::size_t>(n_rim_), 0);
    all.insert(all.end(), known.begin(), known.end());
    relax(std::move(all), of_cap);
    inside = of_cap.rightCols(n_inside());
}

void SectionShape::relax(std::vector<char> known, Eigen::MatrixXd& of_cap) const {
    std::vector<int> order, front;
    for (std::size_t v = 0; v < known.size(); ++v)
        if (known[v]) front.push_back(static_cast<int>(v));
    std::vector<char> reached = std::move(known);
    const auto take_mean = [&](int v, bool of_reached) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(of_cap.rows());
        int count = 0;
        for (const int next : around_[static_cast<std::size_t>(v)]) {
            if (of_reached && !reached[static_cast<std::size_t>(next)]) continue;
            sum += of_cap.col(next);
            ++count;
        }
        if (count > 0) of_cap.col(v) = sum / count;
    };
    while (!front.empty()) {
        std::vector<int> following;
        for (const int v : front)
            for (const int next : around_[static_cast<std::size_t>(v)])
                if (!reached[static_cast<std::size_t>(next)]) {
                    take_mean(next, true);
                    reached[static_cast<std::size_t>(next)] = 1;
                    following.push_back(next);
                }
        order.insert(order.end(), following.begin(), following.end());
        front = std::move(following);
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (const int v : order) take_mean(v, false);
}

}  // namespace elastolab
