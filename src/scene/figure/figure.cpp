#include "scene/figure/figure.hpp"

#include <algorithm>
#include <limits>
#include <ostream>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
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

/// Displacement and stress of the shown vertices for some values.
void solve_for(SolvedBody body, Eigen::VectorXd values, Eigen::Ref<Eigen::VectorXd> displacement,
               Eigen::Ref<Eigen::VectorXd> stress, Control& control) {
    Deformer::Answer answer = body.deformer->answer(values, {}, control);
    body.values = std::move(values);
    body.simulated_displacement = std::move(answer.displacements);
    body.displacement = body.proxy ? carried_columns(*body.proxy, body.simulated_displacement.reshaped(
                                                                      3, body.simulated_displacement.size() / 3))
                                         .reshaped()
                                   : body.simulated_displacement;
    body.forces = std::move(answer.reactions.forces);
    displacement = body.displacement;
    stress = stress_of(body);
}

/// The shown vertices that follow these of the simulated surface: at least one where there is one of them.
std::vector<int> as_shown(const SolvedBody& body, const std::vector<int>& simulated) {
    if (!body.proxy || simulated.empty()) return simulated;
    Eigen::RowVectorXd is_one = Eigen::RowVectorXd::Zero(body.proxy->surface->n_vertices());
    for (const int v : simulated) is_one[v] = 1.0;
    const Eigen::RowVectorXd share = carried_columns(*body.proxy, is_one);
    const double enough = std::min(0.5, share.maxCoeff());
    std::vector<int> shown;
    for (int v = 0; v < static_cast<int>(share.size()); ++v)
        if (share[v] >= enough) shown.push_back(v);
    return shown;
}

/// The motion of one of six kinds at a point of a handle.
Eigen::Vector3d unit_motion(int kind, const Eigen::Vector3d& from_centre) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(kind % 3);
    return kind < 3 ? axis : Eigen::Vector3d(axis.cross(from_centre));
}

void require_sensible(const SolvedBody& body, std::size_t n_handles) {
    const Model& model = body.deformer->model();
    const double n = body.shown->n_vertices();
    const double bytes = n * (3 + 9 * (1 + 6 * static_cast<double>(n_handles))) * sizeof(float) * 4 / 3;
    if (bytes > kLargestFigure)
        throw Error(model.body().name + ": handles that can be pulled would take " + readable_bytes(bytes) +
                    ". Use fewer handles, or a surface of fewer vertices.");
}

/// Throws SolveError where numbers do not fit into the files.
void require_single_precision(const std::string& name, const Eigen::MatrixXd& numbers) {
    if (!(numbers.size() == 0 || numbers.cwiseAbs().maxCoeff() < std::numeric_limits<float>::max()))
        throw SolveError(name +
                         ": displacements or stresses are beyond single precision. Choose another unit of length or "
                         "force.");
}

}  // namespace

std::vector<ConstraintGroup> pulled_handles(const ConstrainedSet& set, const std::vector<ConstraintGroup>& groups) {
    std::vector<ConstraintGroup> handles;
    for (const ConstraintGroup& group : groups)
        if (group.begin >= static_cast<int>(set.fixed.size()) && group.end > group.begin) handles.push_back(group);
    return handles;
}

std::string figure_refusal(MethodKind method, std::size_t n_causes) {
    if (!method->linear) return "a figure needs a linear method, as it adds up answers. Choose a linear method.";
    if (n_causes == 0) return "there is no handle to pull in a figure. Add a handle.";
    return {};
}

Figure make_figure(const SolvedBody& solved, const std::vector<ConstraintGroup>& groups,
                   const Eigen::Vector3d& vertical, FigureUse use, Control& control) {
    const Model& model = solved.deformer->model();
    const ConstrainedSet& set = solved.deformer->set();
    const auto n_fixed = static_cast<int>(set.fixed.size());
    const std::vector<ConstraintGroup> handles = pulled_handles(set, groups);
    const std::size_t n_causes = handles.size() + (use == FigureUse::show ? set.loads.size() : 0);
    if (const std::string why = figure_refusal(model.method().kind, n_causes); !why.empty())
        throw Error(model.body().name + ": " + why);
    require_sensible(solved, handles.size());
    control.begin_stage("figure");
    const Positions& x = model.body().surface->vertices;
    const std::string& body = model.body().name;
    Figure figure{.title = std::filesystem::path(body).filename().string(),
                  .method = std::string(name(model.method().kind)),
                  .surface = solved.shown,
                  .vertical = vertical,
                  .fixed = as_shown(solved, set.fixed),
                  .displacement = solved.displacement,
                  .stress = stress_of(solved),
                  .handles = {}};
    require_single_precision(body, figure.displacement);
    require_single_precision(body, figure.stress);
    const Eigen::Index n = solved.shown->n_vertices();
    for (const ConstraintGroup& group : handles) {
        const std::vector<int> simulated(solved.constrained.begin() + group.begin,
                                         solved.constrained.begin() + group.end);
        FigureHandle handle{.name = group.name,
                            .vertices = as_shown(solved, simulated),
                            .centre = x(Eigen::all, simulated).rowwise().mean(),
                            .displacement = Eigen::MatrixXd(3 * n, 6),
                            .stress = Eigen::MatrixXd(6 * n, 6)};
        for (int kind = 0; kind < 6; ++kind) {
            Eigen::VectorXd motion = Eigen::VectorXd::Zero(solved.values.size());  // without loads
            for (std::size_t i = 0; i < simulated.size(); ++i)
                motion.segment<3>(3 * (group.begin - n_fixed + static_cast<Eigen::Index>(i))) =
                    unit_motion(kind, x.col(simulated[i]) - handle.centre);
            solve_for(solved, std::move(motion), handle.displacement.col(kind), handle.stress.col(kind), control);
        }
        require_single_precision(body, handle.displacement);
        require_single_precision(body, handle.stress);
        figure.handles.push_back(std::move(handle));
        control.set_progress(static_cast<double>(figure.handles.size()) / static_cast<double>(handles.size()));
    }
    return figure;
}

Eigen::Vector3d single_precision_origin(const Positions& positions) {
    constexpr double kFar = 16.0;  // four of the 24 binary digits
    const Eigen::Vector3d low = positions.rowwise().minCoeff(), high = positions.rowwise().maxCoeff();
    const double size = (high - low).maxCoeff(), away = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
    return away > kFar * size ? Eigen::Vector3d(0.5 * (low + high)) : Eigen::Vector3d::Zero();
}

void write_figure(std::ostream& out, const Figure& figure) {
    const SurfaceMesh& surface = *figure.surface;
    const Eigen::Vector3d origin = single_precision_origin(surface.vertices);
    const auto numbers = [](const Eigen::Vector3d& v) { return Json{v.x(), v.y(), v.z()}; };
    Json data = {{"title", figure.title},
                 {"method", figure.method},
                 {"origin", numbers(origin)},
                 {"vertical", numbers(figure.vertical)},
                 {"vertices", reals(surface.vertices.colwise() - origin)},
                 {"triangles", integers(surface.triangles.data(), static_cast<std::size_t>(surface.triangles.size()))},
                 {"fixed", integers(figure.fixed.data(), figure.fixed.size())},
                 {"displacement", reals(figure.displacement)},
                 {"stress", reals(figure.stress)},
                 {"handles", Json::array()}};
    for (const FigureHandle& handle : figure.handles)
        data["handles"].push_back({{"name", handle.name},
                                   {"vertices", integers(handle.vertices.data(), handle.vertices.size())},
                                   {"centre", numbers(handle.centre - origin)},
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
