#include "scene/live/live_scene.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace elastolab {

namespace {

/// The vertices of `all` that are not among `some`.
std::vector<int> without(std::span<const int> all, std::span<const int> some) {
    std::vector<int> sorted(some.begin(), some.end()), rest;
    std::sort(sorted.begin(), sorted.end());
    for (const int v : all)
        if (!std::binary_search(sorted.begin(), sorted.end(), v)) rest.push_back(v);
    return rest;
}

}  // namespace

LiveScene::LiveScene(Document document, std::filesystem::path scene_file)
    : LiveScene(std::move(document), std::move(scene_file), *std::make_unique<Control>()) {}

LiveScene::LiveScene(Document document, std::filesystem::path scene_file, Control& control)
    : document_(std::move(document)),
      file_(std::move(scene_file)),
      mesh_(load_scene_mesh(document_.mesh, file_, control)),
      history_(document_) {
    if (document_.proxy.use == ProxyUse::never)
        require_usable(mesh_.checked.report, mesh_.name, false);
    else
        require_shape(mesh_.checked.report, mesh_.name);
    for (std::size_t i = 0; i < document_.handles.size(); ++i)
        if (std::string& name = document_.handles[i].name; name.empty()) name = "handle-" + std::to_string(i);
    for (std::size_t i = 0; i < document_.fixed.size(); ++i)
        if (std::string& name = document_.fixed[i].name; name.empty()) name = default_fixed_name(i);
    for (std::size_t i = 0; i < document_.loads.size(); ++i)
        if (std::string& name = document_.loads[i].name; name.empty()) name = default_load_name(i);
    saved_ = document_;
    history_ = History(document_);
    surface_ = std::make_shared<const SurfaceMesh>(std::move(mesh_.checked.mesh));
    mesh_.checked.mesh = {};
    become(document_);
}

Body LiveScene::body(MethodKind kind, const Proxy* proxy) const {
    // Named by itself, and not by its place in a file: it may have been chosen just now.
    if (const std::string why = refusal({.kind = kind}, document_.material.poisson_ratio); !why.empty())
        throw SceneError(why);
    require_material(document_.material, kind, file_);
    if (proxy == nullptr) require_usable(mesh_, kind);
    return {.name = mesh_.name, .surface = proxy ? proxy->surface : surface_, .material = document_.material};
}

std::span<const int> LiveScene::vertices(int owner) const {
    if (owner == kFixed) return constraints_.set.fixed;
    const auto group = static_cast<std::size_t>(owner) + (constraints_.has_fixed() ? 1 : 0);
    const ConstraintGroup& range = constraints_.groups[group];
    const auto n_fixed = constraints_.set.fixed.size();
    return std::span<const int>(constraints_.set.handles)
        .subspan(static_cast<std::size_t>(range.begin) - n_fixed, static_cast<std::size_t>(range.end - range.begin));
}

Positions LiveScene::rest_positions(int handle) const {
    const std::span<const int> own = vertices(handle);
    return surface_->vertices(Eigen::all, std::vector<int>(own.begin(), own.end()));
}

std::span<const int> LiveScene::fixed_vertices(int set) const {
    const ConstraintGroup& range = constraints_.fixed_sets[static_cast<std::size_t>(set)];
    return std::span<const int>(constraints_.set.fixed)
        .subspan(static_cast<std::size_t>(range.begin), static_cast<std::size_t>(range.end - range.begin));
}

int LiveScene::fixed_set_of(int vertex) const {
    if (owner(vertex) != kFixed) return kNobody;
    const std::vector<int>& all = constraints_.set.fixed;
    const auto place = std::find(all.begin(), all.end(), vertex) - all.begin();
    int set = 0;
    while (constraints_.fixed_sets[static_cast<std::size_t>(set)].end <= place) ++set;
    return set;
}

const std::string& LiveScene::handle_name(int handle) const {
    return constraints_.groups[static_cast<std::size_t>(handle) + (constraints_.has_fixed() ? 1 : 0)].name;
}

