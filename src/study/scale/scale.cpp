#include <algorithm>
#include <optional>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "findings/cost.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "study/peak_memory.hpp"
#include "study/report/statistics.hpp"
#include "study/scale/scale_report.hpp"
#include "study/setups.hpp"
#include "study/study.hpp"

namespace elastolab {

namespace {

/// A method in a mode, and the cubes that it is measured on (82 cells have 40 346 vertices): the largest take some
/// minutes on two cores, or a few gigabytes.
struct Growth {
    Method method;
    std::vector<int> cells;
};

std::vector<Growth> growths(bool quick) {
    const auto method = [](MethodKind kind, Mode mode) {
        Method chosen;
        chosen.kind = kind;
        chosen.mode = mode;
        return chosen;
    };
    const auto cells = [quick](int largest) {
        std::vector<int> all;
        for (const int n : {3, 4, 5, 6, 8, 10, 13, 16, 20, 24, 30, 36, 45, 58, 82})
            if (n <= (quick ? std::min(largest, 5) : largest)) all.push_back(n);
        return all;
    };
    return {{method(kGalerkinBem, Mode::on_demand), cells(82)},  {method(kGalerkinBem, Mode::full), cells(16)},
            {method(kQuadraticFem, Mode::on_demand), cells(30)}, {method(kNonlinearFem, Mode::on_demand), cells(13)},
            {method(kFem, Mode::on_demand), cells(82)},          {method(kFem, Mode::full), cells(16)},
            {method(kFem, Mode::full_volume), cells(10)},        {method(kConstantBem, Mode::on_demand), cells(20)},
            {method(kConstantBem, Mode::full), cells(10)},       {method(kLinearBem, Mode::on_demand), cells(82)},
            {method(kLinearBem, Mode::full), cells(16)}};
}

ConstrainedSet held_and_pulled(const SurfaceMesh& mesh) {
    const Eigen::Vector3d middle(1.0, 0.5, 0.5);
    return {vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; }),
            vertices_where(mesh, [&](const auto& x) { return x[0] > 1.0 - 1e-9 && (x - middle).norm() < 0.26; })};
}

std::vector<Row> measure_growth(const Method& method, int cells, Control& control) {
    const Body body = study_body(make_box(cells), Material{1.0, 0.3}, "cube");
    const ConstrainedSet set = held_and_pulled(*body.surface);
    const Cost predicted = predict_cost(*body.surface, method);
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(3 * std::ssize(set.handles));
    const Eigen::MatrixXd basis = translation_basis(set.handles.size());
    std::vector<double> precomputed, set_change;
    double model_bytes = 0.0, all_bytes = 0.0;
    std::optional<Deformer> deformer;
    median_seconds(
        [&] {
            deformer.reset();
            const PeakMemory peak;
            const Stopwatch watch;
            deformer.emplace(precompute(body, method, control));
            precomputed.push_back(watch.seconds());
            model_bytes = std::max(model_bytes, peak.bytes());
            deformer->constrain(set, control);
            if (!deformer->linear()) deformer->drag_response(rest, basis);  // which factorises
            set_change.push_back(watch.seconds() - precomputed.back());
            all_bytes = std::max(all_bytes, peak.bytes());
        },
        0.5, 5);
    const DragResponse drag = deformer->drag_response(rest, basis);
    Eigen::VectorXd u;
    const Eigen::VectorXd shift = Eigen::Vector3d(0.1, 0.2, 0.3);
    const double frame = median_seconds_of_short([&] { drag.displace(shift, u); });
    Row row;
    if (!deformer->linear()) {
        const Eigen::VectorXd values = 0.2 * basis * shift;
        row.set("equilibrium_s", median_seconds(
                                     [&] {
                                         deformer->displace(values, control, kSolveTolerance, {drag.equilibrium, {}});
                                     },
                                     0.5, 3));
    }
    return {row.set("vertices", body.surface->n_vertices())
                .set("unknowns", deformer->model().facts().n_degrees_of_freedom)
                .set("constrained", std::ssize(set.fixed) + std::ssize(set.handles))
                .set("precompute_s", median(precomputed))
                .set("set_change_s", median(set_change))
                .set("frame_s", frame)
                .set("predicted_s", predicted.seconds())
                .set("predicted_bytes", predicted.memory_bytes)
                .set("measured_bytes", model_bytes)
                .set("with_set_bytes", all_bytes)};
}

}  // namespace

Study make_scale_study(const StudyOptions& options) {
    Study study;
    study.name = "scale";
    study.title = "Time and memory against size";
    study.columns = {"method",          "mode",           "cells",         "vertices", "unknowns",
                     "constrained",     "precompute_s",   "set_change_s",  "frame_s",  "predicted_s",
                     "predicted_bytes", "measured_bytes", "with_set_bytes"};
    for (const Growth& growth : growths(options.quick))
        for (const int cells : growth.cells) {
            const Row id = Row()
                               .set("method", text(growth.method.kind))
                               .set("mode", std::string(name(growth.method.mode)))
                               .set("cells", cells);
            const double weight = 1.0 + (growth.method.kind == kFem ? 3e-4 : 3e-3) * 6.0 * cells * cells;  // seconds
            study.cases.push_back({id, weight, [method = growth.method, cells](Control& control) {
                                       return measure_growth(method, cells, control);
                                   }});
        }
    study.conclude = [](const Table& table, Control&) { return conclude_scale(table); };
    return study;
}

}  // namespace elastolab
