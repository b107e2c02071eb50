#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "bem/collocation/constant_constraints.hpp"
#include "bem/collocation/method.hpp"
#include "deform/constraint_map.hpp"
#include "elasticity/material.hpp"
#include "fem/method.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "study/paper/paper_picture.hpp"
#include "study/paper/paper_procedure.hpp"
#include "study/paper/paper_report.hpp"
#include "study/report/statistics.hpp"
#include "study/setups.hpp"
#include "study/study.hpp"

namespace elastolab {

namespace {

constexpr double kShares[] = {0.1, 0.3};

Body cube(int cells) { return study_body(make_box(cells), Material{1.0, 0.3}, "cube"); }

Row share_cells(double share) { return Row().set("share", share); }

/// Largest relative difference between the displacements of the updates.
double disagreement(const std::vector<PaperUpdate>& updates) {
    double worst = 0.0;
    for (const PaperUpdate& update : updates)
        worst = std::max(worst, relative_error(update.displacements, updates.front().displacements));
    return worst;
}

std::vector<Row> measure_paper_procedure(MethodKind kind, int cells, unsigned seed, Control& control) {
    const Body body = cube(cells);
    PaperSystem system;
    std::vector<double> seconds;
    median_seconds(
        [&] {
            system = {};
            system = paper_precomputation(body, kind, control);
            seconds.push_back(system.seconds);
        },
        0.5, 5);
    const double precompute = median(seconds);
    const Row sizes = Row().set("vertices", body.surface->n_vertices()).set("nodes", system.n_nodes());
    std::vector<Row> rows = {Row(sizes).set("part", "precompute").set("precompute_s", precompute)};
    for (const double share : kShares) {
        // Nobody grabs a node inside: FEM's share is one of its surface vertices, which are its first nodes.
        const int n = kind->has_inside ? body.surface->n_vertices() : system.n_nodes();
        const std::vector<int> known = choose_share(n, share, seed);
        control.checkpoint();
        const std::vector<PaperUpdate> updates = paper_updates(system, known);
        for (const PaperUpdate& update : updates)
            rows.push_back(Row(sizes)
                               .set("part", "update")
                               .add(share_cells(share))
                               .set("known_nodes", std::ssize(known))
                               .set("update", update.name)
                               .set("set_change_s", update.set_change_seconds)
                               .set("frame_s", update.frame_seconds)
                               .set("disagreement", disagreement(updates)));
    }
    return rows;
}

int n_constrained_nodes(const SurfaceMesh& mesh, MethodKind kind, const std::vector<int>& vertices) {
    if (kind != kConstantBem) return static_cast<int>(vertices.size());
    return static_cast<int>(constrain_triangles(mesh, VertexTriangles(mesh), vertices).nodes.size());
}

/// A share of the vertices. For constant BEM, whose nodes are triangles, as few vertices as constrain that share of
/// them: a lone vertex constrains all triangles around it.
std::vector<int> choose_vertices(const SurfaceMesh& mesh, MethodKind kind, double share, unsigned seed) {
    const int n = mesh.n_vertices();
    if (kind != kConstantBem) return choose_share(n, share, seed);
    int low = 3, high = n;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (n_constrained_nodes(mesh, kind, choose_numbers(n, middle, seed)) < share * mesh.n_triangles())
            low = middle + 1;
        else
            high = middle;
    }
    return choose_numbers(n, low, seed);
}

/// A share of the vertices in two patches around opposite corners of the cube, as people hold and pull.
std::vector<int> choose_patches(const SurfaceMesh& mesh, double share) {
    std::vector<int> vertices(static_cast<std::size_t>(mesh.n_vertices()));
    std::iota(vertices.begin(), vertices.end(), 0);
    const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff(), high = mesh.vertices.rowwise().maxCoeff();
    const auto from_corner = [&](int v) {
        return std::min((mesh.vertices.col(v) - low).norm(), (mesh.vertices.col(v) - high).norm());
    };
    std::stable_sort(vertices.begin(), vertices.end(), [&](int a, int b) { return from_corner(a) < from_corner(b); });
    vertices.resize(static_cast<std::size_t>(std::max(3L, std::lround(share * mesh.n_vertices()))));
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

/// On demand: BEM factorises ahead, FEM once a set is known; then the columns of the known vertices, and the drag
/// response. Columns are kept whatever memory they take.
std::vector<Row> measure_our_procedure(MethodKind kind, int cells, unsigned seed, Control& control) {
    const Body body = cube(cells);
    const int n = body.surface->n_vertices();
    const Method method{.kind = kind, .column_memory = std::uint64_t{1} << 33};
    std::vector<Row> rows;
    for (const auto& [share, choice] :
         {std::pair{0.1, "random"}, {0.3, "random"}, {0.1, "patches"}, {0.3, "patches"}}) {
        const bool random = choice == std::string("random");
        const std::vector<int> known =
            random ? choose_vertices(*body.surface, kind, share, seed) : choose_patches(*body.surface, share);
        std::vector<double> precomputed, first, again;
        std::unique_ptr<Deformer> deformer;
        median_seconds(
            [&] {
                const Stopwatch watch;
                deformer = std::make_unique<Deformer>(precompute(body, method, control));
                precomputed.push_back(watch.seconds());
                deformer->constrain({{}, known}, control);
                first.push_back(watch.seconds() - precomputed.back());
                deformer->constrain({{}, known}, control);
                again.push_back(watch.seconds() - precomputed.back() - first.back());
            },
            0.5, 5);
        const DragResponse drag =
            deformer->drag_response(Eigen::VectorXd::Zero(3 * std::ssize(known)), translation_basis(known.size()));
        Eigen::VectorXd u;
        const Eigen::VectorXd shift = Eigen::Vector3d(0.1, 0.2, 0.3);
        const double frame = median_seconds_of_short([&] { drag.displace(shift, u); });
        const Row sizes = Row()
                              .set("vertices", n)
                              .set("nodes", deformer->model().facts().n_degrees_of_freedom / 3)
                              .add(share_cells(share))
                              .set("choice", std::string(choice))
                              .set("known_nodes", n_constrained_nodes(*body.surface, kind, known));
        rows.push_back(Row(sizes).set("part", "precompute").set("precompute_s", median(precomputed)));
        rows.push_back(Row(sizes)
                           .set("part", "update")
                           .set("update", "on-demand")
                           .set("set_change_s", median(first))
                           .set("ready_s", median(precomputed) + median(first))
                           .set("frame_s", frame));
        rows.push_back(Row(sizes)
                           .set("part", "update")
                           .set("update", "known-columns")
                           .set("set_change_s", median(again))
                           .set("frame_s", frame));
    }
    return rows;
}

std::vector<Row> measure_artefact(MethodKind kind, int cells, Control& control) {
    const EdgeArtefact artefact = edge_artefact(kind, cells, control);
    return {Row()
                .set("part", "fig1")
                .set("vertices", artefact.deformed.n_vertices())
                .set("edge_error", artefact.on_edges)
                .set("face_error", artefact.on_faces)};
}

/// Cells along an edge of the cube, so that each method reaches the paper's sizes and the cheaper ones go beyond.
std::vector<int> sizes(MethodKind kind, bool paper_procedure, bool quick) {
    if (quick) return {2, 3, 4};
    std::vector<int> cells = {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
    if (kind == kLinearBem || !paper_procedure) cells.insert(cells.end(), {14, 16});
    if (kind != kLinearBem && paper_procedure) cells.insert(cells.end(), {14, 15});  // around the crossing
    if (kind == kFem && !paper_procedure) cells.insert(cells.end(), {20, 26});
    return cells;
}

/// Nodes cubed, plus what every case costs.
double weight_of(MethodKind kind, int cells, bool paper_procedure) {
    const double vertices = 6.0 * cells * cells, inside = (cells - 1.0) * (cells - 1.0) * (cells - 1.0);
    const double nodes = kind == kFem ? vertices + inside : kind == kConstantBem ? 2.0 * vertices : vertices;
    if (kind == kFem && !paper_procedure) return 1.0 + 1e-3 * nodes;
    return 1.0 + (paper_procedure ? 4e-9 : 4e-10) * nodes * nodes * nodes;
}

void add_case(std::vector<Case>& cases, const std::string& way, MethodKind kind, int cells, double weight,
              std::function<std::vector<Row>(Control&)> run) {
    cases.push_back({Row().set("way", way).set("method", text(kind)).set("cells", cells), weight, std::move(run)});
}

}  // namespace

Study make_paper_study(const StudyOptions& options) {
    Study study;
    study.name = "paper";
    study.title = "The figures of the paper, measured again";
    study.columns = {"way",     "method",       "cells",      "part",         "vertices",     "nodes",
                     "share",   "known_nodes",  "update",     "precompute_s", "set_change_s", "ready_s",
                     "frame_s", "disagreement", "edge_error", "face_error",   "choice"};
    for (const MethodKind kind : paper_methods()) {
        for (const int cells : sizes(kind, true, options.quick))
            add_case(study.cases, "paper", kind, cells, weight_of(kind, cells, true),
                     [=](Control& control) { return measure_paper_procedure(kind, cells, options.seed, control); });
        for (const int cells : sizes(kind, false, options.quick))
            add_case(study.cases, "ours", kind, cells, weight_of(kind, cells, false),
                     [=](Control& control) { return measure_our_procedure(kind, cells, options.seed, control); });
        const int cells = options.quick ? 4 : 8;
        add_case(study.cases, "fig1", kind, cells, 0.5,
                 [=](Control& control) { return measure_artefact(kind, cells, control); });
    }
    study.conclude = [](const Table& table, Control& control) {
        Conclusions conclusions = conclude_paper(table);
        const Table pictured = table.where({{"part", "fig1"}});
        if (pictured.rows.empty()) return conclusions;
        const auto cells = static_cast<int>(pictured.rows.front().number("cells"));
        conclusions.plots.push_back(
            edge_picture({edge_artefact(kConstantBem, cells, control), edge_artefact(kLinearBem, cells, control)}));
        return conclusions;
    };
    return study;
}

}  // namespace elastolab
