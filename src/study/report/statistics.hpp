#pragma once

#include <functional>
#include <span>
#include <vector>

namespace elastolab {

/// Not a number for no values.
double median(std::vector<double> values);

/// Slope of log y over log x, by least squares; pairs that are not both positive and finite are left out. Not a number
/// when fewer than two are left.
double fitted_exponent(std::span<const double> x, std::span<const double> y);

/// y at x by linear interpolation in logarithms; not a number outside the points, which need not be sorted.
double interpolate_log(std::span<const double> x, std::span<const double> y, double at);

/// Median seconds of repeated runs: at least one, at most `most`, until about `budget` seconds are spent.
double median_seconds(const std::function<void()>& work, double budget = 0.5, int most = 9);

/// Median seconds of something too short for the clock: the mean of a batch of runs, repeated.
double median_seconds_of_short(const std::function<void()>& work, double budget = 0.05);

}  // namespace elastolab