std::vector<int> LiveScene::only_free(std::span<const int> vertices) const {
    std::vector<int> result;
    for (const int v : vertices)
        if (owner(v) == kNobody) result.push_back(v);
    return result;
}

/// "handle-0", "handle-1", ...: the first that is not taken.
std::string LiveScene::unused_handle_name() const {
    std::size_t n = 0;
    while (is_taken("handle-" + std::to_string(n))) ++n;
    return "handle-" + std::to_string(n);
}

int LiveScene::add_handle(std::span<const int> vertices) {
    std::vector<int> own = only_free(vertices);
    if (own.empty()) return kNobody;
    Document changed = document_;
    changed.handles.push_back(
        {.name = unused_handle_name(), .select = {VertexSelector{std::move(own)}}, .motion = AffineMotion{}});
    become(std::move(changed));
    return n_handles() - 1;
}

void LiveScene::remove_handle(int handle) {
    Document changed = document_;
    changed.handles.erase(changed.handles.begin() + handle);
    become(std::move(changed));
}

void LiveScene::clear_handles() {
    Document changed = document_;
    changed.handles.clear();
    become(std::move(changed));
}

bool LiveScene::is_taken(const std::string& name) const {
    const auto has_name = [&](const auto& named) { return named.name == name; };
    return std::any_of(document_.handles.begin(), document_.handles.end(), has_name) ||
           std::any_of(document_.fixed.begin(), document_.fixed.end(), has_name);
}

bool LiveScene::rename_handle(int handle, const std::string& name) {
    if (name.empty() || name == "fixed" || is_taken(name)) return false;
    Document changed = document_;
    changed.handles[static_cast<std::size_t>(handle)].name = name;
    become(std::move(changed));
    return true;
}

bool LiveScene::rename_fixed_set(int set, const std::string& name) {
    if (name.empty() || is_taken(name)) return false;
    Document changed = document_;
    changed.fixed[static_cast<std::size_t>(set)].name = name;
    become(std::move(changed));
    return true;
}

std::string LiveScene::unused_fixed_name() const {
    std::size_t n = 0;
    while (is_taken(default_fixed_name(n))) ++n;
    return default_fixed_name(n);
}

void LiveScene::fix(std::span<const int> vertices, int set) {
    std::vector<int> all = only_free(vertices);
    if (all.empty()) return;
    Document changed = document_;
    if (set == n_fixed_sets()) {
        changed.fixed.push_back({.name = unused_fixed_name(), .select = {}});
    } else {
        const std::span<const int> present = fixed_vertices(set);
        all.insert(all.end(), present.begin(), present.end());
    }
    std::sort(all.begin(), all.end());
    changed.fixed[static_cast<std::size_t>(set)].select = {VertexSelector{std::move(all)}};
    become(std::move(changed));
}

void LiveScene::unfix(std::span<const int> vertices, int set) {
    Document changed = document_;
    bool any = false;
    for (int s = n_fixed_sets() - 1; s >= 0; --s) {
        if (set != kFixed && set != s) continue;
        std::vector<int> rest = without(fixed_vertices(s), vertices);
        if (rest.size() == fixed_vertices(s).size()) continue;
        any = true;
        if (rest.empty())
            changed.fixed.erase(changed.fixed.begin() + s);
        else
            changed.fixed[static_cast<std::size_t>(s)].select = {VertexSelector{std::move(rest)}};
    }
    if (any) become(std::move(changed));
}

void LiveScene::remove_fixed_set(int set) {
    Document changed = document_;
    changed.fixed.erase(changed.fixed.begin() + set);
    become(std::move(changed));
}

void LiveScene::set_motion(int handle, const Motion& motion) {
    const std::span<const int> own = vertices(handle);
    const auto begin = own.data() - constraints_.set.handles.data();
    const Eigen::Matrix3Xd u = displacements(motion, rest_positions(handle));
    const Eigen::VectorXd values = u.reshaped();
    if (!values.allFinite()) return;
    document_.handles[static_cast<std::size_t>(handle)].motion = motion;
    document_.handles[static_cast<std::size_t>(handle)].force.reset();
    constraints_.motions[static_cast<std::size_t>(handle)] = motion;
    constraints_.forces[static_cast<std::size_t>(handle)].reset();
    constraints_.values.segment(3 * begin, values.size()) = values;
    ++revision_;
}

