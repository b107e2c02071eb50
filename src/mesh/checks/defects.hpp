#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/checks/check.hpp"
#include "mesh/surface_mesh.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

/// Collects the places of one kind of defect and words the finding.
class DefectCount {
public:
    void add(const Eigen::Vector3d& place);
    int count() const { return defect_.count; }
    /// "12 open edges near (0, 1, 0)" from "open edge" and "open edges", then `rest`.
    Defect build(Defect::Kind kind, const std::string& one, const std::string& many, const std::string& rest) const;
    /// build, and into the report, if there is any.
    void report_fatal(MeshReport& report, Defect::Kind kind, const std::string& one, const std::string& many,
                      const std::string& rest) const;

private:
    Defect defect_{};
};

/// "1 open edge near (0, 1, 0)".
std::string counted(int count, const std::string& one, const std::string& many,
                    const std::vector<Eigen::Vector3d>& places);

// What each inspection finds goes into the report.

/// Largest coordinate that is taken for a number, and least extent of a mesh: squares of areas, also of triangles that
/// are far smaller than the mesh, neither overflow nor underflow. Exact predicates (mesh/checks/predicates.hpp) go as
/// far.
constexpr double kLargestCoordinate = 1e70, kLeastExtent = 1e-70;

/// Reports a mesh whose triangles reach less far than that; whether it is one. Nothing where it has no extent at all.
bool report_extent(const SurfaceMesh& mesh, MeshReport& report);

/// Takes away triangles with a vertex that is no finite point, and puts such vertices into the middle of the others.
void leave_out_non_finite(SurfaceMesh& mesh, MeshReport& report);
void report_unreferenced(const SurfaceMesh& mesh, MeshReport& report);
/// Triangles with two equal vertices; inspections of edges then leave them out.
void report_collapsed(const SurfaceMesh& mesh, MeshReport& report);
void report_edges(const SurfaceMesh& mesh, const EdgeTable& edges, MeshReport& report);
void report_hinges(const SurfaceMesh& mesh, MeshReport& report);
/// Whether a triangle has the vertices of an earlier one, by triangle.
std::vector<char> repeats_of_triangles(const SurfaceMesh& mesh);
void report_duplicates(const SurfaceMesh& mesh, MeshReport& report);
/// Triangles without area, and slivers.
void report_shapes(const SurfaceMesh& mesh, MeshReport& report);

/// Turns triangles so that all of a component face the same side; reports what was turned, or a one-sided surface.
void repair_orientation(SurfaceMesh& mesh, const EdgeTable& edges, const Components& components, MeshReport& report);

/// Pairs of triangles that cross or touch, as far as they were looked for. Every triangle has some area and repeats no
/// other.
struct CrossingPairs {
    std::vector<std::pair<int, int>> pairs;
    bool complete = true;
};
/// How long they are looked for: `briefly` where the mesh is refused anyway, because there the search may take forever
/// (a vertex of 100 000 triangles has 5e9 pairs of neighbours).
enum class CrossingSearch { all, briefly };
/// Throws Cancelled.
CrossingPairs find_crossing_pairs(const SurfaceMesh& mesh, CrossingSearch search, const Control& control);
void report_crossings(const SurfaceMesh& mesh, const CrossingPairs& crossings, MeshReport& report);

/// Turns closed components so that solids face outward and cavities inward; reports these, parts without volume, the
/// number of solids and the volume. The mesh is closed and consistently oriented.
void repair_inside_out(SurfaceMesh& mesh, const Components& components, const CrossingPairs& crossings,
                       MeshReport& report);

}  // namespace elastolab
