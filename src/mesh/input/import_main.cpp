// elastolab-import: reads a mesh file for import_surface(). In a process of its own, with few rights, because assimp
// aborts, crashes or loops on some damaged files. Standard input is a socket to the caller.
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "mesh/input/helper_io.hpp"
#include "mesh/input/import_protocol.hpp"
#include "mesh/input/readers/readers.hpp"
#include "mesh/input/readers/regular_file.hpp"
#include "mesh/input/readers/words.hpp"
#include "mesh/input/sandbox.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

struct Imported {
    SurfaceMesh mesh;
    bool is_single_precision = false;
    std::string problem;
};

using Reader = SurfaceMesh (*)(std::string_view);

/// Of the formats whose digits are kept; null for all others.
Reader reader_for(const std::string& extension) {
    if (extension == ".obj") return read_obj;
    if (extension == ".ply") return read_ply;
    if (extension == ".off") return read_off;
    if (extension == ".stl") return read_stl;
    return nullptr;
}

std::string text_or_bytes(const fs::path& file, bool is_stl) {
    std::optional<std::string> bytes = read_regular_file(file);
    if (!bytes) throw Refusal("is not a regular file, or cannot be read. Copy the mesh into one.");
    if (is_stl && is_binary_stl(*bytes)) return std::move(*bytes);  // which may begin with any bytes
    if (bytes->starts_with("\xff\xfe") || bytes->starts_with("\xfe\xff"))
        throw Refusal("is UTF-16 text. Save it as UTF-8.");
    if (bytes->starts_with("\xef\xbb\xbf")) bytes->erase(0, 3);  // the mark of UTF-8
    return std::move(*bytes);
}

Imported read(const fs::path& file) {
    Imported result;
    if (const Reader reader = reader_for(lower_case(file.extension().string()))) {
        result.mesh = reader(text_or_bytes(file, reader == read_stl));
    } else {
        result.mesh = read_scene(file);
        result.is_single_precision = true;
    }
    if (result.mesh.n_triangles() == 0) throw Refusal("holds no triangle. Export the surface with its faces.");
    return result;
}

Imported import(const fs::path& file) {
    Imported failed;
    try {
        return read(file);
    } catch (const Refusal& refusal) {
        failed.problem = refusal.what();
    } catch (const std::bad_alloc&) {
        failed.problem = "asks for more memory than there is. Is it damaged? Export it again.";
    } catch (const std::exception&) {  // of a library, in its own words
        failed.problem = "cannot be read as a mesh. Is it damaged? Export it again as OBJ, PLY or STL.";
    }
    return failed;
}

void reply(const Imported& imported) {
    ImportReplyHeader header;
    header.n_vertices = imported.mesh.n_vertices();
    header.n_triangles = imported.mesh.n_triangles();
    header.text_size = static_cast<std::int32_t>(imported.problem.size());
    header.is_single_precision = imported.is_single_precision ? 1 : 0;
    write_bytes(&header, sizeof(header));
    const auto write = [](const auto& matrix) {
        write_bytes(matrix.data(), sizeof(*matrix.data()) * static_cast<std::size_t>(matrix.size()));
    };
    write(imported.mesh.vertices);
    write(imported.mesh.triangles);
    write(imported.problem);
}

void limit(const ImportRequestHeader& request) {
    limit_seconds(request.cpu_seconds);
    ::alarm(static_cast<unsigned>(4 * request.cpu_seconds));  // it may also wait: for memory, or for a slow disk
    if (kSanitized) return;                                   // their bookkeeping takes terabytes of addresses
    const auto bytes = static_cast<rlim_t>(request.memory_bytes);
    const rlimit memory{bytes, bytes};
    ::setrlimit(RLIMIT_DATA, &memory);
}

/// The folder of the file, and that of what it is a link to.
std::vector<fs::path> folders_of(const fs::path& file) {
    std::error_code ignored;
    return {fs::absolute(file, ignored).parent_path(), fs::weakly_canonical(file, ignored).parent_path()};
}

}  // namespace

}  // namespace elastolab

int main() {
    using namespace elastolab;
    begin_helper();
    ImportRequestHeader request;
    read_bytes(&request, sizeof(request));
    if (request.magic != kImportMagic) return kHelperMisused;
    const std::vector<char> path = read_array<char>(request.path_size);
    const std::filesystem::path file(std::string(path.begin(), path.end()));
    limit(request);
    enter_sandbox(folders_of(file));
    reply(import(file));
    std::_Exit(0);  // at once: nothing is left to do, and assimp need not tidy up
}
