#include "scene/live/theory_gauge.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace elastolab {

namespace {

/// A motion that has rested this long is worth gauging.
constexpr double kGaugeRestSeconds = 0.5;
/// A motion that turns by less than this is called a pull [degree].
constexpr double kTurn = 5.0;

bool turns(const Wish& wish) {
    return std::any_of(wish.motions.begin(), wish.motions.end(),
                       [](const Motion& motion) { return turn_between(Motion{}, motion) >= kTurn; });
}

}  // namespace

TheoryGauge::Found TheoryGauge::find(std::shared_ptr<const Made> made, const Body& body, const ConstrainedSet& set,
                                     const Wish& wish, const HandleForces& by_force, Control& control) {
    const bool serves = made && made->surface == body.surface && made->set == set && made->material == body.material;
    if (!serves)
        made =
            std::make_shared<const Made>(Made{body.surface, body.material, set, LinearTheoryGauge(body, set, control)});
    const Positions rest = body.surface->vertices(Eigen::all, set.handles);
    const Approach approach{nullptr, way_to(wish, nullptr, rest).path};
    const double moved =
        rest.cols() == 0 ? 0.0 : wish.values.head(rest.size()).reshaped(3, rest.cols()).colwise().norm().maxCoeff();
    const double error =
        made->gauge.error(wish.values, control, approach, in_proportion(by_force, moved, *body.surface)).value_or(0.0);
    const bool crushed = std::isinf(error);
    const bool handles_move = !wish.values.head(wish.values.size() - std::ssize(set.loads)).isZero(0.0);
    return {std::move(made),
            {.relative = crushed ? 0.0 : error,
             .crushed = crushed,
             .turns = turns(wish),
             .loads = !handles_move && approach.path.cols() == 0}};
}

void TheoryGauge::rest() {
    job_.cancel();
    job_.poll();
    wanted_.reset();
    error_.reset();
}

void TheoryGauge::update(const Body& body, const ConstrainedSet& set, const Wish& wish, const HandleForces& by_force) {
    switch (job_.poll()) {
        case JobEvent::finished: {
            Found found = job_.take();
            made_ = std::move(found.made);
            error_ = found.error;
            done_ = true;
            break;
        }
        case JobEvent::failed:
            done_ = true;
            break;
        case JobEvent::cancelled:
        case JobEvent::none:
            break;
    }
    const bool is_new =
        !wanted_ || surface_ != body.surface || material_ != body.material || set_ != set || !same(*wanted_, wish);
    if (is_new) {
        job_.cancel();
        error_.reset();
        done_ = false;
        wanted_ = wish;
        set_ = set;
        surface_ = body.surface;
        material_ = body.material;
        rest_ = {};
    }
    if (done_ || job_.running() || rest_.seconds() < kGaugeRestSeconds) return;
    job_.start([made = made_, body, set, wish, by_force](Control& control) {
        control.begin_stage("gauge");
        return find(made, body, set, wish, by_force, control);
    });
}

}  // namespace elastolab
