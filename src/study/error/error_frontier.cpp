#include "study/error/error_frontier.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/report/statistics.hpp"

namespace elastolab {

namespace {

/// Interpolated between the first mesh that is fine enough and the one before.
double reach(const std::vector<double>& error, const std::vector<double>& quantity, double target) {
    for (std::size_t i = 0; i < error.size(); ++i) {
        if (!(error[i] <= target)) continue;
        if (i == 0) return quantity[0];
        return interpolate_log(std::vector{error[i - 1], error[i]}, std::vector{quantity[i - 1], quantity[i]}, target);
    }
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

const std::vector<double>& target_errors() {
    static const std::vector<double> targets = {0.1, 0.03, 0.01, 0.003, 0.001};
    return targets;
}

std::vector<FrontierPoint> frontier(const Table& table, const std::string& time) {
    std::vector<FrontierPoint> points;
    const Table refinement = table.where({{"part", "refinement"}});
    for (const std::string& problem : refinement.values("problem"))
        for (const std::string& nu : refinement.values("nu"))
            for (const double target : target_errors())
                for (const std::string& variant : refinement.values("variant")) {
                    const Table rows = refinement.where({{"problem", problem}, {"nu", nu}, {"variant", variant}});
                    const std::vector<double> error = rows.numbers("error");
                    const double seconds = reach(error, rows.numbers(time), target);
                    const double vertices = reach(error, rows.numbers("vertices"), target);
                    if (std::isfinite(seconds)) points.push_back({problem, nu, variant, target, seconds, vertices});
                }
    return points;
}

std::vector<FrontierPoint> fastest(const std::vector<FrontierPoint>& points) {
    std::vector<FrontierPoint> best;
    for (const FrontierPoint& point : points) {
        const auto same = std::find_if(best.begin(), best.end(), [&](const FrontierPoint& other) {
            return other.problem == point.problem && other.nu == point.nu && other.target == point.target;
        });
        if (same == best.end())
            best.push_back(point);
        else if (point.seconds < same->seconds)
            *same = point;
    }
    return best;
}

Table frontier_table(const Table& table) {
    Table result{{"problem", "nu", "time", "target", "variant", "seconds", "vertices", "fastest"}, {}};
    for (const std::string time : {"ready_s", "once_s"}) {
        const std::vector<FrontierPoint> points = frontier(table, time);
        const std::vector<FrontierPoint> best = fastest(points);
        for (const FrontierPoint& point : points) {
            const bool wins = std::any_of(best.begin(), best.end(), [&](const FrontierPoint& other) {
                return other.problem == point.problem && other.nu == point.nu && other.target == point.target &&
                       other.variant == point.variant;
            });
            result.rows.push_back(Row()
                                      .set("problem", point.problem)
                                      .set("nu", point.nu)
                                      .set("time", time)
                                      .set("target", point.target)
                                      .set("variant", point.variant)
                                      .set("seconds", point.seconds)
                                      .set("vertices", point.vertices)
                                      .set("fastest", std::string(wins ? "yes" : "no")));
        }
    }
    return result;
}

}  // namespace elastolab
