#include "study/error/error_frontier.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "methods/registry.hpp"
#include "study/report/statistics.hpp"

namespace elastolab {

namespace {

/// What an error takes.
struct Reach {
    double seconds = std::numeric_limits<double>::quiet_NaN(), vertices = seconds;
};

/// Interpolated between the first mesh that is fine enough and the next coarser one; or that of a finer mesh, where
/// this was ready sooner.
Reach reach(const std::vector<double>& error, const std::vector<double>& seconds, const std::vector<double>& vertices,
            double target) {
    Reach best;
    const auto take = [&](const Reach& other) {
        if (!(best.seconds <= other.seconds)) best = other;
    };
    for (std::size_t i = 0; i < error.size(); ++i) {
        if (!(error[i] <= target)) continue;
        if (std::isnan(best.seconds) && i > 0) {
            const std::vector<double> errors{error[i - 1], error[i]};
            take({interpolate_log(errors, std::vector{seconds[i - 1], seconds[i]}, target),
                  interpolate_log(errors, std::vector{vertices[i - 1], vertices[i]}, target)});
        }
        take({seconds[i], vertices[i]});
    }
    return best;
}

}  // namespace

const std::vector<double>& target_errors() {
    static const std::vector<double> targets = {0.1, 0.03, 0.01, 0.003, 0.001};
    return targets;
}

std::vector<FrontierPoint> frontier(const Table& table, const std::string& time, const std::string& error_column) {
    std::vector<FrontierPoint> points;
    const Table refinement = table.where({{"part", "refinement"}});
    for (const std::string& problem : refinement.values("problem"))
        for (const std::string& nu : refinement.values("nu"))
            for (const double target : target_errors())
                for (const std::string& variant : refinement.values("variant")) {
                    const Table rows = refinement.where({{"problem", problem}, {"nu", nu}, {"variant", variant}});
                    const std::vector<double> error = rows.numbers(error_column);
                    const Reach at = reach(error, rows.numbers(time), rows.numbers("vertices"), target);
                    if (std::isfinite(at.seconds))
                        points.push_back({problem, nu, variant, target, at.seconds, at.vertices});
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

std::vector<FrontierPoint> defaults_of(const std::vector<FrontierPoint>& points) {
    std::vector<FrontierPoint> found;
    std::copy_if(points.begin(), points.end(), std::back_inserter(found),
                 [](const FrontierPoint& point) { return parse_method_kind(point.variant).has_value(); });
    return found;
}

Table frontier_table(const Table& table) {
    Table result{
        {"error", "problem", "nu", "time", "target", "variant", "seconds", "vertices", "fastest", "fastest_default"},
        {}};
    for (const auto& [error, time] : {std::pair{"error", "ready_s"}, {"error", "once_s"}, {"error_force", "ready_s"}}) {
        const std::vector<FrontierPoint> points = frontier(table, time, error);
        const std::vector<FrontierPoint> best = fastest(points), best_default = fastest(defaults_of(points));
        for (const FrontierPoint& point : points) {
            const auto is_in = [&](const std::vector<FrontierPoint>& winners) {
                return std::string(std::any_of(winners.begin(), winners.end(),
                                               [&](const FrontierPoint& other) {
                                                   return other.problem == point.problem && other.nu == point.nu &&
                                                          other.target == point.target &&
                                                          other.variant == point.variant;
                                               })
                                       ? "yes"
                                       : "no");
            };
            result.rows.push_back(Row()
                                      .set("error", std::string(error))
                                      .set("problem", point.problem)
                                      .set("nu", point.nu)
                                      .set("time", std::string(time))
                                      .set("target", point.target)
                                      .set("variant", point.variant)
                                      .set("seconds", point.seconds)
                                      .set("vertices", point.vertices)
                                      .set("fastest", is_in(best))
                                      .set("fastest_default", is_in(best_default)));
        }
    }
    return result;
}

}  // namespace elastolab
