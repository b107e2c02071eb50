#include <array>
#include <bit>
#include <cstdint>
#include <ostream>

#include "base/csv.hpp"
#include "mesh/output/field_files.hpp"

namespace elastolab {

namespace {

template <class T>
void put_bytes(std::ostream& out, T value) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    out.write(bytes.data(), bytes.size());
}

template <class Each>
void for_components(std::span<const MeshField> fields, const Each& each) {
    for (const MeshField& field : fields)
        for (int component = 0; component < field.values.rows(); ++component) each(field, component);
}

}  // namespace

void write_ply(std::ostream& out, const SurfaceMesh& mesh, std::span<const MeshField> at_vertices) {
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.n_vertices()
        << "\nproperty double x\nproperty double y\nproperty double z\n";
    for_components(at_vertices, [&](const MeshField& field, int component) {
        out << "property double " << component_name(field, component) << '\n';
    });
    out << "element face " << mesh.n_triangles() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        for (const double x : mesh.vertices.col(v)) put_bytes(out, x);
        for_components(at_vertices,
                       [&](const MeshField& field, int component) { put_bytes(out, field.values(component, v)); });
    }
    for (const auto& triangle : mesh.triangles.colwise()) {
        put_bytes(out, std::uint8_t{3});
        for (const int v : triangle) put_bytes(out, static_cast<std::int32_t>(v));
    }
}

void write_field_csv(std::ostream& out, const Positions& vertices, std::span<const MeshField> at_vertices) {
    CsvWriter table(out);
    for (const char* name : {"vertex", "x", "y", "z"}) table.text(name);
    for_components(at_vertices,
                   [&](const MeshField& field, int component) { table.text(component_name(field, component)); });
    table.end_row();
    for (Eigen::Index v = 0; v < vertices.cols(); ++v) {
        table.number(v).numbers(vertices.col(v));
        for_components(at_vertices,
                       [&](const MeshField& field, int component) { table.number(field.values(component, v)); });
        table.end_row();
    }
}

}  // namespace elastolab
