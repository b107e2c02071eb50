#include "scene/live/live_scene.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace elastolab {

namespace {

/// "handle-0", "handle-1", ...: the first that no handle has.
std::string unused_name(const std::vector<Handle>& handles) {
    for (std::size_t n = 0;; ++n) {
        std::string name = "handle-" + std::to_string(n);
        if (std::none_of(handles.begin(), handles.end(), [&](const Handle& h) { return h.name == name; })) return name;
    }
}

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
    saved_ = document_;
    history_ = History(document_);
    surface_ = std::make_shared<const SurfaceMesh>(std::move(mesh_.checked.mesh));
    mesh_.checked.mesh = {};
    become(document_);
}

Body LiveScene::body(MethodKind kind, const Proxy* proxy) const {
    require_material(document_.material, kind, file_);
    if (proxy == nullptr) require_usable(mesh_, kind);
    return {.name = mesh_.name, .surface = proxy ? proxy->surface : surface_, .material = document_.material};
}

std::span<const int> LiveScene::vertices(int owner) const {
    if (owner == kFixed) return constraints_.set.base;
    const auto group = static_cast<std::size_t>(owner) + (document_.fixed ? 1 : 0);
    const ConstraintGroup& range = constraints_.groups[group];
    const auto n_base = constraints_.set.base.size();
    return std::span<const int>(constraints_.set.handles)
        .subspan(static_cast<std::size_t>(range.begin) - n_base, static_cast<std::size_t>(range.end - range.begin));
}

const std::string& LiveScene::handle_name(int handle) const {
    return constraints_.groups[static_cast<std::size_t>(handle) + (document_.fixed ? 1 : 0)].name;
}

std::vector<int> LiveScene::only_free(std::span<const int> vertices) const {
    std::vector<int> result;
    for (const int v : vertices)
        if (owner(v) == kNobody) result.push_back(v);
    return result;
}

int LiveScene::add_handle(std::span<const int> vertices) {
    std::vector<int> own = only_free(vertices);
    if (own.empty()) return kNobody;
    Document changed = document_;
    changed.handles.push_back(
        {.name = unused_name(document_.handles), .select = {VertexSelector{std::move(own)}}, .motion = AffineMotion{}});
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

bool LiveScene::rename_handle(int handle, const std::string& name) {
    const std::vector<Handle>& all = document_.handles;
    const bool taken = std::any_of(all.begin(), all.end(), [&](const Handle& h) { return h.name == name; });
    if (name.empty() || name == "fixed" || taken) return false;
    Document changed = document_;
    changed.handles[static_cast<std::size_t>(handle)].name = name;
    become(std::move(changed));
    return true;
}

void LiveScene::fix(std::span<const int> vertices) {
    const std::span<const int> present = this->vertices(kFixed);
    std::vector<int> all(present.begin(), present.end());
    const std::vector<int> more = only_free(vertices);
    if (more.empty()) return;
    all.insert(all.end(), more.begin(), more.end());
    std::sort(all.begin(), all.end());
    replace_fixed(std::move(all));
}

void LiveScene::unfix(std::span<const int> vertices) {
    std::vector<int> rest = without(this->vertices(kFixed), vertices);
    if (rest.size() < this->vertices(kFixed).size()) replace_fixed(std::move(rest));
}

void LiveScene::replace_fixed(std::vector<int> vertices) {
    Document changed = document_;
    if (vertices.empty())
        changed.fixed.reset();
    else
        changed.fixed = Selector{VertexSelector{std::move(vertices)}};
    become(std::move(changed));
}

void LiveScene::set_motion(int handle, const Motion& motion) {
    const std::span<const int> own = vertices(handle);
    const auto begin = own.data() - constraints_.set.handles.data();
    Eigen::VectorXd values(3 * std::ssize(own));
    for (std::size_t i = 0; i < own.size(); ++i) {
        const Eigen::Vector3d x = surface_->vertices.col(own[i]);
        Eigen::Vector3d u;
        if (const auto* affine = std::get_if<AffineMotion>(&motion))
            u = affine->matrix * x + affine->translate;
        else
            u = std::get<VertexMotion>(motion).displacements[i];
        values.segment<3>(3 * static_cast<Eigen::Index>(i)) = u;
    }
    if (!values.allFinite()) return;
    document_.handles[static_cast<std::size_t>(handle)].motion = motion;
    constraints_.motions[static_cast<std::size_t>(handle)] = motion;
    constraints_.values.segment(3 * begin, values.size()) = values;
    ++revision_;
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
    const int begin = all.groups.empty() ? 0 : all.groups.back().end;
    all.set.handles.insert(all.set.handles.end(), own.begin(), own.end());
    all.values.conservativeResize(all.values.size() + 3 * std::ssize(own));
    all.values.tail(3 * std::ssize(own)).setZero();
    all.motions.emplace_back(AffineMotion{});
    all.groups.push_back({unused_name(document_.handles), begin, begin + static_cast<int>(own.size())});
    return all;
}

/// The whole of it or, on an exception, nothing.
void LiveScene::become(Document document) {
    constraints_ = make_constraints(document, *surface_, file_);
    document_ = std::move(document);
    owners_.assign(static_cast<std::size_t>(surface_->n_vertices()), kNobody);
    for (const int v : vertices(kFixed)) owners_[static_cast<std::size_t>(v)] = kFixed;
    for (int h = 0; h < n_handles(); ++h)
        for (const int v : vertices(h)) owners_[static_cast<std::size_t>(v)] = h;
    ++revision_;
}

}  // namespace elastolab
