#include "base/error.hpp"
#include "base/overloaded.hpp"
#include "scene/file/json_text.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab {

namespace {

Json to_json(const Eigen::Vector3d& vector) { return Json::array({vector.x(), vector.y(), vector.z()}); }

Json to_json(const Eigen::Matrix3d& matrix) {
    Json rows = Json::array();
    for (int row = 0; row < 3; ++row) rows.push_back(to_json(Eigen::Vector3d(matrix.row(row))));
    return rows;
}

Json to_json(const MeshSource& source) {
    const auto file = [](const MeshFile& mesh) { return Json{{"file", mesh.file}}; };
    const auto primitive = [](const Primitive& mesh) {
        Json json{{"primitive", mesh.name}, {"resolution", mesh.resolution}};
        if (!mesh.size.empty()) json["size"] = mesh.size;
        return json;
    };
    return std::visit(Overloaded{file, primitive}, source);
}

Json to_json(const Selector& selector) {
    const auto union_of = [](const std::vector<Selector>& members) {
        Json list = Json::array();
        for (const Selector& member : members) list.push_back(to_json(member));
        return list;
    };
    return std::visit(
        Overloaded{
            [](const VertexSelector& s) {
                return Json{{"vertices", s.vertices}};
            },
            [](const BoxSelector& s) {
                return Json{{"box", {{"min", to_json(s.min)}, {"max", to_json(s.max)}}}};
            },
            [](const SphereSelector& s) {
                return Json{{"sphere", {{"center", to_json(s.center)}, {"radius", s.radius}}}};
            },
            [](const PlaneSelector& s) {
                return Json{{"plane",
                             {{"point", to_json(s.point)}, {"normal", to_json(s.normal)}, {"tolerance", s.tolerance}}}};
            },
            union_of,
        },
        selector.shape);
}

Json to_json(const Rotation& rotation) {
    return {{"axis", to_json(rotation.axis)}, {"degrees", rotation.degrees}, {"center", to_json(rotation.center)}};
}

Json to_json(const Handle& handle) {
    Json json = Json::object();
    if (!handle.name.empty()) json["name"] = handle.name;
    json["select"] = to_json(handle.select);
    if (handle.force) {
        json["force"] = to_json(handle.force->force);
        if (!handle.force->moment.isZero(0.0)) json["moment"] = to_json(handle.force->moment);
        return json;
    }
    const auto affine = [&](const AffineMotion& motion) {
        if (!motion.matrix.isZero(0.0)) json["matrix"] = to_json(motion.matrix);
        json["translate"] = to_json(motion.translate);
        if (motion.rotate != Rotation{}) json["rotate"] = to_json(motion.rotate);
    };
    const auto per_vertex = [&](const VertexMotion& motion) {
        json["displacements"] = Json::array();
        for (const Eigen::Vector3d& u : motion.displacements) json["displacements"].push_back(to_json(u));
    };
    std::visit(Overloaded{affine, per_vertex}, handle.motion);
    return json;
}

Json to_json(const Load& load) {
    Json json = Json::object();
    if (!load.name.empty()) json["name"] = load.name;
    json["select"] = to_json(load.select);
    std::visit(Overloaded{[&](const ForceLoad& value) { json["force"] = to_json(value.force); },
                          [&](const TractionLoad& value) { json["traction"] = to_json(value.traction); },
                          [&](const PressureLoad& value) { json["pressure"] = value.pressure; }},
               load.value);
    return json;
}

Json to_json(const std::vector<FixedSet>& sets) {
    if (is_plain(sets)) return to_json(sets.front().select);
    Json list = Json::array();
    for (const FixedSet& set : sets) {
        Json json = Json::object();
        if (!set.name.empty()) json["name"] = set.name;
        json["select"] = to_json(set.select);
        list.push_back(std::move(json));
    }
    return list;
}

Json to_json(const ProxyChoice& proxy) {
    Json json{{"use", std::string(name(proxy.use))}, {"vertices", proxy.n_vertices}};
    if (proxy.taken_for != OpenSurface::automatic) json["as"] = std::string(name(proxy.taken_for));
    return json;
}

Json to_json(const ViewPoint& view) {
    return {{"eye", to_json(view.eye)},
            {"target", to_json(view.target)},
            {"up", to_json(view.up)},
            {"vertical", to_json(view.vertical)}};
}

Json to_json(const Cut& cut) {
    Json json{{"axis", std::string(1, "xyz"[cut.axis])}, {"place", cut.place}};
    if (cut.turn != 0.0) json["turn"] = cut.turn;
    if (cut.tilt != 0.0) json["tilt"] = cut.tilt;
    if (cut.flip) json["flip"] = true;
    return json;
}

Json to_json(const Shown& shown) {
    Json json{{"field", name(shown.field)}};
    if (shown.range) json["range"] = Json::array({shown.range->first, shown.range->second});
    if (shown.cut) json["cut"] = to_json(*shown.cut);
    return json;
}

Json to_json(const Document& document) {
    Json json{
        {"elastolab", kSceneVersion},
        {"mesh", to_json(document.mesh)},
        {"material",
         {{"young_modulus", document.material.young_modulus}, {"poisson_ratio", document.material.poisson_ratio}}},
        {"method", std::string(name(document.method))}};
    if (!document.fixed.empty()) json["fixed"] = to_json(document.fixed);
    json["handles"] = Json::array();
    for (const Handle& handle : document.handles) json["handles"].push_back(to_json(handle));
    if (document.gravity) json["gravity"] = to_json(*document.gravity);
    if (document.density != 1.0) json["density"] = document.density;
    if (!document.loads.empty()) {
        json["loads"] = Json::array();
        for (const Load& load : document.loads) json["loads"].push_back(to_json(load));
    }
    if (document.proxy != ProxyChoice{}) json["proxy"] = to_json(document.proxy);
    if (document.camera) json["camera"] = to_json(*document.camera);
    if (document.shown) json["shown"] = to_json(*document.shown);
    return json;
}

}  // namespace

std::string print_scene(const Document& document) {
    try {
        return print_json(to_json(document));
    } catch (const Json::type_error&) {
        throw SceneError("The scene has a name that is not valid UTF-8, which JSON cannot hold. Rename it.");
    }
}

}  // namespace elastolab
