#include "mesh/input/import.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/input/child_process.hpp"
#include "mesh/input/formats.hpp"
#include "mesh/input/import_protocol.hpp"
#include "mesh/input/merge.hpp"
#include "mesh/input/messages.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

/// Of what a message quotes: a name that a scene file gives, or what the helper says of the file.
constexpr std::size_t kLongestText = 400;

[[noreturn]] void fail(const fs::path& file, const std::string& finding) {
    throw MeshError(one_line(shortened(file.string(), kLongestText) + ": " + finding));
}

void require_readable(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) fail(file, "there is no such file. Check the path.");
    if (fs::is_directory(status)) fail(file, "is a folder. Name a mesh file in it.");
    if (!fs::is_regular_file(status)) fail(file, "is not a regular file. Copy the mesh into one.");
    if (fs::file_size(file, error) == 0) fail(file, "is empty. Export the mesh again.");
    if (!std::ifstream(file)) fail(file, "cannot be opened. Check its permissions.");
}

void require_known_format(const fs::path& file) {
    const std::string extension = lower_case(file.extension().string());
    if (!extension.empty() && is_mesh_format(extension.substr(1))) return;
    fail(file, (extension.empty() ? "has no extension" : "has an unsupported format") +
                   std::string(". Export it as OBJ, PLY, OFF, STL or glTF."));
}

/// Time and memory far beyond what any sound file of this size takes.
ImportRequestHeader header_for(const fs::path& file) {
    const double size = static_cast<double>(fs::file_size(file));
    ImportRequestHeader header;
    header.path_size = static_cast<std::int32_t>(file.string().size());
    header.cpu_seconds = static_cast<std::int32_t>(std::min(5.0 + 4e-6 * size, 1e6));
    header.memory_bytes = static_cast<std::int64_t>(2e9 + 200.0 * size);
    return header;
}

std::string request_bytes(const fs::path& file) {
    const ImportRequestHeader header = header_for(file);
    std::string bytes(sizeof(header), '\0');
    std::memcpy(bytes.data(), &header, sizeof(header));
    return bytes + file.string();
}

std::string meaning_of_end(int status) {
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGXCPU || signal == SIGALRM || signal == SIGKILL)
        return "cannot be read: the reader used up its time or memory. Is it damaged? Export it again.";
    return "cannot be read: the reader crashed on it (" +
           (signal != 0 ? "signal " + std::to_string(signal) : "exit code " + std::to_string(WEXITSTATUS(status))) +
           "). Is it damaged? Export it again as OBJ, PLY or STL.";
}

/// Whether what follows the header is as long as it says: checked before any memory is asked for.
bool agrees(const ImportReplyHeader& header, std::size_t size_of_rest) {
    if (header.magic != kImportMagic || header.n_vertices < 0 || header.n_triangles < 0 || header.text_size < 0)
        return false;
    return size_of_rest == 3 * sizeof(double) * static_cast<std::size_t>(header.n_vertices) +
                               3 * sizeof(std::int32_t) * static_cast<std::size_t>(header.n_triangles) +
                               static_cast<std::size_t>(header.text_size);
}

bool within(const Triangles& triangles, int n_vertices) {
    return triangles.size() == 0 || (triangles.minCoeff() >= 0 && triangles.maxCoeff() < n_vertices);
}

/// Floats have 24 digits of base 2: a body far from the origin loses those that its distance takes.
std::string precision_warning(const SurfaceMesh& mesh) {
    const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff(), high = mesh.vertices.rowwise().maxCoeff();
    const double size = (high - low).norm(), distance = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    constexpr double kFloatRounding = 6e-8, kTolerable = 1e-6;
    const double coarseness = kFloatRounding * distance / size;
    if (!(coarseness > kTolerable) || !std::isfinite(coarseness)) return {};
    return formatted(
        "its coordinates are read in single precision and lie far from the origin: they are rounded by %.1g of its "
        "size. "
        "Move it to the origin before it is exported, or export it as OBJ or PLY.",
        coarseness);
}

/// Without ".." and links in its folder, for which the sandbox has no answer.
fs::path plain_path(const fs::path& file) {
    const fs::path absolute = fs::absolute(file);
    return fs::canonical(absolute.parent_path()) / absolute.filename();
}

ImportedSurface import(const fs::path& file, Control& control) {
    ChildProcess helper(helper_program("elastolab-import"));
    const std::vector<char> bytes = helper.exchange(request_bytes(plain_path(file)), control,
                                                    static_cast<std::size_t>(header_for(file).memory_bytes));
    const int status = helper.wait(control);

    ImportReplyHeader header;
    ReplyReader reply(bytes);
    if (bytes.size() < sizeof(header)) fail(file, meaning_of_end(status));
    reply.read(&header, 1);
    if (!agrees(header, bytes.size() - sizeof(header))) fail(file, meaning_of_end(status));
    SurfaceMesh mesh{Positions(3, header.n_vertices), Triangles(3, header.n_triangles)};
    std::string problem(static_cast<std::size_t>(header.text_size), '\0');
    reply.read(mesh.vertices.data(), static_cast<std::size_t>(mesh.vertices.size()));
    reply.read(mesh.triangles.data(), static_cast<std::size_t>(mesh.triangles.size()));
    reply.read(problem.data(), problem.size());
    if (!problem.empty()) fail(file, shortened(problem, kLongestText));
    if (mesh.n_triangles() == 0 || !within(mesh.triangles, mesh.n_vertices())) fail(file, meaning_of_end(status));
    ImportedSurface result{merged(mesh), {}};
    if (header.is_single_precision != 0) result.warning = precision_warning(result.mesh);
    return result;
}

}  // namespace

ImportedSurface import_surface(const fs::path& file, Control& control) {
    require_readable(file);
    require_known_format(file);
    return import(file, control);
}

SurfaceMesh load_surface(const fs::path& file) {
    Control never_cancelled;
    return import_surface(file, never_cancelled).mesh;
}

}  // namespace elastolab
