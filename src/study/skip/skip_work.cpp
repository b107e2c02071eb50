#include "study/skip/skip_work.hpp"

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "study/report/statistics.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

using Seconds = std::function<double(const SkipScene&)>;

double timed(const std::function<void()>& work) { return median_seconds(work, 0.5, 5); }

Method changed(Method method, Mode mode, Update update = Update::reduced) {
    method.mode = mode;
    method.update = update;
    return method;
}

/// From the mesh to a constrained set, in one mode.
Seconds ready_in(Mode mode, Update update = Update::reduced) {
    return [=](const SkipScene& scene) {
        return timed([&] { scene.ready(scene.model(changed(scene.method, mode, update))); });
    };
}

Seconds precomputed_in(Mode mode) {
    return [=](const SkipScene& scene) { return timed([&] { scene.model(changed(scene.method, mode)); }); };
}

Eigen::VectorXd pull(const SkipScene& scene) {
    return Eigen::Vector3d(0.1, 0.2, 0.3).replicate(std::ssize(scene.set.handles), 1);
}

double drag_frame(const SkipScene& scene) {
    const Deformer deformer = scene.ready(scene.model(scene.method));
    const DragResponse drag = deformer.drag_response(Eigen::VectorXd::Zero(3 * std::ssize(scene.set.handles)),
                                                     translation_basis(scene.set.handles.size()));
    Eigen::VectorXd u;
    const Eigen::VectorXd shift = Eigen::Vector3d(0.1, 0.2, 0.3);
    return median_seconds_of_short([&] { drag.displace(shift, u); });
}

double displace_frame(const SkipScene& scene) {
    const Deformer deformer = scene.ready(scene.model(scene.method));
    const Eigen::VectorXd values = pull(scene);
    return median_seconds_of_short([&] { deformer.displace(values); });
}

/// Eqn. 7 as it stands, for every frame.
double afresh_frame(const SkipScene& scene) {
    const auto model = scene.model(changed(scene.method, Mode::on_demand, Update::direct));
    const Eigen::VectorXd values = pull(scene);
    return timed([&] { scene.ready(model).displace(values); });
}

double known_columns(const SkipScene& scene) {
    Deformer deformer = scene.ready(scene.model(scene.method));
    ConstrainedSet fewer = scene.set;
    fewer.handles.pop_back();
    bool odd = false;
    return timed([&] { deformer.constrain((odd = !odd) ? fewer : scene.set, scene.control); });
}

double unknown_columns(const SkipScene& scene) {
    std::vector<double> seconds;
    timed([&] {
        const auto model = scene.model(scene.method);
        seconds.push_back(median_seconds([&] { scene.ready(model); }, 0.0, 1));
    });
    return median(seconds);
}

/// Another material for an existing model, which has seen another Poisson's ratio before.
Seconds again_with(double E, double nu) {
    return [=](const SkipScene& scene) {
        const auto first = scene.model(scene.method);
        const auto model = precompute_again(*first, {1.0, 0.35}, scene.method, scene.control);
        return timed([&] { precompute_again(*model, {E, nu}, scene.method, scene.control); });
    };
}

/// Another fixed set for an existing model: each time a fresh one, which has none of its columns yet.
double fixed_set_on_known_model(const SkipScene& scene) {
    ConstrainedSet other = scene.set;
    other.handles.push_back(other.fixed.back());
    other.fixed.pop_back();
    std::vector<double> seconds;
    timed([&] {
        Deformer deformer = scene.ready(scene.model(scene.method));
        const Stopwatch watch;
        deformer.constrain(other, scene.control);
        seconds.push_back(watch.seconds());
    });
    return median(seconds);
}

/// A handle changes to other vertices while the fixed set stays, given as the fixed set or among the handles. Each time
/// for a fresh model, which has none of the new handle's columns yet.
Seconds handles_change(bool fixed_set_is_known) {
    return [=](const SkipScene& scene) {
        ConstrainedSet before = scene.set, after = scene.set;
        const auto half = static_cast<std::ptrdiff_t>(scene.set.handles.size() / 2);
        before.handles.erase(before.handles.begin(), before.handles.begin() + half);
        after.handles.erase(after.handles.begin() + half, after.handles.end());
        for (ConstrainedSet* set : {&before, &after})
            if (!fixed_set_is_known) {
                set->handles.insert(set->handles.end(), set->fixed.begin(), set->fixed.end());
                set->fixed.clear();
            }
        std::vector<double> seconds;
        timed([&] {
            Deformer deformer(scene.model(scene.method));
            deformer.constrain(before, scene.control);
            const Stopwatch watch;
            deformer.constrain(after, scene.control);
            seconds.push_back(watch.seconds());
        });
        return median(seconds);
    };
}

