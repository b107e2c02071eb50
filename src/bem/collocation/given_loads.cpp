#include "bem/collocation/given_loads.hpp"

#include <algorithm>

#include "bem/collocation/assembly.hpp"
#include "bem/collocation/point_strips.hpp"
#include "bem/given_loads.hpp"

namespace elastolab {

namespace {

/// Numbers of a strip of the single layer that are held at once.
constexpr int kGivenNumbers = 8'000'000;

}  // namespace

Eigen::MatrixXd given_single_layer(const Boundary& boundary, const CollocationPoints& points, const Material& material,
                                   double tolerance, std::span<const UnitLoad> loads, Control& control) {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * points.size(), std::ssize(loads));
    for (const GivenTractions& given : given_tractions(boundary, loads)) {
        const int at_once = std::clamp(kGivenNumbers / (9 * given.elements.n_slots), 8, kPointsAtOnce);
        for_point_strips(
            points,
            [&](int first, const CollocationPoints& strip) {
                Eigen::MatrixXd G(3 * strip.size(), 3 * given.elements.n_slots);
                assemble(Layer::single_layer, boundary, strip, given.elements, material, tolerance, G, control);
                const Eigen::MatrixXd seen = G * given.coefficients;
                for (std::size_t c = 0; c < given.columns.size(); ++c)
                    result.col(given.columns[c]).segment(3 * first, G.rows()) = seen.col(static_cast<Eigen::Index>(c));
            },
            at_once);
    }
    return result;
}

}  // namespace elastolab
