#include "scene/figure/figure.hpp"

#include <algorithm>
#include <ostream>
#include <string_view>

#include "base/error.hpp"
#include "base/text.hpp"
#include "deform/surface_stress.hpp"
#include "scene/figure/figure_page.hpp"
#include "scene/file/json_text.hpp"

namespace elastolab {

namespace {

std::string base64(const void* data, std::size_t size) {
    static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto* bytes = static_cast<const unsigned char*>(data);
    std::string text;
    text.reserve((size + 2) / 3 * 4);
    for (std::size_t i = 0; i < size; i += 3) {
        const std::size_t n = std::min<std::size_t>(3, size - i);
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < n ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= n ? kLetters[bits >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::string reals(const Eigen::Ref<const Eigen::MatrixXd>& values) {
    const Eigen::MatrixXf single = values.cast<float>();
    return base64(single.data(), sizeof(float) * static_cast<std::size_t>(single.size()));
}

std::string integers(const int* data, std::size_t n) { return base64(data, sizeof(int) * n); }

/// Displacement and stress for some values, with the tractions that hold them.
void solve_for(const Deformer& deformer, const Eigen::VectorXd& values, const std::vector<int>& constrained,
               Eigen::Ref<Eigen::VectorXd> displacement, Eigen::Ref<Eigen::VectorXd> stress, Control& control) {
    const Body& body = deformer.model().body();
    const Deformer::Answer answer = deformer.answer(values, {}, control);
    displacement = answer.displacements;
    const std::vector<UnitLoad>& loads = deformer.set().loads;
    stress = surface_stress(*body.surface, body.material, answer.displacements,
                            vertex_tractions(*body.surface, constrained, answer.reactions.forces), false,
                            load_tractions(*body.surface, loads, values.tail(std::ssize(loads))))
                 .reshaped();
}

/// The motion of one of six kinds at a point of a handle.
Eigen::Vector3d unit_motion(int kind, const Eigen::Vector3d& from_centre) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(kind % 3);
    return kind < 3 ? axis : Eigen::Vector3d(axis.cross(from_centre));
}

void require_sensible(const Deformer& deformer, std::size_t n_handles) {
    const std::string& name = deformer.model().body().name;
    if (const std::string why = figure_refusal(deformer.model().method().kind, n_handles); !why.empty())
        throw Error(name + ": " + why);
    const double n = deformer.model().facts().n_vertices;
    const double bytes = n * (3 + 9 * (1 + 6 * static_cast<double>(n_handles))) * sizeof(float) * 4 / 3;
    if (bytes > kLargestFigure)
        throw Error(name + ": a figure of it would take " + readable_bytes(bytes) +
                    ". Use a proxy of fewer vertices, or fewer handles.");
}

}  // namespace

std::string figure_refusal(MethodKind method, std::size_t n_handles) {
    if (!method->linear) return "a figure needs a linear method, as it adds up answers. Choose a linear method.";
    if (n_handles == 0) return "there is no handle to pull in a figure. Add a handle.";
    return {};
}

Figure make_figure(const Deformer& deformer, const Eigen::VectorXd& values, const std::vector<ConstraintGroup>& groups,
                   Control& control) {
    const ConstrainedSet& set = deformer.set();
    const auto n_fixed = static_cast<int>(set.fixed.size());
    std::vector<ConstraintGroup> handles;
    for (const ConstraintGroup& group : groups)
        if (group.begin >= n_fixed && group.end > group.begin) handles.push_back(group);
    require_sensible(deformer, handles.size());
    control.begin_stage("figure");
    std::vector<int> constrained = set.fixed;
    constrained.insert(constrained.end(), set.handles.begin(), set.handles.end());
    const Model& model = deformer.model();
    const Positions& x = model.body().surface->vertices;
    Figure figure{.title = std::filesystem::path(model.body().name).filename().string(),
                  .method = std::string(name(model.method().kind)),
                  .surface = model.body().surface,
                  .fixed = set.fixed,
                  .displacement = Eigen::VectorXd(3 * x.cols()),
                  .stress = Eigen::VectorXd(6 * x.cols()),
                  .handles = {}};
    solve_for(deformer, values, constrained, figure.displacement, figure.stress, control);
    for (const ConstraintGroup& group : handles) {
        FigureHandle handle{.name = group.name,
                            .vertices = {constrained.begin() + group.begin, constrained.begin() + group.end},
                            .centre = Eigen::Vector3d::Zero(),
                            .displacement = Eigen::MatrixXd(3 * x.cols(), 6),
                            .stress = Eigen::MatrixXd(6 * x.cols(), 6)};
        handle.centre = x(Eigen::all, handle.vertices).rowwise().mean();
        for (int kind = 0; kind < 6; ++kind) {
            Eigen::VectorXd motion = Eigen::VectorXd::Zero(values.size());  // without loads
            for (std::size_t i = 0; i < handle.vertices.size(); ++i)
                motion.segment<3>(3 * (group.begin - n_fixed + static_cast<Eigen::Index>(i))) =
                    unit_motion(kind, x.col(handle.vertices[i]) - handle.centre);
            solve_for(deformer, motion, constrained, handle.displacement.col(kind), handle.stress.col(kind), control);
        }
        figure.handles.push_back(std::move(handle));
        control.set_progress(static_cast<double>(figure.handles.size()) / static_cast<double>(handles.size()));
    }
    return figure;
}

void write_figure(std::ostream& out, const Figure& figure) {
    const SurfaceMesh& surface = *figure.surface;
    Json data = {{"title", figure.title},
                 {"method", figure.method},
                 {"vertices", reals(surface.vertices)},
                 {"triangles", integers(surface.triangles.data(), static_cast<std::size_t>(surface.triangles.size()))},
                 {"fixed", integers(figure.fixed.data(), figure.fixed.size())},
                 {"displacement", reals(figure.displacement)},
                 {"stress", reals(figure.stress)},
                 {"handles", Json::array()}};
    for (const FigureHandle& handle : figure.handles)
        data["handles"].push_back({{"name", handle.name},
                                   {"vertices", integers(handle.vertices.data(), handle.vertices.size())},
                                   {"centre", {handle.centre.x(), handle.centre.y(), handle.centre.z()}},
                                   {"displacement", reals(handle.displacement)},
                                   {"stress", reals(handle.stress)}});
    std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace);
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
    constexpr std::string_view kPlace = "@DATA@";
    const std::size_t place = kFigurePage.find(kPlace);
    out << kFigurePage.substr(0, place) << text << kFigurePage.substr(place + kPlace.size());
}

bool is_figure_file(const std::filesystem::path& file) { return lower_case(file.extension().string()) == ".html"; }

}  // namespace elastolab