double every_method(const SkipScene& scene) {
    return timed([&] {
        for (const MethodKind kind : paper_methods()) {
            Method method;
            method.kind = kind;
            scene.model(method);
        }
    });
}

Seconds tolerance(double relative_error) {
    return [=](const SkipScene& scene) {
        Method method = changed(scene.method, Mode::on_demand, Update::reduced);
        method.integral_tolerance = relative_error;
        return timed([&] { scene.model(method); });
    };
}

}  // namespace

SkipScene::SkipScene(MethodKind kind, int cells, Control& its_control)
    : body(study_body(make_box(cells), Material{1.0, 0.3}, "cube")), control(its_control) {
    method.kind = kind;
    const Eigen::Vector3d middle(1.0, 0.5, 0.5);
    set.fixed = vertices_where(*body.surface, [](const auto& x) { return x[0] < 1e-9; });
    set.handles =
        vertices_where(*body.surface, [&](const auto& x) { return x[0] > 1.0 - 1e-9 && (x - middle).norm() < 0.26; });
}

Deformer SkipScene::ready(std::shared_ptr<const Model> its_model) const {
    Deformer deformer(std::move(its_model));
    deformer.constrain(set, control);
    return deformer;
}

std::vector<Skip> all_skips() {
    const MethodKind fem = kFem, linear = kLinearBem, constant = kConstantBem;
    std::vector<Skip> skips = {
        {"interior", "interior nodes: a dense inverse of the surface's nodes instead of all", fem,
         precomputed_in(Mode::full), precomputed_in(Mode::full_volume)},
        {"dense-inverse", "columns nobody asks for: a sparse factor instead of the paper's dense inverse", fem,
         ready_in(Mode::on_demand), ready_in(Mode::full_volume)},
        {"hidden", "methods that are not shown", linear, precomputed_in(Mode::on_demand), every_method},
        {"base-known", "columns of fixed sets: eliminated once instead of treated as handles", fem,
         handles_change(true), handles_change(false)},
        {"poisson", "integrals when Poisson's ratio changes (from the second time on)", kGalerkinBem,
         again_with(1.0, 0.4), precomputed_in(Mode::on_demand)},
    };
    for (const MethodKind kind : {fem, constant, linear}) {
        const bool is_fem = kind == fem;
        if (!is_fem) {
            skips.push_back({"columns", "columns of K^-1 and of G nobody asks for: on demand instead of full", kind,
                             ready_in(Mode::on_demand), ready_in(Mode::full)});
            skips.push_back({"far-integrals", "closed forms far away, where Gauss rules keep 1e-10", kind,
                             tolerance(1e-10), tolerance(1e-16)});
        }
        skips.push_back({"frame-solve", "solving for a frame: the drag response instead of the capacitance system",
                         kind, drag_frame, displace_frame});
        skips.push_back({"frame-afresh", "solving for a frame: the drag response instead of Eqn. 7", kind, drag_frame,
                         afresh_frame});
        skips.push_back(
            {"known-columns", "columns that are kept when a handle changes", kind, known_columns, unknown_columns});
        skips.push_back({"young", "everything when Young's modulus changes", kind, again_with(2.0, 0.35),
                         precomputed_in(Mode::on_demand)});
        if (is_fem)
            skips.push_back({"poisson", "tetrahedra and integrals when Poisson's ratio changes", kind,
                             again_with(1.0, 0.4), precomputed_in(Mode::on_demand)});
        skips.push_back({"base-change", "the precomputation when the fixed set changes", kind, fixed_set_on_known_model,
                         ready_in(Mode::on_demand)});
        skips.push_back({"single-solve", "what only a drag needs: one factorisation for a single solve", kind,
                         ready_in(Mode::on_demand, Update::direct), ready_in(Mode::on_demand)});
    }
    return skips;
}

}  // namespace elastolab
