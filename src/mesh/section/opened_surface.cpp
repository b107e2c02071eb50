#include "mesh/section/opened_surface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace elastolab {

namespace {

constexpr double kOnPlane = 1e-12;  ///< height over the body's extent: rounding

class Opening {
public:
    Opening(const SurfaceMesh& surface, const Plane& plane)
        : surface_(surface),
          height_((plane.normal.transpose() * surface.vertices).array() - plane.offset),
          kept_(static_cast<std::size_t>(surface.n_vertices()), -1) {
        const double rounding = kOnPlane * std::max(height_.maxCoeff() - height_.minCoeff(), std::abs(plane.offset));
        height_ = (height_.array().abs() <= rounding).select(0.0, height_);
    }

    OpenedSurface run() {
        OpenedSurface opened;
        for (int t = 0; t < surface_.n_triangles(); ++t) {
            add(t);
            opened.origins.resize(triangles_.size(), t);
        }
        opened.vertices = {Triangles(3, std::ssize(anchors_)), Eigen::Matrix3Xd(3, std::ssize(anchors_))};
        for (std::size_t i = 0; i < anchors_.size(); ++i) {
            opened.vertices.nodes.col(static_cast<Eigen::Index>(i)) = anchors_[i].nodes;
            opened.vertices.weights.col(static_cast<Eigen::Index>(i)) = anchors_[i].weights;
        }
        opened.triangles.resize(3, std::ssize(triangles_));
        for (std::size_t i = 0; i < triangles_.size(); ++i)
            opened.triangles.col(static_cast<Eigen::Index>(i)) = triangles_[i];
        opened.outline = std::move(outline_);
        return opened;
    }

private:
    struct Anchor {
        Eigen::Vector3i nodes;
        Eigen::Vector3d weights;
    };
    bool below(int v) const { return height_[v] < 0.0; }

    int add_anchor(const Anchor& anchor) {
        anchors_.push_back(anchor);
        return static_cast<int>(anchors_.size()) - 1;
    }
    int whole(int v) {
        int& place = kept_[static_cast<std::size_t>(v)];
        if (place < 0) place = add_anchor({{v, v, v}, {1.0, 0.0, 0.0}});
        return place;
    }
    /// On the edge between a vertex below and one above.
    int crossing(int low, int high) {
        if (height_[high] == 0.0) return whole(high);
        const auto key = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
        const auto [place, is_new] = crossings_.try_emplace(key, 0);
        if (is_new) {
            const double share = height_[low] / (height_[low] - height_[high]);
            place->second = add_anchor({{low, high, low}, {1.0 - share, share, 0.0}});
        }
        return place->second;
    }

    void add(int t) {
        const Eigen::Vector3i corners = surface_.triangles.col(t);
        const int n_below = below(corners[0]) + below(corners[1]) + below(corners[2]);
        if (n_below == 0) return;
        if (n_below == 3) {
            triangles_.emplace_back(whole(corners[0]), whole(corners[1]), whole(corners[2]));
            return;
        }
        int lone = 0;  // on its side
        while (below(corners[lone]) != (n_below == 1)) ++lone;
        const int a = corners[lone], b = corners[(lone + 1) % 3], c = corners[(lone + 2) % 3];
        if (n_below == 1) {
            const int ab = crossing(a, b), ac = crossing(a, c);
            triangles_.emplace_back(whole(a), ab, ac);
            outline_.push_back({ac, ab, t});
        } else {
            const int ba = crossing(b, a), ca = crossing(c, a);
            triangles_.emplace_back(whole(b), whole(c), ca);
            if (ba == ca) return;  // the plane touches a corner
            triangles_.emplace_back(whole(b), ca, ba);
            outline_.push_back({ba, ca, t});
        }
    }

    const SurfaceMesh& surface_;
    Eigen::RowVectorXd height_;
    std::vector<int> kept_;
    std::unordered_map<std::uint64_t, int> crossings_;
    std::vector<Anchor> anchors_;
    std::vector<Eigen::Vector3i> triangles_;
    std::vector<OpenedSurface::Segment> outline_;
};

}  // namespace

Eigen::MatrixXd Anchors::mean(const Eigen::Ref<const Eigen::MatrixXd>& of_vertices) const {
    Eigen::MatrixXd result(of_vertices.rows(), size());
    for (Eigen::Index i = 0; i < size(); ++i)
        result.col(i) = weights(0, i) * of_vertices.col(nodes(0, i)) + weights(1, i) * of_vertices.col(nodes(1, i)) +
                        weights(2, i) * of_vertices.col(nodes(2, i));
    return result;
}

OpenedSurface open_surface(const SurfaceMesh& surface, const Plane& plane) { return Opening(surface, plane).run(); }

}  // namespace elastolab
