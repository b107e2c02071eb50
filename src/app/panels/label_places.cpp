#include "app/panels/label_places.hpp"

#include <limits>

namespace elastolab {

namespace {

/// Rows above and below a point in which words may stand.
constexpr int kRows = 4;

}  // namespace

LabelPlaces::LabelPlaces(const Viewport& viewport, double margin) {
    const Eigen::Vector2d low(viewport.x + margin, viewport.y + margin);
    const Eigen::Vector2d size(viewport.width - viewport.covered, viewport.height);
    room_ = Box(low, low.cwiseMax(low + size - Eigen::Vector2d::Constant(2.0 * margin)));
}

LabelPlaces::Box LabelPlaces::inside(Box box) const {
    const Eigen::Vector2d beyond = (box.max() - room_.max()).cwiseMax(0.0);
    box.translate(-beyond);
    return box.translate((room_.min() - box.min()).cwiseMax(0.0));  // the beginning is read first
}

double LabelPlaces::covered_area(const Box& box) const {
    double area = 0.0;
    for (const Box& other : taken_)
        if (const Box both = box.intersection(other); !both.isEmpty()) area += both.volume();
    return area;
}

LabelPlaces::Box LabelPlaces::take(const Eigen::Vector2d& point, const Eigen::Vector2d& size, double gap) {
    const double step = 1.25 * size.y();
    std::vector<Eigen::Vector2d> lows;
    const auto beside = [&](double rows) {
        const double y = point.y() - 0.5 * size.y() + rows * step;
        lows.emplace_back(point.x() + gap, y);
        lows.emplace_back(point.x() - gap - size.x(), y);
    };
    beside(0.0);
    lows.emplace_back(point.x() - 0.5 * size.x(), point.y() - gap - size.y());
    lows.emplace_back(point.x() - 0.5 * size.x(), point.y() + gap);
    for (int row = 1; row <= kRows; ++row) {
        beside(-row);
        beside(row);
    }
    const Box mark(point - Eigen::Vector2d::Constant(0.5 * gap), point + Eigen::Vector2d::Constant(0.5 * gap));
    Box best;
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& low : lows) {
        const Box box = inside(Box(low, low + size));
        double area = covered_area(box);
        if (const Box both = box.intersection(mark); !both.isEmpty()) area += both.volume();
        if (area >= least) continue;
        best = box;
        least = area;
        if (least == 0.0) break;
    }
    taken_.push_back(mark);
    taken_.push_back(best);
    return best;
}

}  // namespace elastolab