void LiveScene::set_force(int handle, const std::optional<GripForce>& force) {
    const auto h = static_cast<std::size_t>(handle);
    if (force && !(force->force.allFinite() && force->moment.allFinite() && std::isfinite(force->spring))) return;
    if (!force) return set_motion(handle, Motion(document_.handles[h].motion));
    document_.handles[h].force = constraints_.forces[h] = force;
    ++revision_;
}

void LiveScene::set_equilibrium(int handle, const AffineMotion& motion) {
    const auto h = static_cast<std::size_t>(handle);
    if (!document_.handles[h].force || !displacements(motion, rest_positions(handle)).allFinite()) return;
    document_.handles[h].motion = motion;
    constraints_.motions[h] = motion;
}

void LiveScene::set_material(const Material& material) {
    document_.material = material;
    ++revision_;
}

void LiveScene::set_proxy(const ProxyChoice& choice) {
    document_.proxy = choice;
    ++revision_;
}

void LiveScene::set_method(MethodKind kind, const MethodSettings& settings) {
    document_.method = kind;
    document_.settings = settings;
    ++revision_;
}

void LiveScene::start_with(MethodKind kind, const MethodSettings& settings) {
    const bool was_modified = modified();
    set_method(kind, settings);
    history_ = History(document_);
    if (!was_modified) mark_saved();
}

/// Another method is another look at the same scene, which nobody wants to be asked about.
bool LiveScene::modified() const {
    if (!saved_) return true;
    if (saved_->settings == document_.settings && saved_->method == document_.method) return !(document_ == *saved_);
    Document as_saved = *saved_;
    as_saved.settings = document_.settings;
    as_saved.method = document_.method;
    return !(document_ == as_saved);
}

void LiveScene::undo() { become(history_.undo()); }

void LiveScene::redo() { become(history_.redo()); }

Constraints LiveScene::constraints_with_handle(std::span<const int> vertices) const {
    Constraints all = constraints_;
    const std::vector<int> own = only_free(vertices);
    if (own.empty()) return all;
    if (n_loads() > 0) {  // triangles of theirs may be constrained then
        Document with_handle = document_;
        with_handle.handles.push_back({.name = unused_handle_name(), .select = {VertexSelector{own}}, .motion = {}});
        return make_constraints(with_handle, *surface_, file_, ConstrainedTriangles::left_out);
    }
    const int begin = all.groups.empty() ? 0 : all.groups.back().end;
    all.set.handles.insert(all.set.handles.end(), own.begin(), own.end());
    // Loads stand behind the handles.
    const Eigen::VectorXd factors = all.values.tail(std::ssize(all.set.loads));
    const Eigen::Index n_before = all.values.size() - factors.size(), n_own = 3 * std::ssize(own);
    all.values.conservativeResize(all.values.size() + n_own);
    all.values.segment(n_before, n_own).setZero();
    all.values.tail(factors.size()) = factors;
    all.motions.emplace_back(AffineMotion{});
    all.forces.emplace_back();
    all.groups.push_back({unused_handle_name(), begin, begin + static_cast<int>(own.size())});
    return all;
}

/// Takes over the whole document or, on an exception, nothing of it.
void LiveScene::become(Document document) {
    constraints_ = make_constraints(document, *surface_, file_, ConstrainedTriangles::left_out);
    document_ = std::move(document);
    owners_.assign(static_cast<std::size_t>(surface_->n_vertices()), kNobody);
    for (const int v : vertices(kFixed)) owners_[static_cast<std::size_t>(v)] = kFixed;
    for (int h = 0; h < n_handles(); ++h)
        for (const int v : vertices(h)) owners_[static_cast<std::size_t>(v)] = h;
    ++revision_;
}

}  // namespace elastolab
