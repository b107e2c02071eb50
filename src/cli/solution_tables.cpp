#include "cli/solution_tables.hpp"

#include "base/csv.hpp"

namespace elastolab {

void write_displacements(std::ostream& out, const SurfaceMesh& mesh, const Eigen::Matrix3Xd& displacement) {
    out << "vertex,x,y,z,ux,uy,uz\n";
    CsvWriter table(out);
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        table.number(v).numbers(mesh.vertices.col(v)).numbers(displacement.col(v));
        table.end_row();
    }
}

void write_forces(std::ostream& out, const std::vector<GroupReaction>& reactions) {
    out << "name,fx,fy,fz,mx,my,mz\n";
    CsvWriter table(out);
    for (const GroupReaction& reaction : reactions) {
        table.text(reaction.name).numbers(reaction.force).numbers(reaction.moment);
        table.end_row();
    }
}

}  // namespace elastolab
