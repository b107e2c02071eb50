#include <array>
#include <bit>
#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "mesh/output/field_files.hpp"

namespace elastolab {

static_assert(std::endian::native == std::endian::little, "the files say that they are little endian");

namespace {

constexpr std::uint8_t kVtkTetra = 10;  ///< cell type of VTK

/// Bytes as text: three of them make four letters.
class Base64 {
public:
    explicit Base64(std::ostream& out) : out_(out) {}
    void put(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) {
            group_[n_++] = bytes[i];
            if (n_ == 3) write();
        }
    }
    void end() {
        if (n_ > 0) write();
        out_ << text_;
        text_.clear();
    }

private:
    void write() {
        static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (std::size_t i = n_; i < 3; ++i) group_[i] = 0;
        const unsigned bits = (unsigned{group_[0]} << 16) | (unsigned{group_[1]} << 8) | group_[2];
        for (std::size_t i = 0; i < 4; ++i) text_ += i <= n_ ? kLetters[(bits >> (18 - 6 * i)) & 63u] : '=';
        n_ = 0;
        if (text_.size() < kBuffer) return;
        out_ << text_;
        text_.clear();
    }
    static constexpr std::size_t kBuffer = 1 << 16;
    std::ostream& out_;
    std::array<unsigned char, 3> group_{};
    std::size_t n_ = 0;
    std::string text_;
};

/// One array: the number of its bytes, then these, in one piece of base64.
void write_array(std::ostream& out, const char* type, const std::string& name, int n_components, const void* data,
                 std::size_t size) {
    out << "        <DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << n_components
        << "\" format=\"binary\">";
    Base64 text(out);
    const std::uint64_t n_bytes = size;
    text.put(&n_bytes, sizeof n_bytes);
    text.put(data, size);
    text.end();
    out << "</DataArray>\n";
}

void write_doubles(std::ostream& out, const std::string& name, const Eigen::MatrixXd& values) {
    write_array(out, "Float64", name, static_cast<int>(values.rows()), values.data(),
                sizeof(double) * static_cast<std::size_t>(values.size()));
}

template <class T>
void write_list(std::ostream& out, const char* type, const std::string& name, const std::vector<T>& values) {
    write_array(out, type, name, 1, values.data(), sizeof(T) * values.size());
}

/// The first field of each kind is the one that ParaView shows first.
void write_fields(std::ostream& out, const char* place, std::span<const MeshField> fields) {
    std::string active;
    for (const auto& [rows, kind] : {std::pair<Eigen::Index, const char*>{1, "Scalars"}, {3, "Vectors"}})
        for (const MeshField& field : fields)
            if (field.values.rows() == rows) {
                active += std::string(" ") + kind + "=\"" + field.name + "\"";
                break;
            }
    out << "      <" << place << active << ">\n";
    for (const MeshField& field : fields) write_doubles(out, field.name, field.values);
    out << "      </" << place << ">\n";
}

void begin_file(std::ostream& out, const char* type, const std::string& counts) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
        << "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <" << type << ">\n    <Piece"
        << counts << ">\n";
}

void end_file(std::ostream& out, const char* type) { out << "    </Piece>\n  </" << type << ">\n</VTKFile>\n"; }

void write_points(std::ostream& out, const Positions& vertices) {
    out << "      <Points>\n";
    write_doubles(out, "Points", vertices);
    out << "      </Points>\n";
}

/// The vertices of all cells in a row, and where each cell ends in it.
template <class Cells>
void write_connectivity(std::ostream& out, const Cells& cells) {
    std::vector<std::int64_t> vertices(static_cast<std::size_t>(cells.size()));
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = cells.data()[i];
    std::vector<std::int64_t> ends(static_cast<std::size_t>(cells.cols()));
    for (std::size_t i = 0; i < ends.size(); ++i)
        ends[i] = static_cast<std::int64_t>(i + 1) * static_cast<std::int64_t>(cells.rows());
    write_list(out, "Int64", "connectivity", vertices);
    write_list(out, "Int64", "offsets", ends);
}

}  // namespace

void write_vtp(std::ostream& out, const SurfaceMesh& mesh, std::span<const MeshField> at_vertices) {
    begin_file(out, "PolyData",
               " NumberOfPoints=\"" + std::to_string(mesh.n_vertices()) +
                   "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
                   std::to_string(mesh.n_triangles()) + "\"");
    write_fields(out, "PointData", at_vertices);
    write_points(out, mesh.vertices);
    out << "      <Polys>\n";
    write_connectivity(out, mesh.triangles);
    out << "      </Polys>\n";
    end_file(out, "PolyData");
}

void write_vtu(std::ostream& out, const TetMesh& mesh, std::span<const MeshField> at_vertices,
               std::span<const MeshField> in_cells) {
    begin_file(out, "UnstructuredGrid",
               " NumberOfPoints=\"" + std::to_string(mesh.n_vertices()) + "\" NumberOfCells=\"" +
                   std::to_string(mesh.n_tetrahedra()) + "\"");
    write_fields(out, "PointData", at_vertices);
    write_fields(out, "CellData", in_cells);
    write_points(out, mesh.vertices);
    out << "      <Cells>\n";
    write_connectivity(out, mesh.tetrahedra);
    write_list(out, "UInt8", "types",
               std::vector<std::uint8_t>(static_cast<std::size_t>(mesh.n_tetrahedra()), kVtkTetra));
    out << "      </Cells>\n";
    end_file(out, "UnstructuredGrid");
}

}  // namespace elastolab
