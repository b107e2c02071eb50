#include "cli/solve_outputs.hpp"

#include <algorithm>
#include <deque>
#include <set>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/output_path.hpp"
#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/matrix_market.hpp"
#include "cli/npy.hpp"
#include "cli/report.hpp"
#include "cli/solution_tables.hpp"
#include "mesh/input/export.hpp"
#include "mesh/output/field_files.hpp"
#include "scene/field_export.hpp"
#include "scene/figure/figure.hpp"
#include "scene/figure/gltf.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> files(const OutputPaths& paths) {
    std::vector<fs::path> result;
    for (const fs::path& path :
         {paths.displacements, paths.fields, paths.mesh, paths.forces, paths.report, paths.figure})
        if (!path.empty()) result.push_back(path);
    return result;
}

/// Links lead to the same file before it is there, too.
fs::path resolved(const fs::path& path) {
    std::error_code error;
    fs::path target = path;
    try {
        if (!path.empty() && !is_open_stream(path)) target = followed_links(path);
    } catch (const std::exception&) {  // told by whoever writes
    }
    const fs::path full = fs::weakly_canonical(fs::absolute(target, error), error);
    return error ? path.lexically_normal() : full;
}

/// The folder for matrices, or the one it will be made in.
void require_writable_folder(const fs::path& folder) {
    std::error_code error;
    if (fs::is_directory(folder, error)) return AtomicFile::require_writable(folder / "H.npy");
    if (fs::exists(folder, error)) throw Error(folder.string() + ": is a file, not a folder. Name a folder.");
    AtomicFile::require_writable(folder);
}

/// Writers fill it; commit() puts everything in place. What was not committed leaves nothing behind.
class OutputSet {
public:
    /// Throws Error for a file that was added before: a matrix with the name of another output.
    AtomicFile& add(const fs::path& destination) {
        if (!places_.insert(resolved(destination)).second)
            throw Error(destination.string() + ": is the place of two outputs. Name another file.");
        return files_.emplace_back(destination);
    }

    void commit() {
        for (AtomicFile& file : files_) file.close();
        for (AtomicFile& file : files_) file.commit();
    }

private:
    std::set<fs::path> places_;
    std::deque<AtomicFile> files_;  ///< references to its members stay valid
};

Figure figure_of(const Solution& solution, FigureUse use, Control& control) {
    return make_figure(solved_body(solution), solution.groups, solution.vertical, use, control);
}

void write_mesh(std::ostream& out, const fs::path& name, const Solution& solution, VtkPoints points, Control& control) {
    if (is_glb_file(name)) return write_glb(out, figure_of(solution, FigureUse::show, control));
    if (is_field_file(name)) return write_field_file(out, name, solved_body(solution), control, points);
    SurfaceMesh mesh = *solution.surface;
    mesh.vertices += solution.displacement;
    write_surface(out, mesh, name);
}

void write_matrices(OutputSet& outputs, const fs::path& folder, const Model& model) {
    model.visit_matrices([&](const NamedMatrix& matrix) {
        AtomicFile& file = outputs.add(folder / (matrix.name + ".npy"));
        write_npy(file.stream(), matrix.values);
        file.close();
    });
    model.visit_sparse_stiffness([&](const std::string& name, const SparseStiffness& matrix) {
        AtomicFile& file = outputs.add(folder / (name + ".mtx"));
        write_matrix_market(file.stream(), matrix);
        file.close();
    });
}

/// A folder that is made if it is missing, and removed again if it stays empty.
class NewFolder {
public:
    explicit NewFolder(fs::path folder) : folder_(std::move(folder)) {
        std::error_code error;
        made_ = !folder_.empty() && fs::create_directory(folder_, error);
        if (error) throw Error(folder_.string() + ": cannot be made (" + error.message() + "). Choose another place.");
    }
    ~NewFolder() {
        std::error_code ignored;
        if (made_) fs::remove(folder_, ignored);  // only if it is empty
    }
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

private:
    fs::path folder_;
    bool made_ = false;
};

}  // namespace

bool OutputPaths::any() const { return !files(*this).empty() || !matrices.empty(); }

