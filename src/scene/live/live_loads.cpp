// The loads of a LiveScene.
#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/selectors.hpp"

namespace elastolab {

const AppliedLoad* LiveScene::applied_load(int load) const {
    const auto& all = constraints_.loads;
    const auto found = std::find_if(all.begin(), all.end(), [&](const AppliedLoad& a) { return a.number == load; });
    return found != all.end() ? &*found : nullptr;
}

std::vector<int> LiveScene::loaded_vertices(int load) const {
    return select_vertices(*surface_, document_.loads[static_cast<std::size_t>(load)].select, file_.string());
}

bool LiveScene::load_is_named(const std::string& name) const {
    return std::any_of(document_.loads.begin(), document_.loads.end(),
                       [&](const Load& load) { return load.name == name; });
}

std::string LiveScene::unused_load_name() const {
    std::size_t n = 0;
    while (load_is_named(default_load_name(n))) ++n;
    return default_load_name(n);
}

/// Takes over a document whose load was edited, unless that load would have no effect.
bool LiveScene::try_loads(Document document, int load) {
    try {
        const Constraints made = make_constraints(document, *surface_, file_, ConstrainedTriangles::left_out);
        if (std::none_of(made.loads.begin(), made.loads.end(), [&](const auto& a) { return a.number == load; }))
            return false;
    } catch (const SceneError&) {  // its vertices have no triangle
        return false;
    }
    become(std::move(document));
    return true;
}

int LiveScene::add_load(std::span<const int> vertices, const LoadValue& value) {
    if (vertices.empty() || !load_factors(value).allFinite()) return kNobody;
    std::vector<int> sorted(vertices.begin(), vertices.end());
    std::sort(sorted.begin(), sorted.end());
    Document changed = document_;
    changed.loads.push_back(
        {.name = unused_load_name(), .select = {VertexSelector{std::move(sorted)}}, .value = value});
    return try_loads(std::move(changed), n_loads()) ? n_loads() - 1 : kNobody;
}

bool LiveScene::set_loaded_vertices(int load, std::span<const int> vertices) {
    if (vertices.empty()) return false;
    std::vector<int> sorted(vertices.begin(), vertices.end());
    std::sort(sorted.begin(), sorted.end());
    Document changed = document_;
    changed.loads[static_cast<std::size_t>(load)].select = {VertexSelector{std::move(sorted)}};
    return try_loads(std::move(changed), load);
}

void LiveScene::remove_load(int load) {
    Document changed = document_;
    changed.loads.erase(changed.loads.begin() + load);
    become(std::move(changed));
}

void LiveScene::clear_loads() {
    Document changed = document_;
    changed.loads.clear();
    changed.gravity.reset();
    become(std::move(changed));
}

bool LiveScene::rename_load(int load, const std::string& name) {
    if (name.empty() || name == "gravity" || load_is_named(name)) return false;
    Document changed = document_;
    changed.loads[static_cast<std::size_t>(load)].name = name;
    become(std::move(changed));
    return true;
}

void LiveScene::set_load(int load, const LoadValue& value) {
    LoadValue& present = document_.loads[static_cast<std::size_t>(load)].value;
    const Eigen::VectorXd factors = load_factors(value);
    if (!factors.allFinite()) return;
    if (present.index() != value.index()) {
        Document changed = document_;
        changed.loads[static_cast<std::size_t>(load)].value = value;
        return become(std::move(changed));
    }
    present = value;
    take_factors(load, factors);
}

void LiveScene::set_gravity(const std::optional<Eigen::Vector3d>& gravity, double density) {
    if (!(density > 0.0) || !(density * gravity.value_or(Eigen::Vector3d::Zero())).allFinite()) return;
    if (gravity.has_value() != document_.gravity.has_value()) {
        Document changed = document_;
        changed.gravity = gravity;
        changed.density = density;
        return become(std::move(changed));
    }
    document_.gravity = gravity;
    if (gravity) *document_.gravity += Eigen::Vector3d::Zero();  // -0 becomes 0
    document_.density = density;
    if (gravity) return take_factors(kGravity, density * *gravity);
    ++revision_;
}

/// Only values change: no set has to be prepared.
void LiveScene::take_factors(int load, const Eigen::VectorXd& factors) {
    if (const AppliedLoad* applied = applied_load(load)) {
        const Eigen::Index first = constraints_.values.size() - std::ssize(constraints_.set.loads) + applied->first;
        constraints_.values.segment(first, applied->count) = factors;
    }
    ++revision_;
}

}  // namespace elastolab
