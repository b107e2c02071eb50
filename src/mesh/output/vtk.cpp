#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <iomanip>
#include <ostream>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/output/field_files.hpp"

namespace elastolab {

static_assert(std::endian::native == std::endian::little, "the files say that they are little endian");

namespace {

constexpr std::uint8_t kVtkTetra = 10, kVtkQuadraticTetra = 24;  ///< cell types of VTK
/// Our node for each of VTK's: it counts the edges of the base round, 01 12 20, then those to the top.
constexpr std::array kVtkTenNodes = {0, 1, 2, 3, 4, 7, 5, 6, 8, 9};

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

/// Text as an attribute or between tags.
std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += c;
    }
    return result;
}

/// As attributes: what ParaView calls the components.
std::string component_names(int n_components) {
    static constexpr std::array kVector = {"X", "Y", "Z"};
    static constexpr std::array kTensor = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    std::string names;
    for (int i = 0; i < n_components && (n_components == 3 || n_components == 6); ++i) {
        const auto at = static_cast<std::size_t>(i);
        names += " ComponentName" + std::to_string(i) + "=\"" + (n_components == 3 ? kVector[at] : kTensor[at]) + "\"";
    }
    return names;
}

/// One array: the number of its bytes, then these, in one piece of base64.
void write_array(std::ostream& out, const char* type, const std::string& name, int n_components, const void* data,
                 std::size_t size) {
    out << "        <DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << n_components
        << "\"" << component_names(n_components) << " format=\"binary\">";
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

/// The first field of each kind is the one that ParaView shows, warps by, or takes for the tensor.
std::string active_fields(std::span<const MeshField> fields, VtkPoints points) {
    std::string active;
    for (const auto& [rows, kind] :
         {std::pair<Eigen::Index, const char*>{1, "Scalars"}, {3, "Vectors"}, {6, "Tensors"}}) {
        if (rows == 3 && points == VtkPoints::moved) continue;
        const auto first =
            std::find_if(fields.begin(), fields.end(), [n = rows](const MeshField& f) { return f.values.rows() == n; });
        if (first != fields.end()) active += std::string(" ") + kind + "=\"" + first->name + "\"";
    }
    return active;
}

void write_fields(std::ostream& out, const char* place, std::span<const MeshField> fields, VtkPoints points) {
    out << "      <" << place << active_fields(fields, points) << ">\n";
    for (const MeshField& field : fields) write_doubles(out, field.name, field.values);
    out << "      </" << place << ">\n";
}

/// Text in VTK is the numbers of its bytes, ended by a zero.
void write_fact(std::ostream& out, const std::string& name, const std::string& text) {
    out << "      <DataArray type=\"String\" Name=\"" << name << "\" NumberOfTuples=\"1\" format=\"ascii\">";
    for (const char c : text) out << static_cast<int>(static_cast<unsigned char>(c)) << ' ';
    out << "0</DataArray>\n";
}

void write_fact(std::ostream& out, const std::string& name, double number) {
    out << "      <DataArray type=\"Float64\" Name=\"" << name << "\" NumberOfTuples=\"1\" format=\"ascii\">"
        << std::setprecision(17) << number << "</DataArray>\n";
}

void write_units(std::ostream& out, std::span<const MeshField> fields, std::set<std::string>& written) {
    for (const MeshField& field : fields)
        if (!field.unit.empty() && written.insert(field.name).second)
            write_fact(out, "unit_of_" + field.name, field.unit);
}

void write_field_data(std::ostream& out, const FileFacts& facts, std::span<const MeshField> at_vertices,
                      std::span<const MeshField> in_cells) {
    out << "    <FieldData>\n";
    for (const FileFact& fact : facts)
        std::visit([&](const auto& value) { write_fact(out, fact.name, value); }, fact.value);
    std::set<std::string> written;
    write_units(out, at_vertices, written);
    write_units(out, in_cells, written);
    out << "    </FieldData>\n";
}

void begin_file(std::ostream& out, const char* type) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
        << "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <" << type << ">\n";
}

void end_file(std::ostream& out, const char* type) { out << "    </Piece>\n  </" << type << ">\n</VTKFile>\n"; }

void write_points(std::ostream& out, const Positions& vertices) {
    out << "      <Points>\n";
    write_doubles(out, "Points", vertices);
    out << "      </Points>\n";
}

/// The vertices of all cells in a row, and where each cell ends in it. order: the row of `cells` for each place.
void write_connectivity(std::ostream& out, const Eigen::Ref<const Eigen::MatrixXi>& cells, std::span<const int> order) {
    std::vector<std::int64_t> vertices, ends;
    vertices.reserve(static_cast<std::size_t>(cells.size()));
    ends.reserve(static_cast<std::size_t>(cells.cols()));
    for (Eigen::Index c = 0; c < cells.cols(); ++c) {
        for (const int row : order) vertices.push_back(cells(row, c));
        ends.push_back(static_cast<std::int64_t>(vertices.size()));
    }
    write_list(out, "Int64", "connectivity", vertices);
    write_list(out, "Int64", "offsets", ends);
}

}  // namespace

void write_vtp(std::ostream& out, const SurfaceMesh& mesh, std::span<const MeshField> at_vertices,
               const FileFacts& facts, VtkPoints points) {
    begin_file(out, "PolyData");
    write_field_data(out, facts, at_vertices, {});
    out << "    <Piece NumberOfPoints=\"" << mesh.n_vertices()
        << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" << mesh.n_triangles()
        << "\">\n";
    write_fields(out, "PointData", at_vertices, points);
    write_points(out, mesh.vertices);
    out << "      <Polys>\n";
    write_connectivity(out, mesh.triangles, std::array{0, 1, 2});
    out << "      </Polys>\n";
    end_file(out, "PolyData");
}

void write_vtu(std::ostream& out, const Positions& vertices, const Eigen::MatrixXi& cells,
               std::span<const MeshField> at_vertices, std::span<const MeshField> in_cells, const FileFacts& facts,
               VtkPoints points) {
    assert(cells.rows() == 4 || cells.rows() == 10);
    begin_file(out, "UnstructuredGrid");
    write_field_data(out, facts, at_vertices, in_cells);
    out << "    <Piece NumberOfPoints=\"" << vertices.cols() << "\" NumberOfCells=\"" << cells.cols() << "\">\n";
    write_fields(out, "PointData", at_vertices, points);
    write_fields(out, "CellData", in_cells, points);
    write_points(out, vertices);
    out << "      <Cells>\n";
    write_connectivity(out, cells, std::span(kVtkTenNodes).first(static_cast<std::size_t>(cells.rows())));
    write_list(out, "UInt8", "types",
               std::vector<std::uint8_t>(static_cast<std::size_t>(cells.cols()),
                                         cells.rows() == 10 ? kVtkQuadraticTetra : kVtkTetra));
    out << "      </Cells>\n";
    end_file(out, "UnstructuredGrid");
}

void write_pvd(std::ostream& out, std::span<const SeriesStep> steps) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        << "  <Collection>\n"
        << std::setprecision(17);
    for (const SeriesStep& step : steps)
        out << "    <DataSet timestep=\"" << step.time << "\" part=\"0\" file=\"" << escaped(step.file) << "\"/>\n";
    out << "  </Collection>\n</VTKFile>\n";
}

}  // namespace elastolab