void require_distinct(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
    std::vector<fs::path> taken(inputs.size());
    std::transform(inputs.begin(), inputs.end(), taken.begin(), resolved);
    for (const fs::path& output : outputs) {
        if (output.empty()) continue;
        const auto found = std::find(taken.begin(), taken.end(), resolved(output));
        if (found != taken.end() && found - taken.begin() < std::ssize(inputs))
            throw UsageError(output.string() + ": is an input. Name another file to write.");
        if (found != taken.end()) throw UsageError(output.string() + ": is named as an output twice. Name two files.");
        taken.push_back(resolved(output));
    }
}

std::vector<fs::path> files_of_scene(const fs::path& scene_file, const MeshSource& mesh) {
    std::vector<fs::path> files = {scene_file};
    if (const auto* file = std::get_if<MeshFile>(&mesh)) files.push_back(scene_file.parent_path() / file->file);
    return files;
}

void require_mesh_extension(const fs::path& mesh) {
    const std::string extension = lower_case(mesh.extension().string());
    if (extension != ".obj" && extension != ".stl" && extension != ".glb" &&
        (extension == ".csv" || !is_field_file(mesh)))
        throw UsageError(
            mesh.string() +
            ": a mesh is written as .obj, .ply, .stl, .vtp, .vtu or .glb. Choose one of these extensions.");
}

void require_inside(MethodKind method, const fs::path& mesh) {
    if (lower_case(mesh.extension().string()) == ".vtu" && !method->has_inside)
        throw UsageError(mesh.string() + ": " + std::string(name(method)) +
                         " has no tetrahedra inside. Choose .vtp, or a finite-element method.");
}

void require_figure(MethodKind method, const Document& scene, const OutputPaths& paths) {
    const std::size_t n_handles = scene.handles.size(), n_loads = scene.loads.size() + (scene.gravity ? 1 : 0);
    const fs::path glb = is_glb_file(paths.mesh) ? paths.mesh : fs::path();
    for (const auto& [file, n_causes] : {std::pair(paths.figure, n_handles), std::pair(glb, n_handles + n_loads)}) {
        if (file.empty()) continue;
        if (const std::string why = figure_refusal(method, n_causes); !why.empty())
            throw UsageError(file.string() + ": " + why);
    }
}

void require_writable(const OutputPaths& paths, const std::vector<fs::path>& inputs) {
    require_distinct(files(paths), inputs);
    if (!paths.mesh.empty()) require_mesh_extension(paths.mesh);
    if (!paths.figure.empty() && !is_figure_file(paths.figure))
        throw UsageError(paths.figure.string() + ": a figure is called .html. Choose that extension.");
    for (const fs::path& path : files(paths)) AtomicFile::require_writable(path);
    if (!paths.matrices.empty()) require_writable_folder(paths.matrices);
}

void write_outputs(const OutputPaths& paths, const Solution& solution, Control& control) {
    const NewFolder folder(paths.matrices);  // destroyed after `outputs`, whose temporaries lie in it
    OutputSet outputs;
    if (!paths.displacements.empty())
        write_displacements(outputs.add(paths.displacements).stream(), *solution.surface, solution.displacement);
    if (!paths.fields.empty())
        write_field_csv(outputs.add(paths.fields).stream(), solution.surface->vertices,
                        surface_fields(solved_body(solution)));
    if (!paths.mesh.empty())
        write_mesh(outputs.add(paths.mesh).stream(), paths.mesh, solution, paths.mesh_points, control);
    if (!paths.figure.empty())
        write_figure(outputs.add(paths.figure).stream(), figure_of(solution, FigureUse::pull, control));
    if (!paths.forces.empty()) {
        std::vector<GroupReaction> rows = solution.reactions;
        rows.insert(rows.end(), solution.loads.begin(), solution.loads.end());
        write_forces(outputs.add(paths.forces).stream(), rows);
    }
    if (!paths.matrices.empty()) write_matrices(outputs, paths.matrices, *solution.model);
    if (!paths.report.empty()) write_report(outputs.add(paths.report).stream(), solution);
    outputs.commit();
}

}  // namespace elastolab
