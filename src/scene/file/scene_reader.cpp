#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

#include "base/text.hpp"
#include "mesh/primitives.hpp"
#include "methods/registry.hpp"
#include "scene/file/json_node.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab {

namespace {

constexpr int kLargestVertex = 2'000'000'000;
/// A cube of this resolution has six million vertices, far beyond what any method can take.
constexpr int kLargestResolution = 1000;
constexpr double kLeastTurn = 1e-6;  ///< sine of the angle between a camera's upward and viewing directions

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

void read_version(const JsonNode& root) {
    const JsonNode version = root.at("elastolab", R"(A scene file begins with "elastolab": 1.)");
    const int number = version.integer(1, 1'000'000'000);
    if (number != kSceneVersion)
        version.fail("is version " + std::to_string(number) + " of the scene format, this program reads version " +
                     std::to_string(kSceneVersion) + ". Use a newer program.");
}

Primitive read_primitive(const JsonNode& node) {
    node.require_keys({"primitive", "resolution", "size"});
    Primitive primitive;
    const JsonNode name = node.at("primitive", "Name a primitive.");
    primitive.name = name.text();
    const std::vector<std::string> known = primitive_names();
    if (std::find(known.begin(), known.end(), primitive.name) == known.end())
        name.fail(name.quoted() + " is not a known primitive. Known ones: " + listed(known) + ".");
    primitive.resolution = node.at("resolution", "Give the number of cells.").integer(1, kLargestResolution);
    if (const auto size = node.find("size"))
        for (int i = 0; i < size->array_size(); ++i) primitive.size.push_back((*size)[i].positive_number());
    return primitive;
}

MeshFile read_mesh_file(const JsonNode& node) {
    node.require_keys({"file"});
    const JsonNode file = node.at("file", "Name a mesh file.");
    if (file.text().empty()) file.fail("is empty. Name a mesh file.");
    if (file.text().find('\0') != std::string::npos) file.fail("holds a null character. Name a mesh file.");
    return {file.text()};
}

MeshSource read_mesh(const JsonNode& node) {
    node.require_keys({"file", "primitive", "resolution", "size"});
    if (node.has("file") && node.has("primitive")) node.fail("has both \"file\" and \"primitive\". Keep one of them.");
    if (!node.has("file") && !node.has("primitive"))
        node.fail("has neither \"file\" nor \"primitive\". Give one of them.");
    if (node.has("file")) return read_mesh_file(node);
    return read_primitive(node);
}

Material read_material(const JsonNode& node) {
    node.require_keys({"young_modulus", "poisson_ratio"});
    Material material;
    material.young_modulus =
        node.at("young_modulus", "Give a force per mesh unit squared, such as 1e5.").positive_number();
    const JsonNode poisson = node.at("poisson_ratio", "Give a number such as 0.3.");
    material.poisson_ratio = poisson.number();
    if (!(material.poisson_ratio > -1.0 && material.poisson_ratio <= 0.5))
        poisson.fail("must lie above -1 and not above 0.5, is " + exact(material.poisson_ratio) +
                     ". Rubber has nearly 0.5, steel 0.3, cork 0.");
    return material;
}

MethodKind read_method(const JsonNode& node) {
    if (const auto kind = parse_method_kind(node.text())) return *kind;
    std::string known;
    for (const std::string& name : method_names()) known.append(known.empty() ? "" : ", ").append(name);
    node.fail(node.quoted() + " is not a known method. Known ones: " + known + ".");
}

VertexSelector read_vertices(const JsonNode& node) {
    VertexSelector selector;
    const int n = node.array_size();
    if (n == 0) node.fail("selects nothing. Give at least one vertex number.");
    selector.vertices.reserve(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) selector.vertices.push_back(node[i].integer(0, kLargestVertex));
    return selector;
}

BoxSelector read_box(const JsonNode& node) {
    node.require_keys({"min", "max"});
    BoxSelector box{.min = node.at("min", "Give the lower corner.").vector3(),
                    .max = node.at("max", "Give the upper corner.").vector3()};
    for (int axis = 0; axis < 3; ++axis)
        if (box.min(axis) > box.max(axis))
            node.fail("min is above max along " + std::string(1, "xyz"[axis]) + " (" + exact(box.min(axis)) + " > " +
                      exact(box.max(axis)) + "). Swap them.");
    return box;
}

SphereSelector read_sphere(const JsonNode& node) {
    node.require_keys({"center", "radius"});
    return {.center = node.at("center", "Give the center.").vector3(),
            .radius = node.at("radius", "Give the radius.").positive_number()};
}

PlaneSelector read_plane(const JsonNode& node) {
    node.require_keys({"point", "normal", "tolerance"});
    PlaneSelector plane{.point = node.at("point", "Give a point of the plane.").vector3(),
                        .normal = node.at("normal", "Give the normal of the plane.").vector3(),
                        .tolerance = node.at("tolerance", "Give the largest distance from the plane.").number()};
    if (plane.normal.isZero(0.0)) node.at("normal", "").fail("is zero, so it has no direction. Give a normal.");
    if (plane.tolerance < 0.0)
        node.at("tolerance", "").fail("must not be negative, is " + exact(plane.tolerance) + ". Give a distance.");
    return plane;
}

Selector read_selector(const JsonNode& node) {
    if (node.is_array()) {
        std::vector<Selector> members;
        const int n = node.array_size();
        if (n == 0) node.fail("selects nothing. Give at least one selector.");
        members.reserve(static_cast<std::size_t>(n));
        for (int i = 0; i < n; ++i) members.push_back(read_selector(node[i]));
        return {std::move(members)};
    }
    node.require_keys({"vertices", "box", "sphere", "plane"});
    int n_shapes = 0;
    for (const char* shape : {"vertices", "box", "sphere", "plane"}) n_shapes += node.has(shape) ? 1 : 0;
    if (n_shapes != 1)
        node.fail("must have one of vertices, box, sphere, plane, has " + std::to_string(n_shapes) +
                  ". For a union write a list of selectors.");
    if (const auto vertices = node.find("vertices")) return {read_vertices(*vertices)};
    if (const auto box = node.find("box")) return {read_box(*box)};
    if (const auto sphere = node.find("sphere")) return {read_sphere(*sphere)};
    return {read_plane(node.at("plane", ""))};
}

VertexMotion read_displacements(const JsonNode& node) {
    VertexMotion motion;
    const int n = node.array_size();
    motion.displacements.reserve(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) motion.displacements.push_back(node[i].vector3());
    return motion;
}

Rotation read_rotation(const JsonNode& node) {
    node.require_keys({"axis", "degrees", "center"});
    Rotation rotation{.axis = node.at("axis", "Give the axis of the turn.").vector3(),
                      .degrees = node.at("degrees", "Give the angle of the turn.").number()};
    if (!(std::abs(rotation.degrees) <= kMostDegrees))
        node.at("degrees", "").fail("is more than a hundred turns. Give -36000 to 36000 degrees.");
    if (rotation.axis.isZero(0.0)) node.at("axis", "").fail("is zero, so it has no direction. Give an axis.");
    if (const auto center = node.find("center")) rotation.center = center->vector3();
    return rotation;
}

Handle read_handle(const JsonNode& node) {
    node.require_keys({"name", "select", "matrix", "translate", "rotate", "displacements", "force", "moment"});
    Handle handle;
    if (const auto name = node.find("name")) {
        handle.name = name->text();
        if (handle.name.empty()) name->fail("is empty. Give a name, or leave the key out.");
        if (handle.name == "fixed") name->fail("\"fixed\" is what the fixed part is called. Choose another name.");
    }
    handle.select = read_selector(node.at("select", "Say which vertices the handle moves."));
    if (node.has("force") || node.has("moment")) {
        if (node.has("matrix") || node.has("translate") || node.has("rotate") || node.has("displacements"))
            node.fail("has both a force and a motion. Keep one of them.");
        GripForce grip;
        if (const auto force = node.find("force")) grip.force = force->vector3();
        if (const auto moment = node.find("moment")) grip.moment = moment->vector3();
        handle.force = grip;
        return handle;
    }
    const auto displacements = node.find("displacements");
    if (displacements && (node.has("matrix") || node.has("translate") || node.has("rotate")))
        node.fail("has both displacements and matrix, translate or rotate. Keep one kind of motion.");
    if (displacements) {
        handle.motion = read_displacements(*displacements);
        return handle;
    }
    AffineMotion motion;
    if (const auto matrix = node.find("matrix")) motion.matrix = matrix->matrix3();
    if (const auto translate = node.find("translate")) motion.translate = translate->vector3();
    if (const auto rotate = node.find("rotate")) motion.rotate = read_rotation(*rotate);
    handle.motion = motion;
    return handle;
}

/// Requires that the last of `all`, read from `node`, has no earlier one's name. `kind`: what they are called.
template <class Named>
void require_new_name(const JsonNode& node, const std::vector<Named>& all, const std::string& kind) {
    const auto last = std::prev(all.end());
    const auto first = std::find_if(all.begin(), last, [&](const Named& other) { return other.name == last->name; });
    if (last->name.empty() || first == last) return;
    const JsonNode name = node.at("name", "");
    name.fail(name.quoted() + " is the name of " + kind + " " + std::to_string(first - all.begin()) +
              " already. Choose another name.");
}

FixedSet read_fixed_set(const JsonNode& node) {
    node.require_keys({"name", "select"});
    FixedSet set;
    if (const auto name = node.find("name")) {
        set.name = name->text();
        if (set.name.empty()) name->fail("is empty. Give a name, or leave the key out.");
    }
    set.select = read_selector(node.at("select", "Say which vertices are fixed."));
    return set;
}

/// A selector (or a list of them), or a list of sets, each with a "select" of its own.
std::vector<FixedSet> read_fixed(const JsonNode& node) {
    const auto is_set = [](const JsonNode& member) {
        return member.is_object() && (member.has("select") || member.has("name"));
    };
    std::vector<FixedSet> sets;
    if (!node.is_array() || node.array_size() == 0 || !is_set(node[0])) {
        sets.push_back({.select = read_selector(node)});
        return sets;
    }
    for (int i = 0; i < node.array_size(); ++i) {
        sets.push_back(read_fixed_set(node[i]));
        require_new_name(node[i], sets, "fixed set");
    }
    return sets;
}

ProxyChoice read_proxy(const JsonNode& node) {
    node.require_keys({"use", "vertices", "as"});
    ProxyChoice proxy;
    if (const auto use = node.find("use")) {
        const auto known = parse_proxy_use(use->text());
        if (!known) use->fail(use->quoted() + " is none of never, auto, always, fill. Choose one of these.");
        proxy.use = *known;
    }
    if (const auto as = node.find("as")) {
        const auto known = parse_open_surface(as->text());
        if (!known) as->fail(as->quoted() + " is none of auto, solid, sheet. Choose one of these.");
        proxy.taken_for = *known;
    }
    if (const auto vertices = node.find("vertices"))
        proxy.n_vertices = vertices->integer(kFewestProxyVertices, kMostProxyVertices);
    return proxy;
}

ViewPoint read_camera(const JsonNode& node) {
    node.require_keys({"eye", "target", "up", "vertical"});
    ViewPoint view{.eye = node.at("eye", "Say where the eye is.").vector3(),
                   .target = node.at("target", "Give the point that is looked at.").vector3()};
    if (const auto up = node.find("up")) view.up = up->vector3();
    if (const auto vertical = node.find("vertical")) view.vertical = vertical->vector3();
    const Eigen::Vector3d direction = (view.target - view.eye).stableNormalized();
    if (!(direction.norm() > 0.5)) node.fail("eye and target are the same point. Move one of them.");
    if (view.vertical.isZero(0.0)) node.at("vertical", "").fail("is zero, so it has no direction. Give an axis.");
    if (!(direction.cross(view.up.stableNormalized()).norm() > kLeastTurn))
        node.fail("up is along the viewing direction, or zero. Give another direction.");
    return view;
}

Field read_field(const JsonNode& node) {
    const std::optional<Field> known = parse_field(node.text());
    if (!known) node.fail(node.quoted() + " is not a known field. Known ones: " + listed(field_names()) + ".");
    return *known;
}

std::pair<double, double> read_range(const JsonNode& node) {
    node.array_size(2);
    return {node[0].number(), node[1].number()};
}

Cut read_cut(const JsonNode& node) {
    node.require_keys({"axis", "place", "turn", "tilt", "flip"});
    const JsonNode axis = node.at("axis", "Give x, y or z.");
    const std::size_t known = std::string_view("xyz").find(axis.text());
    if (known == std::string_view::npos || axis.text().size() != 1)
        axis.fail(axis.quoted() + " is none of x, y, z. Choose one of these.");
    Cut cut{.axis = static_cast<int>(known)};
    if (const auto place = node.find("place")) {
        cut.place = place->number();
        if (!(cut.place >= 0.0 && cut.place <= 1.0)) place->fail("is not between 0 and 1. Give a part of the body.");
    }
    if (const auto turn = node.find("turn")) cut.turn = turn->number();
    if (const auto tilt = node.find("tilt")) cut.tilt = tilt->number();
    if (const auto flip = node.find("flip")) cut.flip = flip->boolean();
    return cut;
}

Shown read_shown(const JsonNode& node) {
    node.require_keys({"field", "range", "cut"});
    Shown shown;
    if (const auto field = node.find("field")) shown.field = read_field(*field);
    if (const auto range = node.find("range")) shown.range = read_range(*range);
    if (const auto cut = node.find("cut")) shown.cut = read_cut(*cut);
    return shown;
}

std::vector<Handle> read_handles(const JsonNode& node) {
    std::vector<Handle> handles;
    const int n = node.array_size();
    for (int i = 0; i < n; ++i) {
        handles.push_back(read_handle(node[i]));
        require_new_name(node[i], handles, "handle");
    }
    return handles;
}

Load read_load(const JsonNode& node) {
    node.require_keys({"name", "select", "force", "traction", "pressure"});
    Load load;
    if (const auto name = node.find("name")) {
        load.name = name->text();
        if (load.name.empty()) name->fail("is empty. Give a name, or leave the key out.");
    }
    load.select = read_selector(node.at("select", "Say where the load acts."));
    int n_kinds = 0;
    for (const char* kind : {"force", "traction", "pressure"}) n_kinds += node.has(kind) ? 1 : 0;
    if (n_kinds != 1)
        node.fail("must have one of force, traction, pressure, has " + std::to_string(n_kinds) +
                  ". Give one of them, or write several loads.");
    if (const auto force = node.find("force")) load.value = ForceLoad{force->vector3()};
    if (const auto traction = node.find("traction")) load.value = TractionLoad{traction->vector3()};
    if (const auto pressure = node.find("pressure")) load.value = PressureLoad{pressure->number()};
    return load;
}

std::vector<Load> read_loads(const JsonNode& node) {
    std::vector<Load> loads;
    const int n = node.array_size();
    for (int i = 0; i < n; ++i) {
        loads.push_back(read_load(node[i]));
        require_new_name(node[i], loads, "load");
    }
    return loads;
}

}  // namespace

Document parse_scene(std::string_view text, const std::string& name) {
    const JsonTree json = parse_json(text, name);
    const JsonNode root(json.value, "", name);
    root.require_keys({"elastolab", "mesh", "material", "method", "fixed", "handles", "gravity", "density", "loads",
                       "proxy", "camera", "shown"});
    read_version(root);
    Document document;
    document.mesh = read_mesh(root.at("mesh", "Give a mesh file or a primitive."));
    if (const auto material = root.find("material")) document.material = read_material(*material);
    if (const auto method = root.find("method")) document.method = read_method(*method);
    if (const auto fixed = root.find("fixed")) document.fixed = read_fixed(*fixed);
    if (const auto handles = root.find("handles")) document.handles = read_handles(*handles);
    if (const auto gravity = root.find("gravity")) document.gravity = gravity->vector3();
    if (const auto density = root.find("density")) document.density = density->positive_number();
    if (const auto loads = root.find("loads")) document.loads = read_loads(*loads);
    if (const auto proxy = root.find("proxy")) document.proxy = read_proxy(*proxy);
    if (const auto camera = root.find("camera")) document.camera = read_camera(*camera);
    if (const auto shown = root.find("shown")) document.shown = read_shown(*shown);
    return document;
}

}  // namespace elastolab
