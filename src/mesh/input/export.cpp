#include "mesh/input/export.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "the binary formats are written in the machine's byte order");

namespace {

template <class T>
void put(std::ostream& out, T value) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    out.write(bytes.data(), bytes.size());
}

void write_obj(std::ostream& out, const SurfaceMesh& mesh) {
    for (const auto& p : mesh.vertices.colwise())
        out << "v " << exact(p.x()) << ' ' << exact(p.y()) << ' ' << exact(p.z()) << '\n';
    for (const auto& t : mesh.triangles.colwise())
        out << "f " << t.x() + 1 << ' ' << t.y() + 1 << ' ' << t.z() + 1 << '\n';
}

void write_ply(std::ostream& out, const SurfaceMesh& mesh) {
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.n_vertices()
        << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << mesh.n_triangles()
        << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const double x : mesh.vertices.reshaped()) put(out, x);
    for (const auto& t : mesh.triangles.colwise()) {
        put(out, std::uint8_t{3});
        for (const int v : t) put(out, static_cast<std::int32_t>(v));
    }
}

void write_stl(std::ostream& out, const SurfaceMesh& mesh) {
    if (mesh.n_vertices() > 0 && mesh.vertices.cwiseAbs().maxCoeff() > std::numeric_limits<float>::max())
        throw MeshError(
            "STL stores coordinates in single precision, up to 3.4e38, and these are larger. Choose .obj or "
            ".ply.");
    std::string header = "binary STL";  // must not begin with "solid", as text files do
    header.resize(80);
    out << header;
    put(out, static_cast<std::uint32_t>(mesh.n_triangles()));
    const auto put_vector = [&](const Eigen::Vector3d& p) {
        for (const double x : p) put(out, static_cast<float>(x));
    };
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(mesh, t);
        put_vector(area_vector(p).stableNormalized());
        put_vector(p.a);
        put_vector(p.b);
        put_vector(p.c);
        put(out, std::uint16_t{0});
    }
}

using Writer = void (*)(std::ostream&, const SurfaceMesh&);

Writer writer_for(const fs::path& file) {
    const std::string extension = lower_case(file.extension().string());
    if (extension == ".obj") return write_obj;
    if (extension == ".ply") return write_ply;
    if (extension == ".stl") return write_stl;
    throw MeshError(one_line(file.string()) +
                    ": meshes are written as .obj, .ply or .stl. Choose one of these extensions.");
}

}  // namespace

void write_surface(std::ostream& out, const SurfaceMesh& mesh, const fs::path& name) { writer_for(name)(out, mesh); }

void save_surface(const fs::path& file, const SurfaceMesh& mesh) {
    const Writer write = writer_for(file);
    AtomicFile output(file);
    write(output.stream(), mesh);
    output.commit();
}

}  // namespace elastolab
