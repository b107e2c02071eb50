#include "cli/csv.hpp"

#include "base/text.hpp"

namespace elastolab {

namespace {

void write_vector(std::ostream& out, const Eigen::Vector3d& vector) {
    for (const double value : vector) out << ',' << exact(value);
}

std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

void write_displacements(std::ostream& out, const SurfaceMesh& mesh, const Eigen::Matrix3Xd& displacement) {
    out << "vertex,x,y,z,ux,uy,uz\n";
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        out << v;
        write_vector(out, mesh.vertices.col(v));
        write_vector(out, displacement.col(v));
        out << '\n';
    }
}

void write_forces(std::ostream& out, const std::vector<GroupReaction>& reactions) {
    out << "name,fx,fy,fz,mx,my,mz\n";
    for (const GroupReaction& reaction : reactions) {
        out << field(reaction.name);
        write_vector(out, reaction.force);
        write_vector(out, reaction.moment);
        out << '\n';
    }
}

}  // namespace elastolab
