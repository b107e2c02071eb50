#include "cli/info.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/text.hpp"
#include "cli/json_parts.hpp"
#include "findings/cost.hpp"
#include "methods/registry.hpp"

namespace elastolab {

namespace {

using Json = nlohmann::ordered_json;

const char* name(Defect::Kind kind) {
    switch (kind) {
        case Defect::Kind::no_triangles:
            return "no-triangles";
        case Defect::Kind::non_finite:
            return "non-finite";
        case Defect::Kind::open_edges:
            return "open-edges";
        case Defect::Kind::non_manifold_edges:
            return "non-manifold-edges";
        case Defect::Kind::non_manifold_vertices:
            return "non-manifold-vertices";
        case Defect::Kind::inconsistent_orientation:
            return "inconsistent-orientation";
        case Defect::Kind::inside_out:
            return "inside-out";
        case Defect::Kind::degenerate_triangles:
            return "degenerate-triangles";
        case Defect::Kind::sliver_triangles:
            return "sliver-triangles";
        case Defect::Kind::duplicate_triangles:
            return "duplicate-triangles";
        case Defect::Kind::unreferenced_vertices:
            return "unreferenced-vertices";
        case Defect::Kind::self_intersections:
            return "self-intersections";
        case Defect::Kind::zero_volume:
            return "zero-volume";
        case Defect::Kind::coarse_coordinates:
            return "coarse-coordinates";
        case Defect::Kind::too_small:
            return "too-small";
    }
    return "unknown";
}

/// What a defect means for the user. Where a proxy stands in for the surface, nothing has to be done about it.
const char* consequence(const Defect& defect, bool has_proxy) {
    if (defect.repaired) return "repaired";
    if (!defect.fatal && !defect.fatal_for_fem) return "warning";
    if (has_proxy) return "defect";
    return defect.fatal ? "error" : "error for fem";
}

std::string defect_words(const Defect& defect, bool has_proxy) {
    const bool stands_in = has_proxy && (defect.fatal || defect.fatal_for_fem) && !defect.repaired;
    return one_line(stands_in ? defect.found : defect.text);
}

std::string corner(const Eigen::Vector3d& x) { return formatted("(%.6g, %.6g, %.6g)", x.x(), x.y(), x.z()); }

void print_row(std::ostream& out, const char* label, const std::string& value) {
    out << formatted("  %-12s  ", label) << value << "\n";
}

void print_costs(std::ostream& out, const std::vector<MethodCost>& costs, bool filled) {
    out << formatted("  %-13s  %-12s  %12s  %12s  %10s\n", "method", "mode", "DOFs", "memory", "time");
    for (const MethodCost& row : costs) {
        out << formatted("  %-13s  %-12s  ", std::string(name(row.method.kind)).c_str(),
                         std::string(name(row.method.mode)).c_str());
        if (row.cost)
            out << formatted("%12lld  %12s  %10s", static_cast<long long>(row.cost->degrees_of_freedom),
                             readable_bytes(static_cast<double>(row.cost->memory_bytes)).c_str(),
                             readable_seconds(row.cost->seconds()).c_str())
                << (!row.on_proxy ? "\n"
                    : filled      ? "  with its holes filled\n"
                                  : "  on the proxy\n");
        else
            out << "not possible: see the errors above\n";
    }
}

Json to_json(const Defect& defect) {
    Json places = Json::array();
    for (const Eigen::Vector3d& place : defect.places) places.push_back(vector_json(place));
    return {{"kind", name(defect.kind)},
            {"count", defect.count},
            {"repaired", defect.repaired},
            {"fatal", defect.fatal},
            {"fatal_for_fem", defect.fatal_for_fem},
            {"places", places},
            {"text", defect.text}};
}

Json to_json(const MethodCost& row) {
    Json json = {{"method", std::string(name(row.method.kind))}, {"mode", std::string(name(row.method.mode))}};
    json["usable"] = row.cost.has_value() && !row.on_proxy;
    json["simulates"] = row.cost ? Json(row.on_proxy ? "proxy" : "surface") : Json(nullptr);
    json["degrees_of_freedom"] = row.cost ? Json(row.cost->degrees_of_freedom) : Json(nullptr);
    json["memory_bytes"] = row.cost ? Json(row.cost->memory_bytes) : Json(nullptr);
    json["seconds"] = row.cost ? finite_or_null(row.cost->seconds()) : Json(nullptr);
    return json;
}

template <class Items>
Json list(const Items& items) {
    Json json = Json::array();
    for (const auto& item : items) json.push_back(to_json(item));
    return json;
}

void make_proxy(MeshInfo& info, const ProxyChoice& choice, Control& control) {
    const auto shown = std::make_shared<const SurfaceMesh>(info.mesh.checked.mesh);
    try {
        require_shape(info.mesh.checked.report, info.mesh.name);
        info.proxy = make_proxy(info.mesh.name, shown, info.mesh.checked.report, choice, control);
    } catch (const MeshError& error) {
        info.proxy_problem = error.what();
    }
}

/// Whether a method can simulate the surface itself.
bool usable(const MeshReport& report, MethodKind kind) {
    return kind->has_inside ? report.usable_for_fem() : report.usable();
}

std::string proxy_words(const Proxy& proxy) {
    if (proxy.is_filled())
        return formatted("the surface with %d holes filled: %d vertices, %d faces", proxy.n_closed_holes,
                         proxy.surface->n_vertices(), proxy.surface->n_triangles());
    std::string words = formatted("%d vertices, %d faces, at most %.3g from the surface", proxy.surface->n_vertices(),
                                  proxy.surface->n_triangles(), proxy.places.distance.maxCoeff());
    if (proxy.n_closed_holes > 0) words += formatted("; taken for a solid, holes closed: %d", proxy.n_closed_holes);
    if (proxy.n_open_holes > 0 && proxy.thin_part > 0.0)
        words += formatted("; taken for a sheet, %.3g thick, openings: %d", proxy.thickness, proxy.n_open_holes);
    return words;
}

}  // namespace

MeshInfo inspect(SceneMesh mesh, const ProxyChoice& choice, Control& control) {
    MeshInfo info{.mesh = std::move(mesh), .proxy = {}, .proxy_problem = {}, .costs = {}};
    const MeshReport& report = info.mesh.checked.report;
    const auto on_proxy = [&](MethodKind kind) { return needs_proxy(choice, report, kind); };
    if (std::any_of(all_methods().begin(), all_methods().end(), on_proxy)) make_proxy(info, choice, control);
    for (const MethodKind kind : all_methods())
        for (const Mode mode : kind->modes) {
            MethodCost row{.method = {.kind = kind, .mode = mode}, .on_proxy = on_proxy(kind), .cost = {}};
            if (row.on_proxy && info.proxy) row.cost = predict_cost(*info.proxy->surface, row.method);
            if (!row.on_proxy && usable(report, kind)) row.cost = predict_cost(info.mesh.checked.mesh, row.method);
            info.costs.push_back(row);
        }
    return info;
}

void print_info(std::ostream& out, const MeshInfo& info) {
    const MeshReport& report = info.mesh.checked.report;
    const SurfaceMesh& mesh = info.mesh.checked.mesh;
    out << one_line(info.mesh.name) << "\n";
    print_row(out, "vertices", std::to_string(mesh.n_vertices()));
    print_row(out, "faces", std::to_string(mesh.n_triangles()));
    print_row(out, "components",
              std::to_string(report.n_components) + " (solids: " + std::to_string(report.n_solids) + ")");
    print_row(out, "closed", report.closed ? "yes" : "no");
    print_row(out, "volume", formatted("%.6g", report.volume));
    print_row(out, "area", formatted("%.6g", report.area));
    print_row(out, "corners", corner(report.min_corner) + " to " + corner(report.max_corner));
    print_row(out, "edges",
              formatted("%.4g to %.4g, mean %.4g", report.shortest_edge, report.longest_edge, report.mean_edge));
    print_row(out, "thinnest", formatted("altitude / edge %.3g", report.smallest_altitude_ratio));
    if (report.defects.empty()) print_row(out, "defects", "none");
    const bool has_proxy = info.proxy != nullptr;
    for (const Defect& defect : report.defects)
        print_row(out, consequence(defect, has_proxy), defect_words(defect, has_proxy));
    if (info.proxy) print_row(out, "proxy", proxy_words(*info.proxy));
    if (!info.proxy_problem.empty()) print_row(out, "no proxy", one_line(info.proxy_problem));
    print_costs(out, info.costs, info.proxy && info.proxy->is_filled());
}

void write_info(std::ostream& out, const MeshInfo& info) {
    const MeshReport& report = info.mesh.checked.report;
    const Json json = {
        {"mesh", info.mesh.name},
        {"vertices", info.mesh.checked.mesh.n_vertices()},
        {"faces", info.mesh.checked.mesh.n_triangles()},
        {"components", report.n_components},
        {"solids", report.n_solids},
        {"closed", report.closed},
        {"volume", finite_or_null(report.volume)},
        {"area", finite_or_null(report.area)},
        {"min", vector_json(report.min_corner)},
        {"max", vector_json(report.max_corner)},
        {"shortest_edge", finite_or_null(report.shortest_edge)},
        {"mean_edge", finite_or_null(report.mean_edge)},
        {"longest_edge", finite_or_null(report.longest_edge)},
        {"smallest_altitude_ratio", finite_or_null(report.smallest_altitude_ratio)},
        {"defects", list(report.defects)},
        {"usable", report.usable()},
        {"usable_for_fem", report.usable_for_fem()},
        {"proxy", proxy_json(info.proxy.get())},
        {"methods", list(info.costs)},
    };
    out << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace elastolab
